// Fractions of a way from the sides of its ends: their order, exactly. For any volumes with from_side() and to_side().
//
// For a triangle that is hit or touched, from_side = F and to_side = T have opposite signs, or one of them is 0 and the
// other is not. So with A = |F| and B = |T| its fraction is A / (A + B), whichever side was hit, and A + B > 0.
#pragma once

#include <exact/magnitude.h>

namespace pierce::detail {

// A1 / (A1 + B1) < A2 / (A2 + B2)  <=>  A1 B2 < B1 A2, all of them >= 0, both sums > 0. A and B of one path are on one
// lattice, so both sides have the same unit, whatever the lattices are.
template <class One, class Other>
[[nodiscard]] int compare_shares(const One& one, const Other& other) {
    return compare_products(magnitude(one.from_side()), magnitude(other.to_side()), magnitude(one.to_side()),
                            magnitude(other.from_side()));
}

// The order of a and limit sum, for 0 < a <= sum and 0 < limit < 1.
template <int N>
[[nodiscard]] int compare_part(const Integer<N>& a, const Integer<N>& sum, double limit) {
    const Bits bits(limit);
    // a 2^shift against mantissa sum, where limit = mantissa / 2^shift. With mantissa < 2^53, a larger shift puts the
    // right side below 1.
    const int shift = -bits.exponent;
    if (shift > bit_length(sum) + 53) return 1;
    Integer<1> mantissa;
    mantissa.limb[0] = bits.mantissa;
    const Integer<2 * N + 2> left = widen<2 * N + 2>(a) << shift;
    return compare(left, widen<2 * N + 2>(sum * mantissa));
}

[[nodiscard]] inline int compare_part(const Magnitude& a, const Magnitude& sum, double limit) {
    return compare_products(a, Magnitude(1), sum, Magnitude(limit));
}

/// The order of the fraction and `limit`, which is at least 0.
template <class AnyVolumes>
[[nodiscard]] int compare_share(const AnyVolumes& volumes, double limit) {
    const auto a = magnitude(volumes.from_side());
    if (a.zero() || limit == 0) return a.zero() ? (limit > 0 ? -1 : 0) : 1;
    const auto b = magnitude(volumes.to_side());
    if (limit >= 1) return b.zero() && limit == 1 ? 0 : -1;
    // The sum of integers of 3 N limbs is below 2^(192 N - 4), see with_limbs.
    return compare_part(a, a + b, limit);
}

}  // namespace pierce::detail
