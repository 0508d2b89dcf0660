// Four triangles at once on what every x86-64 machine has; see lanes.h.
#include <emmintrin.h>

#include <kernel/backends.h>
#include <kernel/walk.h>

namespace pierce::detail {

namespace {

struct Sse2 {
    static constexpr unsigned width = 4;
    static constexpr unsigned boxes = 2;
    using Float = __m128;

    static Float all(float x) { return _mm_set1_ps(x); }
    static Float abs(Float x) { return _mm_andnot_ps(_mm_set1_ps(-0.0F), x); }
    static Float max(Float x, Float y) { return _mm_max_ps(x, y); }
    static Float min(Float x, Float y) { return _mm_min_ps(x, y); }
    static unsigned less(Float x, Float y) { return static_cast<unsigned>(_mm_movemask_ps(_mm_cmplt_ps(x, y))); }

    static Lanes<Sse2> columns(Float r0, Float r1, Float r2, Float r3) {
        const Float xy01 = _mm_unpacklo_ps(r0, r1);
        const Float xy23 = _mm_unpacklo_ps(r2, r3);
        const Float z01 = _mm_unpackhi_ps(r0, r1);
        const Float z23 = _mm_unpackhi_ps(r2, r3);
        return {_mm_movelh_ps(xy01, xy23), _mm_movehl_ps(xy23, xy01), _mm_movelh_ps(z01, z23)};
    }
    static Lanes<Sse2> relative(const float* const* at, const float* origin, float scale) {
        const Float o = _mm_loadu_ps(origin);
        const Float s = _mm_set1_ps(scale);
        const auto row = [&](unsigned i) { return (_mm_loadu_ps(at[i]) - o) * s; };
        return columns(row(0), row(1), row(2), row(3));
    }
    static Lanes<Sse2> relative(const double* const* at, const double* origin, float scale) {
        const __m128d xy = _mm_loadu_pd(origin);
        const __m128d z = _mm_load_sd(origin + 2);
        const __m128d s = _mm_set1_pd(double{scale});
        const auto row = [&](unsigned i) {
            return _mm_movelh_ps(_mm_cvtpd_ps((_mm_loadu_pd(at[i]) - xy) * s), _mm_cvtpd_ps((_mm_load_sd(at[i] + 2) - z) * s));
        };
        return columns(row(0), row(1), row(2), row(3));
    }

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
};

int block_sse2(const PackedLevel& level, const double* half_from, const double* half_to, Stop* stops) {
    return block<Sse2>(level, half_from, half_to, stops);
}

int look_sse2(const PackedLevel& level, const double* half_from, const double* half_to, std::uint32_t* out, unsigned room, unsigned* cells) {
    return look<Sse2>(level, half_from, half_to, out, room, cells);
}

Walking start_walk_sse2(const PackedLevel& level, const double* half_from, const double* half_to, double limit, bool once, Walk& walk) {
    return start_walk<Sse2>(level, half_from, half_to, limit, once, walk);
}

unsigned walk_sse2(const PackedLevel& level, Walk& walk, double limit, Stop* stops, unsigned room) {
    return walk_on<Sse2>(level, walk, limit, stops, room);
}

unsigned cull_sse2(const std::uint64_t* boxes, const std::uint32_t* ids, unsigned count, std::uint64_t above, std::uint64_t seen,
                   std::uint32_t* out) {
    return cull<Sse2>(boxes, ids, count, above, seen, out);
}

template <class Scalar>
unsigned refine_sse2(const Probe<Scalar>& probe, const Scalar* corners, std::uint32_t* ids, unsigned count, std::uint32_t* out) {
    return refine<Sse2>(probe, corners, ids, count, out);
}

}  // namespace

const Backend k_sse2 = {"sse2", block_sse2, look_sse2, start_walk_sse2, walk_sse2, cull_sse2, refine_sse2<float>, refine_sse2<double>};

}  // namespace pierce::detail
