// The narrow phase with AVX2 and fused operations. Compiled with flags of its own (lib/CMakeLists.txt), and without
// contraction: the same bits as narrow_plain.cpp's where nothing underflows (double_double.h), and only there is it
// asked.
#include <kernel/fused.h>
#include <kernel/narrow_table.h>

namespace pierce::detail {

constinit const Narrow k_narrow_fused = narrow_of<OneRegister>();

}  // namespace pierce::detail
