// Values in twice the precision with fused operations: what a product lost in one of them. Compiled with flags of its
// own (lib/CMakeLists.txt), and
// without contraction: the same bits as refine_plain.cpp's where nothing underflows (double_double.h), and there only
// is it asked.
#include <immintrin.h>

#include <kernel/refine.h>

namespace pierce::detail {

namespace {

struct Fused {
    [[gnu::always_inline]] static Pair lost(Pair x, Pair y, Pair product) {
        return reinterpret_cast<Pair>(_mm_fmsub_pd(x, y, product));
    }
    [[gnu::always_inline]] static double lost(double x, double y, double product) {
        return __builtin_fma(x, y, -product);
    }
};

void refine(const Measured& bars, Values& values) { refine_with<Fused>(bars, values); }

}  // namespace

constinit const Refine k_refine_fused = refine;

}  // namespace pierce::detail
