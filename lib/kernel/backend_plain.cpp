// One number at a time, for machines whose instruction set has no file of its own, and to compare the others with; see
// set_probe.h.
#include <kernel/table.h>

namespace pierce::detail {

namespace {

struct Plain {
    static constexpr unsigned width = 1;
    using Float = float;
    using Mask = bool;

    static Float all(float x) { return x; }
    static Float all_bits(std::uint32_t x) {
        float y;
        __builtin_memcpy(&y, &x, sizeof y);
        return y;
    }
    static Float load(const float* x) { return *x; }
    static Float abs(Float x) { return x < 0 ? -x : x; }
    static Float max(Float x, Float y) { return x > y ? x : y; }
    static Float min(Float x, Float y) { return x < y ? x : y; }
    static Float multiply_add(Float x, Float y, Float z) { return x * y + z; }
    static Mask below(Float x, Float y) { return x < y; }
    static Mask at_most(Float x, Float y) { return x <= y; }
    static Mask both(Mask x, Mask y) { return x && y; }
    static Mask either(Mask x, Mask y) { return x || y; }
    static unsigned bits(Mask x) { return x ? 1 : 0; }
    static Float none_where(Mask mask, Float key) { return mask ? __builtin_inff() : key; }
    static Float none_but(Mask mask, Float key) { return mask ? key : __builtin_inff(); }

    static Float words(const std::uint16_t* x) { return *x; }
    static Float bytes(const std::uint8_t* x) { return *x; }

    static constexpr unsigned words_width = 1;
    using Words = std::uint16_t;
    static Words all_words(std::uint16_t x) { return x; }
    static Words load_words(const std::uint16_t* x) { return *x; }
    static Words above(Words x, Words y) { return x > y ? 1 : 0; }
    static Words either(Words x, Words y) { return static_cast<Words>(x | y); }
    static unsigned zeros(Words x) { return x == 0 ? 1 : 0; }

    static Float key(Float entry, unsigned first) {
        std::uint32_t x;
        __builtin_memcpy(&x, &entry, sizeof x);
        return all_bits((x & ~15U) | first);
    }
    static Mask same(Float x, Float y) { return x == y; }
    static Float least(Float x, Float y) { return x < y ? x : y; }
    static std::uint32_t least_of(Float x) {
        std::uint32_t bits;
        __builtin_memcpy(&bits, &x, sizeof bits);
        return bits;
    }

    template <class Scalar>
    static Float corner_row(const Scalar* row, Scalar origin, Scalar scale) {
        return static_cast<float>((*row - origin) * scale);
    }
    static Float row_difference(const double* x, const double* y, double scale) {
        return static_cast<float>((*x - *y) * scale);
    }
};

}  // namespace

constinit const Backend k_plain = backend_named<Plain>("plain");

}  // namespace pierce::detail
