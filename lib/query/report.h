// The one place where the values of a decided hit are rounded: fraction, weights, normal, and the verified point.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <exact/decide.h>
#include <exact/fraction.h>
#include <pierce/hit.h>

namespace pierce::detail {

/// Writes everything but `fraction` and `point`, from what is certified (values.h).
template <class Scalar>
void report(const Measures& measures, const Point& normal, const Decision& decision, std::uint32_t face, std::uint32_t triangle,
            Hit<Scalar>& hit) {
    const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
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
/// stays on the near side of its plane or, where that is no passage, on it (`side(point)`), and none of any other, which
/// `clear(point)` says. `from` itself needs no proof. Returns how many points were tried and not taken.
///
/// The rounded point of a true hit lies behind the face about half of the time. The first to be tried is that point; then, along
/// the segment, one moved back by as much as rounding can have moved the point through the plane; then four times
/// as far each time.
template <class Scalar, class Side, class Clear>
int verify(Hit<Scalar>& hit, const Path& path, const Point& normal, Sides sides, Side&& side, Clear&& clear) {
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
    // Where both sides count, a point on the plane is in front of it: to get there from the back is a hit.
    const int least = sides == Sides::both && hit.side == Sides::back ? 1 : 0;
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
        if (side(point) * outside >= least && clear(point)) return tries;
        fraction = exact - back;
        back *= 4;
    }
    hit.fraction = 0;
    for (int k = 0; k < 3; ++k) hit.point[k] = static_cast<Scalar>(path.from[static_cast<std::size_t>(k)]);
    return tries;
}

}  // namespace pierce::detail
