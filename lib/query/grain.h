// The grain: how far off a face's plane a stopped point keeps, and how far from the true intersection it is looked for.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include <point.h>

namespace pierce::detail {

/// The grain, in units in the last place of the mesh's largest |coordinate|.
///
/// Rounding moves a point by up to half a unit a coordinate, sqrt(3) / 2 in all, along a normal; a target projected
/// onto the plane takes three such roundings (the product, the difference, the sum): 2.6 units. Four is the least power
/// of two above. Measured, landings stuck (S1), slides by the book in float (S4: 160 of 5 inclines, 4 rates, 8 offsets;
/// the 24 of the test at offsets 0 and 1000), exact entries a step at rest in double, tilted, height 1 (T1):
///   units                        1      2      3      4      5      6      8
///   stuck of 230,000             0      0      0      0      0      0      0
///   of 160 slides off by > 5 %   1      2      4      4      4      5      4
///   the test's worst share    .991   .571   .766   .991   .571   .766   .571
///   exact entries a step      1.08   1.11   1.14   1.17   1.33   1.36   1.42
/// (The .571 and .766 are one slide each, at 1 degree and 240 steps a second, whose first steps are parts of a unit.)
/// So none of the three tells a larger one from a smaller: what decides is the bound above. place_test.cpp has the
/// three loops; each column is that test built with another number here.
inline constexpr double k_grain_units = 4;

/// How far from the true intersection a point may lie, in the same units, before points back along the way are tried.
inline constexpr double k_reach_units = k_grain_units + 8;

template <class Scalar>
[[nodiscard]] double last_place(double largest) {
    using Limits = std::numeric_limits<Scalar>;
    const double unit = largest > 0 ? static_cast<double>(Limits::epsilon()) * std::ldexp(1.0, std::ilogb(largest)) : 0;
    return std::max(unit, static_cast<double>(Limits::denorm_min()));
}
template <class Scalar>
[[nodiscard]] double grain_of(double largest) {
    return k_grain_units * last_place<Scalar>(largest);
}
/// How far from the true intersection, in each coordinate, a point may be that `clear(point, true)` is asked about.
[[nodiscard]] constexpr double near_margin(double grain) { return grain * (k_reach_units / k_grain_units); }

template <class Scalar>
[[nodiscard]] Scalar rounded_down(double x) {
    const auto near = static_cast<Scalar>(x);
    return static_cast<double>(near) > x ? std::nextafter(near, -std::numeric_limits<Scalar>::infinity()) : near;
}

template <class Scalar>
[[nodiscard]] Point rounded_to(const Point& point) {
    const auto rounded = [](double x) { return static_cast<double>(static_cast<Scalar>(x)); };
    return {rounded(point[0]), rounded(point[1]), rounded(point[2])};
}

/// The number next to `x`, which is a Scalar and finite, in the direction of `sign`, which is not 0. Without a branch:
/// which
/// way it goes can't be predicted.
template <class Scalar>
[[nodiscard]] double next_to(double x, double sign) {
    using Bits = std::conditional_t<sizeof(Scalar) == 4, std::int32_t, std::int64_t>;
    constexpr Bits k_sign = std::numeric_limits<Bits>::min();
    const auto bits = std::bit_cast<Bits>(static_cast<Scalar>(x));
    const auto wanted = std::bit_cast<Bits>(static_cast<Scalar>(std::copysign(1.0, sign))) & k_sign;
    const Bits next = (bits & k_sign) == wanted ? bits + 1 : bits - 1;
    return static_cast<double>(std::bit_cast<Scalar>(x == 0 ? wanted | 1 : next));
}

}  // namespace pierce::detail
