// The kernels on AVX-512: nodes of queries in flight sixteen numbers at once (measured: 5 to 10 % less time on Sapphire
// Rapids). A single query, which waits for results and not for units, is no faster so; nor are clusters, which have no
// more than eight triangles. Compiled with flags of its own (lib/CMakeLists.txt), see set_probe.h.
#include <kernel/avx2.h>
#include <kernel/table.h>

namespace pierce::detail {

namespace {

struct Avx512 {
    static constexpr unsigned width = 16;
    using Float = __m512;
    using Mask = __mmask16;

    static Float all(float x) { return _mm512_set1_ps(x); }
    static Float all_bits(std::uint32_t x) { return _mm512_castsi512_ps(_mm512_set1_epi32(static_cast<int>(x))); }
    static Float max(Float x, Float y) { return _mm512_max_ps(x, y); }
    static Float min(Float x, Float y) { return _mm512_min_ps(x, y); }
    static Float multiply_add(Float x, Float y, Float z) { return _mm512_fmadd_ps(x, y, z); }
    static Mask below(Float x, Float y) { return _mm512_cmp_ps_mask(x, y, _CMP_LT_OQ); }
    static Mask at_most(Float x, Float y) { return _mm512_cmp_ps_mask(x, y, _CMP_LE_OQ); }
    static unsigned bits(Mask x) { return x; }

    static Float words(const std::uint16_t* x) {
        return _mm512_cvtepi32_ps(_mm512_cvtepu16_epi32(_mm256_load_si256(reinterpret_cast<const __m256i*>(x))));
    }
    static Float bytes(const std::uint8_t* x) {
        return _mm512_cvtepi32_ps(_mm512_cvtepu8_epi32(_mm_load_si128(reinterpret_cast<const __m128i*>(x))));
    }

    static Float key(Float entry, unsigned) {
        const __m512i places = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
        return _mm512_castsi512_ps(
            _mm512_or_si512(_mm512_andnot_si512(_mm512_set1_epi32(15), _mm512_castps_si512(entry)), places));
    }
    static Float none_where(Mask mask, Float keys) { return _mm512_mask_mov_ps(keys, mask, all(__builtin_inff())); }
    static Float none_but(Mask mask, Float keys) { return _mm512_mask_mov_ps(all(__builtin_inff()), mask, keys); }
    static Mask same(Float x, Float y) {
        return _mm512_cmpeq_epi32_mask(_mm512_castps_si512(x), _mm512_castps_si512(y));
    }
    static std::uint32_t least_of(Float x) {
        const __m512i whole = _mm512_castps_si512(x);
        const __m256i half = _mm256_min_epi32(_mm512_castsi512_si256(whole), _mm512_extracti64x4_epi64(whole, 1));
        return Avx2::least_of(_mm256_castsi256_ps(half));
    }
    static Float least(Float x, Float) { return x; }
};

}  // namespace

constinit const Backend k_avx512 = backend_named<Avx2, Avx512>("avx512", k_narrow_fused);

}  // namespace pierce::detail
