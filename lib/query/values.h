// The values of a decided hit, each by the cheapest arithmetic that is certainly good enough: double, then exact.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <exact/decide.h>
#include <exact/fraction.h>
#include <exact/planes.h>
#include <kernel/filter.h>
#include <pierce/options.h>

namespace pierce::detail {

/// The values of a hit before they are rounded to float, from the filter's numbers, if those are good enough: the fraction within
/// 2^-30 of itself, the weights within 2^-28 of 1. That is below a tenth of a float's last place.
[[nodiscard]] inline bool measure_for_float(const Corners& corners, const Path& path, Measures& measures) {
    const Volumes64 x(corners, path);
    const double s = std::abs(x.s);
    const double start = x.s < 0 ? -x.v : x.v;
    // x / s with x off by ex and s by es (filter.h) is off by less than (ex + es) / (s - es), as x <= s; x / s itself by its part.
    const double least = s - x.es;
    if (!(x.in_range && least > 0 && start > 0 && x.ev * s + x.es * start <= 0x1p-31 * start * least)) return false;
    if (!(x.e + x.es <= 0x1p-29 * least)) return false;
    const auto share = [&](std::size_t k) { return std::clamp(x.weight[k] / x.s, 0.0, 1.0); };
    measures = {start / s, {share(0), share(1), share(2)}};
    return true;
}

/// Fraction and weights of a hit, before they are rounded to `Scalar`.
template <class Scalar>
[[nodiscard]] Measures measures_of(const Path& path, const Corners& corners, const Decision& decision, QueryCounters& counters) {
    Measures measures{};
    // On an edge or at the start some values are exactly 0, which only exact arithmetic gives.
    const bool plain = decision.feature == Feature::face && !decision.at_start;
    if (std::is_same_v<Scalar, float> && plain && measure_for_float(corners, path, measures)) return measures;
    ++counters.exact_values;
    return measure(path, corners);
}

/// The face's normal up to a factor, each component within 2^-28 (for float) or 2^-52 (for double) of the largest.
template <class Scalar>
[[nodiscard]] Point normal_of(const Corners& corners, QueryCounters& counters) {
    if constexpr (std::is_same_v<Scalar, float>) {
        const Normal n(corners);
        if (n.certain && n.error <= 0x1p-29 * Volumes64::largest(n.normal)) return n.normal;
    }
    ++counters.exact_values;
    return exact_planes(corners).normal;
}

/// The side of its plane that a point is on: as side_of.
[[nodiscard]] inline int side_of_plane(const Corners& corners, const Point& point, QueryCounters& counters) {
    const int side = certain_side(corners, point);
    if (side != 0) return side;
    ++counters.exact_sides;
    return side_of(corners, point);
}

}  // namespace pierce::detail
