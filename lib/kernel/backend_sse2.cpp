// Four numbers at once on what every x86-64 machine has; see set_probe.h.
#include <emmintrin.h>

#include <kernel/table.h>

namespace pierce::detail {

namespace {

struct Sse2 {
    static constexpr unsigned width = 4;
    using Float = __m128;
    using Mask = __m128;

    static Float all(float x) { return _mm_set1_ps(x); }
    static Float all_bits(std::uint32_t x) { return _mm_castsi128_ps(_mm_set1_epi32(static_cast<int>(x))); }
    static Float load(const float* x) { return _mm_loadu_ps(x); }
    static Float abs(Float x) { return _mm_andnot_ps(_mm_set1_ps(-0.0F), x); }
    static Float max(Float x, Float y) { return _mm_max_ps(x, y); }
    static Float min(Float x, Float y) { return _mm_min_ps(x, y); }
    static Float multiply_add(Float x, Float y, Float z) { return x * y + z; }
    static Mask below(Float x, Float y) { return _mm_cmplt_ps(x, y); }
    static Mask at_most(Float x, Float y) { return _mm_cmple_ps(x, y); }
    static Mask both(Mask x, Mask y) { return _mm_and_ps(x, y); }
    static Mask either(Mask x, Mask y) { return _mm_or_ps(x, y); }
    static unsigned bits(Mask x) { return static_cast<unsigned>(_mm_movemask_ps(x)); }
    // A key may be NaN in places without a child: then the second operand is taken, infinity where it counts.
    static Float none_where(Mask mask, Float keys) { return _mm_max_ps(keys, _mm_and_ps(mask, all(__builtin_inff()))); }
    static Float none_but(Mask mask, Float keys) {
        return _mm_max_ps(keys, _mm_andnot_ps(mask, all(__builtin_inff())));
    }

    static Float words(const std::uint16_t* x) {
        const __m128i four = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(x));
        return _mm_cvtepi32_ps(_mm_unpacklo_epi16(four, _mm_setzero_si128()));
    }
    static Float bytes(const std::uint8_t* x) {
        int four;
        __builtin_memcpy(&four, x, sizeof four);
        const __m128i zero = _mm_setzero_si128();
        return _mm_cvtepi32_ps(_mm_unpacklo_epi16(_mm_unpacklo_epi8(_mm_cvtsi32_si128(four), zero), zero));
    }

    static constexpr unsigned words_width = 8;
    using Words = __m128i;
    static Words all_words(std::uint16_t x) { return _mm_set1_epi16(static_cast<short>(x)); }
    static Words load_words(const std::uint16_t* x) { return _mm_load_si128(reinterpret_cast<const __m128i*>(x)); }
    static Words above(Words x, Words y) { return _mm_subs_epu16(x, y); }
    static Words either(Words x, Words y) { return _mm_or_si128(x, y); }
    static unsigned zeros(Words x) {
        const __m128i same = _mm_cmpeq_epi16(x, _mm_setzero_si128());
        return static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi16(same, _mm_setzero_si128())));
    }

    static Float key(Float entry, unsigned first) {
        const __m128i places = _mm_add_epi32(_mm_setr_epi32(0, 1, 2, 3), _mm_set1_epi32(static_cast<int>(first)));
        return _mm_castsi128_ps(_mm_or_si128(_mm_and_si128(_mm_castps_si128(entry), _mm_set1_epi32(~15)), places));
    }
    static Mask same(Float x, Float y) {
        return _mm_castsi128_ps(_mm_cmpeq_epi32(_mm_castps_si128(x), _mm_castps_si128(y)));
    }
    // Keys as floats are in the order of their bits.
    static Float least(Float x, Float y) { return _mm_min_ps(x, y); }
    static std::uint32_t least_of(Float x) {
        x = _mm_min_ps(x, _mm_shuffle_ps(x, x, _MM_SHUFFLE(1, 0, 3, 2)));
        x = _mm_min_ps(x, _mm_shuffle_ps(x, x, _MM_SHUFFLE(2, 3, 0, 1)));
        return static_cast<std::uint32_t>(_mm_cvtsi128_si32(_mm_castps_si128(x)));
    }

    static Float corner_row(const float* row, float origin, float) { return _mm_loadu_ps(row) - _mm_set1_ps(origin); }
    static Float joined(__m128d low, __m128d high) { return _mm_movelh_ps(_mm_cvtpd_ps(low), _mm_cvtpd_ps(high)); }
    static Float corner_row(const double* row, double origin, double scale) {
        const __m128d o = _mm_set1_pd(origin);
        const __m128d s = _mm_set1_pd(scale);
        return joined((_mm_loadu_pd(row) - o) * s, (_mm_loadu_pd(row + 2) - o) * s);
    }
    static Float row_difference(const double* x, const double* y, double scale) {
        const __m128d s = _mm_set1_pd(scale);
        return joined((_mm_loadu_pd(x) - _mm_loadu_pd(y)) * s, (_mm_loadu_pd(x + 2) - _mm_loadu_pd(y + 2)) * s);
    }
};

}  // namespace

constinit const Backend k_sse2 = backend_named<Sse2>("sse2");

}  // namespace pierce::detail
