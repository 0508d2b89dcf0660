// Where a particle that slides along planes may be sent: the representable point nearest to where it would go that is
// certainly in front of all of them.
//
// A way along a plane ends on it, and half of the points that it may be rounded to are behind: from there the next step
// hits at its start, and every such step is lost. So the end is lifted off each plane to a grain where it would be
// nearer than half of that, by the least vector that does it for all planes; then it is rounded, and asked exactly
// whether it is in front of each. Where the heights were wrong, as far away as a plane is known too badly in double,
// the planes that it is behind of ask for more, twice as much each time.
//
// Not lifted unless it has to be: each lift is rounded, and what is rounded in the same direction step by step adds up.
// Heights go up and down by rounding, so that after some hundred steps the particle would be too far off for a contact;
// then it would go to the hit's point, and in a valley begin to swing. So it is lowered where it is two grains off.
// Where the way is less than rounding nothing is lifted: between two walls the particle would go to and fro.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include <kernel/first_place.h>
#include <query/grain.h>
#include <query/half_spaces.h>
#include <response/velocity.h>

namespace pierce::detail {

/// A plane that a particle is in contact with. `Surface`: as in a cast (mesh_cast.h).
template <class Surface>
struct Plane {
    Point normal;   ///< unit, towards the particle
    double height;  ///< of the particle
    Surface surface;
    std::uint32_t triangle;
};

/// A lift along the mean of the normals, where the least one is not found: of planes that are nearly one.
template <class Surface>
[[nodiscard]] bool lift_in_common(std::span<const Plane<Surface>> planes,
                                  const std::array<double, HalfSpaces::k_most>& least, double furthest, Point& lift) {
    Point mean{};
    for (const Plane<Surface>& plane : planes) mean = plus(mean, 1, plane.normal);
    double most = 0;
    for (std::size_t i = 0; i < planes.size(); ++i)
        most = std::max(most, least[i] / dot_product(planes[i].normal, mean));
    lift = times(most, mean);
    bool enough = dot_product(lift, lift) <= furthest * furthest;
    for (std::size_t i = 0; i < planes.size(); ++i) enough = enough && dot_product(planes[i].normal, mean) > 0;
    return enough;
}

/// `end` lifted over all planes by at least `least`, in units, rounded to Scalar, so that what goes there from `from`
/// is certainly in front of them; false: no such point is certain. `furthest`: how far it may be lifted.
template <class Scalar, class Cast>
[[nodiscard]] bool lift_over(const Cast& cast, const Point& from, const Point& end,
                             std::span<const Plane<typename Cast::Surface>> planes,
                             std::array<double, HalfSpaces::k_most> least, double furthest, Point& target) {
    const double unit = cast.grain() / k_grain_units;
    constexpr int k_most_tries = 5;
    double more = 1;
    for (int tries = 0; tries < k_most_tries; ++tries, more *= 2) {
        HalfSpaces spaces;
        for (std::size_t i = 0; i < planes.size(); ++i) spaces.push({planes[i].normal, least[i]});
        Point lift{};
        if (!spaces.nearest(furthest, lift) && !lift_in_common(planes, least, furthest, lift)) break;
        const Point lifted = rounded_to<Scalar>(plus(end, unit, lift));
        bool in_front = true;
        for (std::size_t i = 0; i < planes.size(); ++i) {
            if (cast.in_front(planes[i].surface, from, lifted)) continue;
            in_front = false;
            least[i] = dot_product(planes[i].normal, lift) + more;
        }
        if (!in_front) continue;
        target = lifted;
        return true;
    }
    return false;
}

/// From `from` by `way`, rounded to Scalar. Where no such point is certain it is where it would be without planes.
template <class Scalar, class Cast>
void aim(const Cast& cast, const Point& from, const Point& way, std::span<const Plane<typename Cast::Surface>> planes,
         Point& target) {
    target = rounded_to<Scalar>(plus(from, 1, way));
    if (planes.empty() || target == from) return;
    const double unit = cast.grain() / k_grain_units;
    Point lowered = way;
    for (const Plane<typename Cast::Surface>& plane : planes)
        if (plane.height > 2 * cast.grain() && dot_product(plane.normal, way) < cast.grain())
            lowered = plus(lowered, cast.grain() - plane.height, plane.normal);
    std::array<double, HalfSpaces::k_most> least{};
    for (std::size_t i = 0; i < planes.size(); ++i) {
        // In units. The way that rounding takes is not part of it.
        const double height = (planes[i].height + dot_product(planes[i].normal, lowered)) / unit;
        least[i] = (height < k_grain_units / 2 ? k_grain_units : k_grain_units / 2) - height;
    }
    constexpr double k_furthest = 64;
    (void)lift_over<Scalar>(cast, from, plus(from, 1, lowered), planes, least, k_furthest, target);
}

}  // namespace pierce::detail
