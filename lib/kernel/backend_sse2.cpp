// Four triangles at once on what every x86-64 machine has; see lanes.h.
#include <kernel/floats4.h>
#include <kernel/table.h>

namespace pierce::detail {

namespace {

struct Sse2 : Floats4<Sse2> {
    static constexpr unsigned boxes = 2;
    using Floats4<Sse2>::same_row;
    using Floats4<Sse2>::row;
    using Floats4<Sse2>::scaled;
    struct Doubles {
        __m128d xy, z;
    };
    static Doubles same_row(const double* x) { return {_mm_setr_pd(x[0], x[1]), _mm_load_sd(x + 2)}; }
    static Doubles row(const double* const* at, unsigned i) { return {_mm_loadu_pd(at[i]), _mm_load_sd(at[i] + 2)}; }
    static Float scaled(const Doubles& x, const Doubles& origin, float scale) {
        const __m128d s = _mm_set1_pd(double{scale});
        return _mm_movelh_ps(_mm_cvtpd_ps((x.xy - origin.xy) * s), _mm_cvtpd_ps((x.z - origin.z) * s));
    }

    static void settle(Double4&) {}
    static void lower(Double4& x, const Double4& y) { x = x < y ? x : y; }
    static void raise(Double4& x, const Double4& y) { x = x > y ? x : y; }
    static unsigned negative(Int4 x) { return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(x))); }
    static std::uint64_t pack(Int4 low, Int4 high) {
        const __m128i words = _mm_packs_epi32(reinterpret_cast<__m128i>(low), reinterpret_cast<__m128i>(high));
        return static_cast<std::uint64_t>(_mm_cvtsi128_si64(_mm_packs_epi16(words, words)));
    }
    static unsigned count_bits(std::uint64_t x) { return count_bits_by_halves(x); }

    using Bytes = __m128i;
    static Bytes bytes(std::uint64_t x) { return _mm_set1_epi64x(static_cast<long long>(x)); }
    static unsigned left(const std::uint64_t* box, Bytes above, Bytes seen) {
        const __m128i v = _mm_loadu_si128(reinterpret_cast<const __m128i*>(box));
        const __m128i refused = _mm_or_si128(_mm_cmpgt_epi8(v, above), _mm_and_si128(v, seen));
        const __m128i free = _mm_cmpeq_epi32(refused, _mm_setzero_si128());  // of a half box
        const auto halves = static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(free)));
        const unsigned both = halves & (halves >> 1);
        return (both & 1) | ((both >> 1) & 2);
    }
    static unsigned keep(unsigned lanes, const std::uint32_t* ids, std::uint32_t* out) {
        out[0] = ids[0];
        out[lanes & 1] = ids[1];
        return (lanes & 1) + (lanes >> 1);
    }
};

}  // namespace

constinit const Backend k_sse2 = Kernels<Sse2>::named("sse2");

}  // namespace pierce::detail
