// Four floats at once, as every x86-64 machine has them: what the files of its instruction sets have in common.
//
// As lanes.h: included by backend_*.cpp, with nothing that other files could share.
#pragma once

#include <emmintrin.h>

#include <kernel/lanes.h>

namespace pierce::detail {

namespace {

template <class Self>
struct Floats4 {
    static constexpr unsigned width = 4;
    using Float = __m128;

    static Float all(float x) { return _mm_set1_ps(x); }
    static Float load(const float* x) { return _mm_loadu_ps(x); }
    static Float abs(Float x) { return _mm_andnot_ps(_mm_set1_ps(-0.0F), x); }
    static Float max(Float x, Float y) { return _mm_max_ps(x, y); }
    static Float min(Float x, Float y) { return _mm_min_ps(x, y); }
    static unsigned less(Float x, Float y) { return static_cast<unsigned>(_mm_movemask_ps(_mm_cmplt_ps(x, y))); }

    // Transposes x y z _.
    static Lanes<Self> columns(Float r0, Float r1, Float r2, Float r3) {
        const Float xy01 = _mm_unpacklo_ps(r0, r1);
        const Float xy23 = _mm_unpacklo_ps(r2, r3);
        const Float z01 = _mm_unpackhi_ps(r0, r1);
        const Float z23 = _mm_unpackhi_ps(r2, r3);
        return {_mm_movelh_ps(xy01, xy23), _mm_movehl_ps(xy23, xy01), _mm_movelh_ps(z01, z23)};
    }
    static Float fourth(Float r0, Float r1, Float r2, Float r3) {
        return _mm_movehl_ps(_mm_unpackhi_ps(r2, r3), _mm_unpackhi_ps(r0, r1));
    }

    static constexpr unsigned rows = 4;
    static Float same_row(const float* x) { return _mm_setr_ps(x[0], x[1], x[2], 0); }
    static Float row(const float* const* at, unsigned i) { return _mm_loadu_ps(at[i]); }
    static Float scaled(Float x, Float origin, float scale) { return (x - origin) * _mm_set1_ps(scale); }
};

}  // namespace

}  // namespace pierce::detail
