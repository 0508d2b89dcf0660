// The kernels on AVX2 and FMA; compiled with flags of its own (lib/CMakeLists.txt), see set_probe.h.
#include <kernel/avx2.h>
#include <kernel/table.h>

namespace pierce::detail {

constinit const Backend k_avx2 = backend_named<Avx2>("avx2", k_narrow_fused);

}  // namespace pierce::detail
