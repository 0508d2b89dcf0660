// Queries about spheres: the first triangle that a swept one enters, all of them, and those that touch one at rest.
#include <query/spheres.h>

#include <query/sphere_hits.h>
#include <query/sphere_sweep.h>

namespace pierce::detail {

template <class Scalar>
std::optional<SphereHit<Scalar>> sweep_sphere(const Scene<Scalar>& scene, const Segment<Scalar>& step, Scalar radius,
                                              const QueryOptions& options, QueryCounters& counters) {
    std::optional<SphereHit<Scalar>> hit;
    const Path path = to_path(step);
    if (scene.empty() || path.from == path.to) return hit;
    const SphereSweep<Scalar> sweep(scene, path, static_cast<double>(radius), std::min(options.max_fraction, 1.0),
                                    options, counters);
    if (!sweep.found()) return hit;
    const SphereCandidate& first = sweep.first();
    report(sweep.sphere(), first, side_of(scene.corners(first.triangle), first), sweep.place(), hit.emplace());
    return hit;
}

template <class Scalar>
std::size_t sphere_hits(const Scene<Scalar>& scene, const Segment<Scalar>& step, Scalar radius,
                        std::span<SphereHit<Scalar>> out, const QueryOptions& options, QueryCounters& counters) {
    const Path path = to_path(step);
    if (scene.empty() || path.from == path.to) return 0;
    const auto r = static_cast<double>(radius);
    const Sphere sphere(path, r, sphere_reach(scene, path.from, r));
    const SphereQuery<Scalar> query{scene, options, counters};
    const double most = std::min(options.max_fraction, 1.0);
    Kept kept(out, [](const SphereHit<Scalar>& x, const SphereHit<Scalar>& y) {
        return x.fraction != y.fraction ? x.fraction < y.fraction : number_before(x, y);
    });
    const auto test = [&](TriangleRef triangle, SphereCandidate& candidate) {
        return query.enters(sphere, triangle, most, candidate);
    };
    const double limit = most + sphere.width;
    each_near(scene, path, r, limit, counters, [&](TriangleRef triangle) {
        SphereCandidate candidate;
        if (!test(triangle, candidate) || is_anothers(query, candidate, test)) return limit;
        SphereHit<Scalar> hit;
        const Point center = plus(path.from, times(1 / sphere.unit, candidate.center));
        report(sphere, candidate, side_of(scene.corners(triangle), candidate), center, hit);
        kept.add(hit);
        return limit;
    });
    return kept.sort();
}

template <class Scalar>
std::size_t sphere_contacts(const Scene<Scalar>& scene, const Vec3<Scalar>& center, Scalar radius,
                            std::span<SphereHit<Scalar>> out, const QueryOptions& options, QueryCounters& counters) {
    if (scene.empty()) return 0;
    const Point at = to_point(center);
    const Path path{at, at};
    const auto r = static_cast<double>(radius);
    const Sphere sphere(path, r, sphere_reach(scene, at, r));
    const SphereQuery<Scalar> query{scene, options, counters};
    Kept kept(out, [](const SphereHit<Scalar>& x, const SphereHit<Scalar>& y) {
        return x.overlap != y.overlap ? x.overlap > y.overlap : number_before(x, y);
    });
    // The nearest first, of those that share what is touched.
    const auto test = [&](TriangleRef triangle, SphereCandidate& candidate) {
        if (!query.touches(sphere, triangle, candidate)) return false;
        candidate.at_start = true;
        return true;
    };
    each_near(scene, path, r, 1, counters, [&](TriangleRef triangle) {
        SphereCandidate candidate;
        if (!test(triangle, candidate) || is_anothers(query, candidate, test)) return 1.0;
        SphereHit<Scalar> hit;
        report(sphere, candidate, side_of(scene.corners(triangle), candidate), at, hit);
        kept.add(hit);
        return 1.0;
    });
    return kept.sort();
}

#define PIERCE_SPHERES(Scalar)                                                                                   \
    template std::optional<SphereHit<Scalar>> sweep_sphere(const Scene<Scalar>&, const Segment<Scalar>&, Scalar, \
                                                           const QueryOptions&, QueryCounters&);                 \
    template std::size_t sphere_hits(const Scene<Scalar>&, const Segment<Scalar>&, Scalar,                       \
                                     std::span<SphereHit<Scalar>>, const QueryOptions&, QueryCounters&);         \
    template std::size_t sphere_contacts(const Scene<Scalar>&, const Vec3<Scalar>&, Scalar,                      \
                                         std::span<SphereHit<Scalar>>, const QueryOptions&, QueryCounters&)
PIERCE_SPHERES(float);
PIERCE_SPHERES(double);
#undef PIERCE_SPHERES

}  // namespace pierce::detail
