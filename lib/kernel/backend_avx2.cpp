// AVX2 and FMA; compiled with flags of its own (lib/CMakeLists.txt), see lanes.h.
#include <kernel/avx2.h>
#include <kernel/table.h>

namespace pierce::detail {

constinit const Backend k_avx2 = Kernels<Avx2, Avx2, Four>::named("avx2");

}  // namespace pierce::detail
