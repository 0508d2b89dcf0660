// Coordinates as integers: every double is a whole multiple of some power of two, so any set of them is a set of
// integers on a common lattice. Only bit patterns are read: no rounding mode or flush-to-zero setting can interfere.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <type_traits>

#include <exact/integer.h>
#include <point.h>

namespace pierce::detail {

/// The bits of a finite double: value = (negative ? -1 : 1) * mantissa * 2^exponent, with mantissa < 2^53.
struct Bits {
    std::uint64_t mantissa;
    int exponent;
    bool negative;

    explicit Bits(double x) {
        const auto pattern = std::bit_cast<std::uint64_t>(x);
        const int biased = static_cast<int>((pattern >> 52) & 0x7ff);
        mantissa = pattern & ((std::uint64_t{1} << 52) - 1);
        if (biased != 0) mantissa |= std::uint64_t{1} << 52;
        exponent = std::max(biased, 1) - 1075;
        negative = (pattern >> 63) != 0;
    }
};

/// The finest lattice that a set of coordinates needs: multiples of 2^lowest with magnitudes below 2^highest.
struct Lattice {
    int lowest = 2000;
    int highest = -2000;

    void add(double x) {
        const Bits bits(x);
        if (bits.mantissa == 0) return;
        lowest = std::min(lowest, bits.exponent + std::countr_zero(bits.mantissa));
        highest = std::max(highest, bits.exponent + 64 - std::countl_zero(bits.mantissa));
    }
    void add(const Point& p) {
        for (double x : p) add(x);
    }
    /// Bits of the largest magnitude in units of the lattice; 0 when all coordinates are zero.
    [[nodiscard]] int bits() const { return std::max(highest - lowest, 0); }
};

template <int N>
using Vector = std::array<Integer<N>, 3>;

template <int N>
[[nodiscard]] inline Integer<N> on_lattice(double x, const Lattice& lattice) {
    const Bits bits(x);
    Integer<N> value;
    if (bits.mantissa == 0) return value;
    // Trailing zeros may reach below the lattice; what is left of the mantissa does not.
    const int zeros = std::countr_zero(bits.mantissa);
    value.limb[0] = bits.mantissa >> zeros;
    value = value << (bits.exponent + zeros - lattice.lowest);
    return bits.negative ? -value : value;
}

template <int N>
[[nodiscard]] inline Vector<N> on_lattice(const Point& p, const Lattice& lattice) {
    return {on_lattice<N>(p[0], lattice), on_lattice<N>(p[1], lattice), on_lattice<N>(p[2], lattice)};
}

template <int N>
[[nodiscard]] inline Vector<N> operator-(const Vector<N>& x, const Vector<N>& y) {
    return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}

template <int N>
[[nodiscard]] inline Vector<N> operator+(const Vector<N>& x, const Vector<N>& y) {
    return {x[0] + y[0], x[1] + y[1], x[2] + y[2]};
}

template <int N, int M>
[[nodiscard]] inline Vector<N + M> cross(const Vector<N>& x, const Vector<M>& y) {
    return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

template <int N, int M>
[[nodiscard]] inline Integer<N + M> dot(const Vector<N>& x, const Vector<M>& y) {
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/// Calls `f` with the number of limbs that coordinates of `bits` bits are computed in, or `wide` where they are too far
/// apart for any.
///
/// With coordinates below 2^b, b <= 64 N - 4, a difference is below 2^(b+1), a 2x2 minor of differences below 2^(2b+3),
/// a 3x3 determinant of differences (three products of a minor and a difference) below 2^(3b+6), that of a ray's end,
/// of which differences are below 2^(b+2), below 2^(3b+7), and where both ends are differences of two (difference.h)
/// below 2^(3b+9): all fit N, 2N and 3N limbs with their sign bit, and sums of two. 1 limb serves float meshes whose
/// coordinates span few exponents, 2 most others. Floats span up to 277 bits,
/// doubles 2098: there accumulator.h is faster than 5 limbs (800 against 1,300 ns a decision).
template <class F, class G>
decltype(auto) with_limbs(int bits, F&& f, G&& wide) {
    if (bits <= 60) return f(std::integral_constant<int, 1>{});
    if (bits <= 124) return f(std::integral_constant<int, 2>{});
    return wide();
}

}  // namespace pierce::detail
