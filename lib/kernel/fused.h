// Four doubles in one register, and products whose loss one fused operation finds: four.h for AVX2 with FMA. Only for
// files that are compiled for these.
#pragma once

#include <immintrin.h>

#include <kernel/four.h>

namespace pierce::detail {

namespace {

struct Fused {
    [[gnu::always_inline]] static Pair lost(Pair x, Pair y, Pair product) {
        return reinterpret_cast<Pair>(_mm_fmsub_pd(x, y, product));
    }
    [[gnu::always_inline]] static double lost(double x, double y, double product) {
        return __builtin_fma(x, y, -product);
    }
    template <class Four>
    [[gnu::always_inline]] static Four lost(Four x, Four y, Four product) {
        return {_mm256_fmsub_pd(x.four, y.four, product.four)};
    }
};

struct OneRegister {
    __m256d four;

    using Product = Fused;
    PIERCE_INLINE OneRegister all(double x) { return {_mm256_set1_pd(x)}; }
    PIERCE_INLINE OneRegister of(Pair low, Pair high) { return {_mm256_set_m128d(high, low)}; }
    PIERCE_INLINE OneRegister load(const double* x) { return {_mm256_loadu_pd(x)}; }
    PIERCE_INLINE OneRegister first_lanes(const Triple<Pair>& x) { return of(_mm_unpacklo_pd(x.x, x.y), x.z); }
    PIERCE_INLINE OneRegister second_lanes(const Triple<Pair>& x) {
        return of(_mm_unpackhi_pd(x.x, x.y), _mm_unpackhi_pd(x.z, x.z));
    }
    [[gnu::always_inline]] inline void store(double* to) const { _mm256_storeu_pd(to, four); }

    [[gnu::always_inline]] inline void round_to(float* to) const { _mm_storeu_ps(to, _mm256_cvtpd_ps(four)); }
    [[gnu::always_inline]] inline void round_to(double* to) const { store(to); }

    [[gnu::always_inline]] friend inline OneRegister operator+(OneRegister x, OneRegister y) {
        return {x.four + y.four};
    }
    [[gnu::always_inline]] friend inline OneRegister operator-(OneRegister x, OneRegister y) {
        return {x.four - y.four};
    }
    [[gnu::always_inline]] friend inline OneRegister operator*(OneRegister x, OneRegister y) {
        return {x.four * y.four};
    }
    [[gnu::always_inline]] friend inline OneRegister operator-(OneRegister x) { return {-x.four}; }
    [[gnu::always_inline]] friend inline OneRegister operator*(double x, OneRegister y) { return all(x) * y; }

    [[gnu::always_inline]] friend inline OneRegister operator&(OneRegister x, OneRegister y) {
        return {_mm256_and_pd(x.four, y.four)};
    }
    [[gnu::always_inline]] friend inline OneRegister operator|(OneRegister x, OneRegister y) {
        return {_mm256_or_pd(x.four, y.four)};
    }
    PIERCE_INLINE OneRegister less(OneRegister x, OneRegister y) { return {_mm256_cmp_pd(x.four, y.four, _CMP_LT_OQ)}; }
    PIERCE_INLINE OneRegister at_most(OneRegister x, OneRegister y) {
        return {_mm256_cmp_pd(x.four, y.four, _CMP_LE_OQ)};
    }
    PIERCE_INLINE OneRegister equal(OneRegister x, OneRegister y) {
        return {_mm256_cmp_pd(x.four, y.four, _CMP_EQ_OQ)};
    }
    PIERCE_INLINE OneRegister select(OneRegister mask, OneRegister yes, OneRegister no) {
        return {_mm256_blendv_pd(no.four, yes.four, mask.four)};
    }
    PIERCE_INLINE double lane(OneRegister x, int i) { return x.four[i]; }
    PIERCE_INLINE unsigned signs(OneRegister x) { return static_cast<unsigned>(_mm256_movemask_pd(x.four)); }

    PIERCE_INLINE OneRegister sums(OneRegister a, OneRegister b, OneRegister c, OneRegister d) {
        const __m256d ab = _mm256_unpacklo_pd(a.four, b.four);  // a0 b0 a2 b2
        const __m256d cd = _mm256_unpacklo_pd(c.four, d.four);
        const __m256d ab1 = _mm256_unpackhi_pd(a.four, b.four);  // a1 b1 a3 b3
        const __m256d cd1 = _mm256_unpackhi_pd(c.four, d.four);
        const __m256d first = _mm256_permute2f128_pd(ab, cd, 0x20);
        const __m256d second = _mm256_permute2f128_pd(ab1, cd1, 0x20);
        const __m256d third = _mm256_permute2f128_pd(ab, cd, 0x31);
        return {(first + second) + third};
    }

    template <class Scalar>
    PIERCE_INLINE OneRegister rounded(OneRegister x) {
        if constexpr (sizeof(Scalar) == 4)
            return {_mm256_cvtps_pd(_mm256_cvtpd_ps(x.four))};
        else
            return x;
    }
    template <class Scalar>
    PIERCE_INLINE OneRegister next_to(OneRegister x, OneRegister sign) {
        const __m256d zero = _mm256_cmp_pd(x.four, _mm256_setzero_pd(), _CMP_EQ_OQ);
        if constexpr (sizeof(Scalar) == 4) {
            const __m128i bits = _mm_castps_si128(_mm256_cvtpd_ps(x.four));
            const __m128i wanted = upper_halves(sign.four);
            const __m128i by = _mm_or_si128(_mm_srai_epi32(_mm_xor_si128(bits, wanted), 31), _mm_set1_epi32(1));
            const __m128i least = _mm_or_si128(_mm_and_si128(wanted, _mm_set1_epi32(INT32_MIN)), _mm_set1_epi32(1));
            const __m128i next = _mm_blendv_epi8(_mm_add_epi32(bits, by), least, upper_halves(zero));
            return {_mm256_cvtps_pd(_mm_castsi128_ps(next))};
        } else {
            const __m256i bits = _mm256_castpd_si256(x.four);
            const __m256i wanted = _mm256_castpd_si256(sign.four);
            const __m256i one = _mm256_set1_epi64x(1);
            const __m256i apart = _mm256_cmpgt_epi64(_mm256_setzero_si256(), _mm256_xor_si256(bits, wanted));
            const __m256i next = _mm256_add_epi64(bits, _mm256_or_si256(apart, one));
            const __m256i least = _mm256_or_si256(_mm256_and_si256(wanted, _mm256_set1_epi64x(INT64_MIN)), one);
            return {_mm256_blendv_pd(_mm256_castsi256_pd(next), _mm256_castsi256_pd(least), zero)};
        }
    }

  private:
    PIERCE_INLINE __m128i upper_halves(__m256d x) {
        const __m128 low = _mm_castpd_ps(_mm256_castpd256_pd128(x));
        const __m128 high = _mm_castpd_ps(_mm256_extractf128_pd(x, 1));
        return _mm_castps_si128(_mm_shuffle_ps(low, high, 0xdd));
    }
};

}  // namespace

}  // namespace pierce::detail
