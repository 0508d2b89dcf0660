// Hits of spheres as they are answered: written, each contact once, in order.
#pragma once

#include <algorithm>
#include <span>

#include <query/kept.h>
#include <query/sphere_walk.h>

namespace pierce::detail {

/// `side`: of the triangle's plane, where the center is. All else is where `sphere` is: a mesh or a world.
template <class Scalar>
void report(const Sphere& sphere, const SphereCandidate& candidate, Sides side, const Point& center,
            SphereHit<Scalar>& hit) {
    const auto rounded = [](const Point& p) {
        return Coordinates<Scalar>(static_cast<Scalar>(p[0]), static_cast<Scalar>(p[1]), static_cast<Scalar>(p[2]));
    };
    hit = {};
    hit.fraction = rounded_down<Scalar>(candidate.time);
    hit.center = rounded(center);
    hit.contact = rounded(plus(sphere.path.from, times(1 / sphere.unit, candidate.nearest.point)));
    hit.normal = rounded(candidate.normal);
    if (candidate.overlaps) {
        const double depth = sphere.radius - candidate.distance / sphere.unit;
        hit.overlap = std::max(static_cast<Scalar>(depth), std::numeric_limits<Scalar>::denorm_min());
    }
    hit.face = candidate.face;
    hit.triangle = candidate.number;
    hit.side = side;
    hit.feature = candidate.nearest.feature;
    hit.feature_index = static_cast<std::uint8_t>(candidate.nearest.index);
    hit.at_start = candidate.at_start;
}

/// Whether another triangle is met before this one that has what is touched of it: then both are one contact, the other
/// one's. Faces come before edges and corners, so that those are left out that lie on faces which are hit already; then
/// the earlier one. As that is an order, one of those that are taken together is always left.
template <class Scalar, class Test>
[[nodiscard]] bool is_anothers(const SphereQuery<Scalar>& query, const SphereCandidate& candidate, Test&& test) {
    const auto& scene = query.scene;
    const Corners corners = scene.corners(candidate.triangle);
    const Feature feature = candidate.nearest.feature;
    const std::size_t first = candidate.nearest.index;
    const std::size_t count = feature == Feature::face ? 3 : feature == Feature::edge ? 2 : 1;
    bool found = false;
    const Path path{corners[first], corners[first]};
    each_near(scene, path, 0, 1, query.counters, [&](TriangleRef triangle) {
        if (found || triangle == candidate.triangle) return found ? -1.0 : 1.0;
        const Corners others = scene.corners(triangle);
        for (std::size_t k = 0; k < count; ++k)
            if (std::find(others.begin(), others.end(), corners[(first + k) % 3]) == others.end()) return 1.0;
        SphereCandidate other;
        if (!test(triangle, other)) return 1.0;
        const bool is_face = other.nearest.feature == Feature::face;
        found = is_face != (feature == Feature::face) ? is_face : comes_before(other, candidate);
        return found ? -1.0 : 1.0;
    });
    return found;
}

template <class Scalar>
[[nodiscard]] bool number_before(const SphereHit<Scalar>& x, const SphereHit<Scalar>& y) {
    return x.face != y.face ? x.face < y.face : x.triangle < y.triangle;
}

}  // namespace pierce::detail
