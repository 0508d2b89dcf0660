// One triangle at a time, for machines whose instruction set has no file of its own, and to compare the others with; see lanes.h.
#include <kernel/table.h>

namespace pierce::detail {

namespace {

struct Plain {
    static constexpr unsigned width = 1;
    static constexpr unsigned boxes = 1;
    using Float = float;

    static Float all(float x) { return x; }
    static Float load(const float* x) { return *x; }
    static Float abs(Float x) { return x < 0 ? -x : x; }
    static Float max(Float x, Float y) { return x > y ? x : y; }
    static Float min(Float x, Float y) { return x < y ? x : y; }
    static unsigned less(Float x, Float y) { return x < y ? 1 : 0; }

    static constexpr unsigned rows = 1;
    template <class Scalar>
    static const Scalar* same_row(const Scalar* x) {
        return x;
    }
    template <class Scalar>
    static const Scalar* row(const Scalar* const* at, unsigned i) {
        return at[i];
    }
    template <class Scalar>
    static Lanes<Plain> scaled(const Scalar* x, const Scalar* origin, float scale) {
        const auto difference = [&](unsigned k) { return static_cast<float>((x[k] - origin[k]) * Scalar{scale}); };
        return {difference(0), difference(1), difference(2)};
    }

    static void settle(Double4&) {}
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
    static unsigned keep(unsigned lanes, const std::uint32_t* ids, std::uint32_t* out) {
        *out = *ids;
        return lanes;
    }
};

}  // namespace

constinit const Backend k_plain = Kernels<Plain>::named("plain");

}  // namespace pierce::detail
