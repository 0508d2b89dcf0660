// The grain: how far off a face's plane a stopped point keeps, and how far from the true intersection it is looked for.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <point.h>

namespace pierce::detail {

/// The grain, in units in the last place of the mesh's largest |coordinate|.
///
/// Two units are what rounding a point of the mesh may do to its distance from a plane (half a unit a coordinate, sqrt(3) / 2 in all, for the point, and the
/// same for a target projected onto the plane). Measured: see tests/query/place_test.cpp.
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

/// The number next to `x` in the direction of `sign`, which is not 0.
template <class Scalar>
[[nodiscard]] double next_to(double x, double sign) {
    constexpr Scalar k_infinity = std::numeric_limits<Scalar>::infinity();
    return static_cast<double>(std::nextafter(static_cast<Scalar>(x), sign > 0 ? k_infinity : -k_infinity));
}

}  // namespace pierce::detail
