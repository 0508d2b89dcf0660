// Spheres against a scene: which triangles they enter, under the caller's options, and which of these is the first.
#pragma once

#include <cmath>

#include <pierce/sphere.h>
#include <query/certified.h>
#include <query/collectors.h>
#include <query/grain.h>
#include <query/sphere_near.h>
#include <sphere/enter.h>

namespace pierce::detail {

/// How far the furthest point of the scene is from a point in a coordinate, plus the radius; may be infinite.
template <class Scalar>
[[nodiscard]] double sphere_reach(const Scene<Scalar>& scene, const Point& from, double radius) {
    double reach = 0;
    for (std::size_t k = 0; k < 3; ++k)
        reach = std::max({reach, std::abs(scene.bounds.low[k] - from[k]), std::abs(scene.bounds.high[k] - from[k])});
    return (reach + radius) * (1 + 0x1p-50);
}

struct SphereCandidate : Entry {
    TriangleRef triangle;
    std::uint32_t face = 0;
    std::uint32_t number = 0;
};

/// Those that are in contact at the start come first, the deepest of them before others.
[[nodiscard]] inline bool comes_before(const SphereCandidate& x, const SphereCandidate& y) {
    if (x.time != y.time) return x.time < y.time;
    if (x.at_start != y.at_start) return x.at_start;
    if (x.at_start && x.distance != y.distance) return x.distance < y.distance;
    return x.face != y.face ? x.face < y.face : x.number < y.number;
}

/// The side of the triangle's plane that the center is on.
[[nodiscard]] inline Sides side_of(const Corners& corners, const Entry& entry) {
    const Point n = direction_from(corners, Nearest{.point = corners[0]}, corners[0]);
    return dot(n, entry.normal) < 0 ? Sides::back : Sides::front;
}

/// What is asked of a scene.
template <class Scalar>
struct SphereQuery {
    const Scene<Scalar>& scene;
    const QueryOptions& options;
    QueryCounters& counters;

    /// Whether the triangle is entered, no later than `limit`, and counts.
    [[nodiscard]] bool enters(const Sphere& sphere, TriangleRef triangle, double limit,
                              SphereCandidate& candidate) const {
        return counts(triangle, candidate, [&](const Corners& corners, SphereCounts& exact) {
            return detail::enters(sphere, corners, limit, exact, candidate);
        });
    }
    [[nodiscard]] bool touches(const Sphere& sphere, TriangleRef triangle, SphereCandidate& candidate) const {
        return counts(triangle, candidate, [&](const Corners& corners, SphereCounts& exact) {
            return detail::touches(sphere, corners, exact, candidate);
        });
    }

  private:
    template <class Test>
    [[nodiscard]] bool counts(TriangleRef triangle, SphereCandidate& candidate, Test&& test) const {
        if (masked(scene, triangle, options)) return false;
        const Corners corners = scene.corners(triangle);
        SphereCounts exact;
        const bool is_hit = test(corners, exact);
        counters.exact_decisions += exact.exact;
        if (!is_hit) return false;
        candidate.triangle = triangle;
        candidate.number = scene.number_of(triangle);
        candidate.face = scene.face_of_number(candidate.number);
        if (!options.accept) return true;
        const Nearest& nearest = candidate.nearest;
        return options.accept({candidate.face,
                               candidate.number,
                               side_of(corners, candidate),
                               nearest.feature,
                               static_cast<std::uint8_t>(nearest.index),
                               candidate.at_start,
                               candidate.time,
                               {1 - nearest.second - nearest.third, nearest.second, nearest.third}});
    }
};

/// The entry that comes before all others.
template <class Scalar>
class FirstEntry {
  public:
    FirstEntry(const SphereQuery<Scalar>& query, const Sphere& sphere, double most)
        : query_(query), sphere_(sphere), limit_(most) {}

    void test(TriangleRef triangle) {
        SphereCandidate candidate;
        if (!query_.enters(sphere_, triangle, limit_, candidate)) return;
        if (found_ && !comes_before(candidate, best_)) return;
        found_ = true;
        best_ = candidate;
        limit_ = candidate.time;
    }
    /// An entry's time is a lower bound: the triangle may be reached as much later as `width`.
    [[nodiscard]] double limit() const { return limit_ + sphere_.width * (1 + 0x1p-50); }
    [[nodiscard]] bool found() const { return found_; }
    [[nodiscard]] const SphereCandidate& best() const { return best_; }

  private:
    const SphereQuery<Scalar>& query_;
    const Sphere& sphere_;
    double limit_;
    bool found_ = false;
    SphereCandidate best_;
};

/// `margin`: how far off the path other ways may lead that the list is to be good for. Null: no list is kept.
template <class Scalar>
void each_entry(const Scene<Scalar>& scene, const Sphere& sphere, double margin, QueryCounters& counters,
                FirstEntry<Scalar>& first, Shortlist* list) {
    each_near(scene, sphere.path, sphere.radius + margin, first.limit(), counters, [&](TriangleRef triangle) {
        first.test(triangle);
        if (list != nullptr) list->add(triangle);
        return first.limit();
    });
}

}  // namespace pierce::detail
