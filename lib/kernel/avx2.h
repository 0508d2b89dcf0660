// Eight numbers at once on AVX2 and FMA. Included by backend_*.cpp alone, see set_probe.h.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace pierce::detail {

namespace {

struct Avx2 {
    static constexpr unsigned width = 8;
    using Float = __m256;
    using Mask = __m256;

    static Float all(float x) { return _mm256_set1_ps(x); }
    static Float all_bits(std::uint32_t x) { return _mm256_castsi256_ps(_mm256_set1_epi32(static_cast<int>(x))); }
    static Float load(const float* x) { return _mm256_loadu_ps(x); }
    static Float abs(Float x) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0F), x); }
    static Float max(Float x, Float y) { return _mm256_max_ps(x, y); }
    static Float min(Float x, Float y) { return _mm256_min_ps(x, y); }
    static Float multiply_add(Float x, Float y, Float z) { return _mm256_fmadd_ps(x, y, z); }
    static Mask below(Float x, Float y) { return _mm256_cmp_ps(x, y, _CMP_LT_OQ); }
    static Mask at_most(Float x, Float y) { return _mm256_cmp_ps(x, y, _CMP_LE_OQ); }
    static Mask both(Mask x, Mask y) { return _mm256_and_ps(x, y); }
    static Mask either(Mask x, Mask y) { return _mm256_or_ps(x, y); }
    static unsigned bits(Mask x) { return static_cast<unsigned>(_mm256_movemask_ps(x)); }
    // The bits of infinity, k_no_key, are above those of all other keys.
    static Float greater(Float x, Float y) {
        return _mm256_castsi256_ps(_mm256_max_epi32(_mm256_castps_si256(x), _mm256_castps_si256(y)));
    }
    static Float none_where(Mask mask, Float keys) { return greater(keys, _mm256_and_ps(mask, all(__builtin_inff()))); }
    static Float none_but(Mask mask, Float keys) {
        return greater(keys, _mm256_andnot_ps(mask, all(__builtin_inff())));
    }

    static Float words(const std::uint16_t* x) {
        return _mm256_cvtepi32_ps(_mm256_cvtepu16_epi32(_mm_load_si128(reinterpret_cast<const __m128i*>(x))));
    }
    static Float bytes(const std::uint8_t* x) {
        return _mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(x))));
    }

    // Whole numbers, for boxes: how far x is above y, 0 where it is not.
    static constexpr unsigned words_width = 16;
    using Words = __m256i;
    static Words all_words(std::uint16_t x) { return _mm256_set1_epi16(static_cast<short>(x)); }
    static Words load_words(const std::uint16_t* x) { return _mm256_load_si256(reinterpret_cast<const __m256i*>(x)); }
    static Words above(Words x, Words y) { return _mm256_subs_epu16(x, y); }
    static Words either(Words x, Words y) { return _mm256_or_si256(x, y); }
    static unsigned zeros(Words x) {
        const __m256i same = _mm256_cmpeq_epi16(x, _mm256_setzero_si256());
        return _pext_u32(static_cast<unsigned>(_mm256_movemask_epi8(same)), 0x55555555U);
    }

    static Float key(Float entry, unsigned first) {
        const __m256i places =
            _mm256_add_epi32(_mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7), _mm256_set1_epi32(static_cast<int>(first)));
        return _mm256_castsi256_ps(
            _mm256_or_si256(_mm256_and_si256(_mm256_castps_si256(entry), _mm256_set1_epi32(~15)), places));
    }
    static Mask same(Float x, Float y) {
        return _mm256_castsi256_ps(_mm256_cmpeq_epi32(_mm256_castps_si256(x), _mm256_castps_si256(y)));
    }
    static Float least(Float x, Float y) {
        return _mm256_castsi256_ps(_mm256_min_epi32(_mm256_castps_si256(x), _mm256_castps_si256(y)));
    }
    static std::uint32_t least_of(Float x) {
        const __m256i whole = _mm256_castps_si256(x);
        __m128i half = _mm_min_epi32(_mm256_castsi256_si128(whole), _mm256_extracti128_si256(whole, 1));
        half = _mm_min_epi32(half, _mm_shuffle_epi32(half, _MM_SHUFFLE(1, 0, 3, 2)));
        half = _mm_min_epi32(half, _mm_shuffle_epi32(half, _MM_SHUFFLE(2, 3, 0, 1)));
        return static_cast<std::uint32_t>(_mm_cvtsi128_si32(half));
    }

    static Float corner_row(const float* row, float origin, float) {
        return _mm256_loadu_ps(row) - _mm256_set1_ps(origin);
    }
    static Float joined(__m256d low, __m256d high) {
        return _mm256_set_m128(_mm256_cvtpd_ps(high), _mm256_cvtpd_ps(low));
    }
    static Float corner_row(const double* row, double origin, double scale) {
        const __m256d o = _mm256_set1_pd(origin);
        const __m256d s = _mm256_set1_pd(scale);
        return joined((_mm256_loadu_pd(row) - o) * s, (_mm256_loadu_pd(row + 4) - o) * s);
    }
    static Float row_difference(const double* x, const double* y, double scale) {
        const __m256d s = _mm256_set1_pd(scale);
        return joined((_mm256_loadu_pd(x) - _mm256_loadu_pd(y)) * s,
                      (_mm256_loadu_pd(x + 4) - _mm256_loadu_pd(y + 4)) * s);
    }
};

}  // namespace

}  // namespace pierce::detail
