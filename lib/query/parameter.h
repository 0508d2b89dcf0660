// Fractions of a path as the caller's parameters: the same of a segment, a power of two times as much of a ray.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <exact/fraction.h>
#include <path.h>

namespace pierce::detail {

/// Not above the largest number, and rounded where it is subnormal, or the fraction is.
[[nodiscard]] inline double scaled_fraction(const Path& path, double fraction) {
    return std::min(std::ldexp(fraction, path.exponent), std::numeric_limits<double>::max());
}

/// The parameter of a hit at a fraction. Where that is subnormal, or so small that it was rounded to 0, the parameter
/// need not be: the end of a ray's way may be 2^2000 times as far away as the hit. `corners` gives those of the
/// triangle.
template <class CornersOf>
[[nodiscard]] double to_parameter(const Path& path, double fraction, bool at_start, CornersOf&& corners) {
    if (!path.ray) return fraction;
    if (fraction < std::numeric_limits<double>::min() && !at_start) [[unlikely]]
        return std::min(measure_parameter(path, corners()), std::numeric_limits<double>::max());
    return scaled_fraction(path, fraction);
}

/// Not above the parameter of the fraction.
[[nodiscard]] inline double parameter_below(const Path& path, double fraction) {
    if (!path.ray) return fraction;
    const double parameter = scaled_fraction(path, fraction);
    const bool rounded = parameter < std::numeric_limits<double>::min();
    return rounded ? std::max(0.0, parameter - std::numeric_limits<double>::denorm_min()) : parameter;
}

}  // namespace pierce::detail
