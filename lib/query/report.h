// The one place where the values of a decided hit are rounded: fraction, weights, normal, and the verified point.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <exact/decide.h>
#include <exact/fraction.h>
#include <exact/planes.h>
#include <kernel/filter.h>
#include <pierce/hit.h>

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

/// The face's normal up to a factor, each component within 2^-28 (for float) or 2^-52 (for double) of the largest.
template <class Scalar>
[[nodiscard]] Point normal_of(const Corners& corners) {
    if constexpr (std::is_same_v<Scalar, float>) {
        const Normal n(corners);
        if (n.certain && n.error <= 0x1p-29 * Volumes64::largest(n.normal)) return n.normal;
    }
    return exact_planes(corners).normal;
}

/// Everything but `fraction` and `point`; `normal` is that of `normal_of`.
template <class Scalar>
[[nodiscard]] Hit<Scalar> report(const Path& path, const Corners& corners, const Point& normal, const Decision& decision,
                                 std::uint32_t face, std::uint32_t triangle) {
    Measures measures{};
    // On an edge or at the start some values are exactly 0, which only exact arithmetic gives.
    const bool plain = decision.feature == Feature::face && !decision.at_start;
    if (!(std::is_same_v<Scalar, float> && plain && measure_for_float(corners, path, measures)))
        measures = measure(path, corners);
    const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    Hit<Scalar> hit{};
    for (int k = 0; k < 3; ++k) {
        const auto at = static_cast<std::size_t>(k);
        hit.normal[k] = static_cast<Scalar>(normal[at] / length);
        hit.barycentric[k] = static_cast<Scalar>(measures.barycentric[at]);
    }
    hit.exact_fraction = static_cast<Scalar>(measures.fraction);
    hit.face = face;
    hit.triangle = triangle;
    hit.side = decision.side;
    hit.feature = decision.feature;
    hit.feature_index = decision.feature_index;
    hit.at_start = decision.at_start;
    return hit;
}

template <class Scalar>
[[nodiscard]] Scalar rounded_down(double x) {
    const auto near = static_cast<Scalar>(x);
    return static_cast<double>(near) > x ? std::nextafter(near, -std::numeric_limits<Scalar>::infinity()) : near;
}

/// The representable point nearest to `from + fraction (to - from)`, as computed, and never outside of the box of both ends.
template <class Scalar>
[[nodiscard]] Vec3<Scalar> point_at(const Path& path, Scalar fraction) {
    Vec3<Scalar> point;
    for (int k = 0; k < 3; ++k) {
        const auto at = static_cast<std::size_t>(k);
        const double from = path.from[at];
        const double to = path.to[at];
        // Half the difference can't overflow; doubling it by two additions can't either, as the sum stays between the ends.
        const double half = static_cast<double>(fraction) * (to / 2 - from / 2);
        const double x = std::clamp(from + half + half, std::min(from, to), std::max(from, to));
        point[k] = static_cast<Scalar>(x);
    }
    return point;
}

/// Sets `fraction` and `point` of a hit so that the segment from -> point has no hit: none of the hit's own triangle, as the point
/// stays on the near side of its plane or on it (`side(point)`), and none of any other, which `clear(point)` says. `from` itself
/// needs no proof. Returns how many points were tried and not taken.
///
/// The rounded point of a true hit lies behind the face about half of the time. The first to be tried is that point; then, along
/// the segment, one moved back by as much as rounding can have moved the point through the plane; then four times
/// as far each time.
template <class Scalar, class Side, class Clear>
int verify(Hit<Scalar>& hit, const Path& path, const Point& normal, Side&& side, Clear&& clear) {
    double rate = 0;   // of the distance from the plane, in units of |normal|, along the whole segment
    double noise = 0;  // what rounding a point's coordinates can do to that distance
    for (std::size_t k = 0; k < 3; ++k) {
        rate += normal[k] * (path.to[k] / 2 - path.from[k] / 2);
        const double largest = std::max(std::abs(path.from[k]), std::abs(path.to[k]));
        noise += std::abs(normal[k]) * std::max(largest * static_cast<double>(std::numeric_limits<Scalar>::epsilon()),
                                                static_cast<double>(std::numeric_limits<Scalar>::denorm_min()));
    }
    double back = noise / std::abs(2 * rate);
    if (!(back > 0)) back = 1;

    const int outside = hit.side == Sides::front ? 1 : -1;
    const auto exact = static_cast<double>(hit.exact_fraction);
    int tries = 0;
    // Two steps below the rounded fraction is below the true one; among denormal numbers a step is no longer relative.
    double fraction = exact * (1 - 2 * static_cast<double>(std::numeric_limits<Scalar>::epsilon()));
    if (fraction < static_cast<double>(std::numeric_limits<Scalar>::min())) fraction = 0;
    for (; fraction > 0; ++tries) {
        hit.fraction = rounded_down<Scalar>(fraction);
        hit.point = point_at(path, hit.fraction);
        const Point point = to_point(hit.point);
        if (point == path.from) break;
        if (side(point) * outside >= 0 && clear(point)) return tries;
        fraction = exact - back;
        back *= 4;
    }
    hit.fraction = 0;
    for (int k = 0; k < 3; ++k) hit.point[k] = static_cast<Scalar>(path.from[static_cast<std::size_t>(k)]);
    return tries;
}

}  // namespace pierce::detail
