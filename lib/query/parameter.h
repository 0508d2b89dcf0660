// Fractions of a path as the caller's parameters: the same of a segment, a power of two times as much of a ray.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <path.h>

namespace pierce::detail {

/// Rounded where it is subnormal; not above the largest number.
[[nodiscard]] inline double to_parameter(const Path& path, double fraction) {
    if (!path.ray) return fraction;
    return std::min(std::ldexp(fraction, path.exponent), std::numeric_limits<double>::max());
}

/// Not above the parameter of the fraction.
[[nodiscard]] inline double parameter_below(const Path& path, double fraction) {
    if (!path.ray) return fraction;
    const double parameter = to_parameter(path, fraction);
    const bool rounded = parameter < std::numeric_limits<double>::min();
    return rounded ? std::max(0.0, parameter - std::numeric_limits<double>::denorm_min()) : parameter;
}

}  // namespace pierce::detail
