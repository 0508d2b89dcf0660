// Eight floats at once on AVX2 and FMA: the operations that lanes.h, block.h and walk.h are written in.
//
// As lanes.h: included by backend_*.cpp, with nothing that other files could share.
#pragma once

#include <immintrin.h>

#include <kernel/block.h>
#include <kernel/floats4.h>

namespace pierce::detail {

namespace {

/// Which bytes of four numbers to move to the front, for each set of them.
struct Keep {
    constexpr Keep() {
        for (unsigned lanes = 0; lanes < 16; ++lanes) {
            unsigned next = 0;
            for (unsigned i = 0; i < 4; ++i)
                for (unsigned b = 0; (lanes >> i & 1) != 0 && b < 4; ++b) places[lanes][next++] = static_cast<char>(4 * i + b);
        }
    }
    alignas(16) char places[16][16] = {};
};
constexpr Keep k_keep;

struct Avx2 {
    static constexpr unsigned width = 8;
    static constexpr unsigned boxes = 4;
    using Float = __m256;

    static Float all(float x) { return _mm256_set1_ps(x); }
    static Float load(const float* x) { return _mm256_loadu_ps(x); }
    static Float abs(Float x) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0F), x); }
    static Float max(Float x, Float y) { return _mm256_max_ps(x, y); }
    static Float min(Float x, Float y) { return _mm256_min_ps(x, y); }
    static unsigned less(Float x, Float y) {
        return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(x, y, _CMP_LT_OQ)));
    }

    // Transposes x y z _ in eight lanes of the rows i and i + 4.
    static Lanes<Avx2> columns(Float r0, Float r1, Float r2, Float r3) {
        const Float xy01 = _mm256_unpacklo_ps(r0, r1);
        const Float xy23 = _mm256_unpacklo_ps(r2, r3);
        const Float z01 = _mm256_unpackhi_ps(r0, r1);
        const Float z23 = _mm256_unpackhi_ps(r2, r3);
        return {_mm256_shuffle_ps(xy01, xy23, 0x44), _mm256_shuffle_ps(xy01, xy23, 0xee), _mm256_shuffle_ps(z01, z23, 0x44)};
    }
    static Float fourth(Float r0, Float r1, Float r2, Float r3) {
        return _mm256_shuffle_ps(_mm256_unpackhi_ps(r0, r1), _mm256_unpackhi_ps(r2, r3), 0xee);
    }

    static constexpr unsigned rows = 4;
    static Float same_row(const float* x) {
        const __m128 once = _mm_setr_ps(x[0], x[1], x[2], 0);
        return _mm256_set_m128(once, once);
    }
    static Float row(const float* const* at, unsigned i) {
        return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(at[i])), _mm_loadu_ps(at[i + 4]), 1);
    }
    static Float scaled(Float x, Float origin, float scale) { return (x - origin) * _mm256_set1_ps(scale); }
    struct Doubles {
        __m256d low, high;
    };
    static Doubles same_row(const double* x) {
        const __m256d once = _mm256_setr_pd(x[0], x[1], x[2], 0);
        return {once, once};
    }
    static Doubles row(const double* const* at, unsigned i) { return {_mm256_loadu_pd(at[i]), _mm256_loadu_pd(at[i + 4])}; }
    static Float scaled(const Doubles& x, const Doubles& origin, float scale) {
        const __m256d s = _mm256_set1_pd(double{scale});
        const __m128 low = _mm256_cvtpd_ps((x.low - origin.low) * s);
        return _mm256_insertf128_ps(_mm256_castps128_ps256(low), _mm256_cvtpd_ps((x.high - origin.high) * s), 1);
    }

    // Halves of denormal numbers are not exact: in one operation with what follows they would be others than the grid's.
    static void settle(Double4& x) { asm("" : "+x"(x)); }
    static void lower(Double4& x, const Double4& y) { x = _mm256_min_pd(x, y); }
    static void raise(Double4& x, const Double4& y) { x = _mm256_max_pd(x, y); }
    static unsigned negative(Int4 x) { return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(x))); }
    static std::uint64_t pack(Int4 low, Int4 high) {
        const __m128i words = _mm_packs_epi32(reinterpret_cast<__m128i>(low), reinterpret_cast<__m128i>(high));
        return static_cast<std::uint64_t>(_mm_cvtsi128_si64(_mm_packs_epi16(words, words)));
    }
    static unsigned count_bits(std::uint64_t x) { return static_cast<unsigned>(__builtin_popcountll(x)); }

    using Bytes = __m256i;
    static Bytes bytes(std::uint64_t x) { return _mm256_set1_epi64x(static_cast<long long>(x)); }
    static unsigned left(const std::uint64_t* box, Bytes above, Bytes seen) {
        const __m256i v = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(box));
        const __m256i refused = _mm256_or_si256(_mm256_cmpgt_epi8(v, above), _mm256_and_si256(v, seen));
        const __m256i free = _mm256_cmpeq_epi64(refused, _mm256_setzero_si256());
        return static_cast<unsigned>(_mm256_movemask_pd(_mm256_castsi256_pd(free)));
    }
    static unsigned keep(unsigned lanes, const std::uint32_t* ids, std::uint32_t* out) {
        const __m128i some = _mm_loadu_si128(reinterpret_cast<const __m128i*>(ids));
        const __m128i places = _mm_load_si128(reinterpret_cast<const __m128i*>(k_keep.places[lanes]));
        _mm_storeu_si128(reinterpret_cast<__m128i*>(out), _mm_shuffle_epi8(some, places));
        return count_bits(lanes);
    }
};

/// For the usual few: half of the loads.
struct Four : Floats4<Four> {
    using Floats4<Four>::same_row;
    using Floats4<Four>::row;
    using Floats4<Four>::scaled;
    static __m256d same_row(const double* x) { return _mm256_setr_pd(x[0], x[1], x[2], 0); }
    static __m256d row(const double* const* at, unsigned i) { return _mm256_loadu_pd(at[i]); }
    static Float scaled(__m256d x, __m256d origin, float scale) { return _mm256_cvtpd_ps((x - origin) * _mm256_set1_pd(double{scale})); }
};

}  // namespace

}  // namespace pierce::detail
