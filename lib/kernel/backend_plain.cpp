// One triangle at a time, for machines whose instruction set has no file of its own, and to compare the others with; see lanes.h.
#include <kernel/backends.h>
#include <kernel/walk.h>

namespace pierce::detail {

namespace {

struct Plain {
    static constexpr unsigned width = 1;
    static constexpr unsigned boxes = 1;
    using Float = float;

    static Float all(float x) { return x; }
    static Float abs(Float x) { return x < 0 ? -x : x; }
    static Float max(Float x, Float y) { return x > y ? x : y; }
    static Float min(Float x, Float y) { return x < y ? x : y; }
    static unsigned less(Float x, Float y) { return x < y ? 1 : 0; }

    template <class Scalar>
    static Lanes<Plain> relative(const Scalar* const* at, const Scalar* origin, float scale) {
        const auto difference = [&](unsigned k) { return static_cast<float>((at[0][k] - origin[k]) * Scalar{scale}); };
        return {difference(0), difference(1), difference(2)};
    }

    static void lower(Double4& x, const Double4& y) { x = x < y ? x : y; }
    static void raise(Double4& x, const Double4& y) { x = x > y ? x : y; }
    static unsigned negative(Int4 x) {
        unsigned bits = 0;
        for (int k = 0; k < 4; ++k) bits |= x[k] < 0 ? 1U << k : 0U;
        return bits;
    }
    static std::uint64_t pack(Int4 low, Int4 high) {
        std::uint64_t bytes = 0;
        for (int k = 0; k < 8; ++k) {
            const int x = k < 4 ? low[k] : high[k - 4];
            bytes |= static_cast<std::uint64_t>((x < -128 ? -128 : x > 127 ? 127 : x) & 0xff) << (8 * k);
        }
        return bytes;
    }
    static unsigned count_bits(std::uint64_t x) { return count_bits_by_halves(x); }

    using Bytes = std::uint64_t;
    static Bytes bytes(std::uint64_t x) { return x; }
    static unsigned left(const std::uint64_t* box, Bytes above, Bytes seen) {
        if ((*box & seen) != 0) return 0;
        for (int place = 0; place < 64; place += 8)
            if (static_cast<signed char>(*box >> place & 0xff) > static_cast<signed char>(above >> place & 0xff)) return 0;
        return 1;
    }
};

int block_plain(const PackedLevel& level, const double* half_from, const double* half_to, Stop* stops) {
    return block<Plain>(level, half_from, half_to, stops);
}

int look_plain(const PackedLevel& level, const double* half_from, const double* half_to, std::uint32_t* out, unsigned room, unsigned* cells) {
    return look<Plain>(level, half_from, half_to, out, room, cells);
}

Walking start_walk_plain(const PackedLevel& level, const double* half_from, const double* half_to, double limit, bool once, Walk& walk) {
    return start_walk<Plain>(level, half_from, half_to, limit, once, walk);
}

unsigned walk_plain(const PackedLevel& level, Walk& walk, double limit, Stop* stops, unsigned room) {
    return walk_on<Plain>(level, walk, limit, stops, room);
}

unsigned cull_plain(const std::uint64_t* boxes, const std::uint32_t* ids, unsigned count, std::uint64_t above, std::uint64_t seen,
                    std::uint32_t* out) {
    return cull<Plain>(boxes, ids, count, above, seen, out);
}

template <class Scalar>
unsigned refine_plain(const Probe<Scalar>& probe, const Scalar* corners, std::uint32_t* ids, unsigned count, std::uint32_t* out) {
    return refine<Plain>(probe, corners, ids, count, out);
}

}  // namespace

const Backend k_plain = {"plain", block_plain, look_plain, start_walk_plain, walk_plain, cull_plain, refine_plain<float>, refine_plain<double>};

}  // namespace pierce::detail
