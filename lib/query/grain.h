// The grain: how far off a face's plane a stopped point keeps, and how far from the true intersection it is looked for
// (first_place.h has both in units); and roundings to Scalar.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include <kernel/first_place.h>
#include <point.h>

namespace pierce::detail {

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

/// `x` is at least 0.
template <class Scalar>
[[nodiscard]] Scalar rounded_down(double x) {
    const auto near = static_cast<Scalar>(x);
    using Bits = std::conditional_t<sizeof(Scalar) == 4, std::uint32_t, std::uint64_t>;
    return std::bit_cast<Scalar>(std::bit_cast<Bits>(near) - Bits{static_cast<double>(near) > x});
}

template <class Scalar>
[[nodiscard]] Point rounded_to(const Point& point) {
    const auto rounded = [](double x) { return static_cast<double>(static_cast<Scalar>(x)); };
    return {rounded(point[0]), rounded(point[1]), rounded(point[2])};
}

}  // namespace pierce::detail
