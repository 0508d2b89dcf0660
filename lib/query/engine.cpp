// The queries: one traversal each, with the collector that makes the difference; crossings and winding numbers are sums
// over all candidates.
#include <query/engine.h>

#include <query/answer.h>
#include <query/counting.h>

namespace pierce::detail {

template <class Scalar, class Way>
std::optional<Hit<Scalar>> first_hit(const Scene<Scalar>& scene, const Way& way, const QueryOptions& options,
                                     QueryCounters& counters) {
    Path path;
    if (!set_path(scene, way, options.max_fraction, path)) return std::nullopt;
    return first_answer<Certified, Scalar>(scene, path, options, counters);
}

template <class Scalar, class Way>
bool any_hit(const Scene<Scalar>& scene, const Way& way, const QueryOptions& options, QueryCounters& counters) {
    Path path;
    if (!set_path(scene, way, options.max_fraction, path)) return false;
    Any any(none_passed);
    traverse<Certified>(scene, path, options, counters, any);
    return any.found();
}

template <class Scalar, class Way>
std::size_t all_hits(const Scene<Scalar>& scene, const Way& way, std::span<Hit<Scalar>> out,
                     const QueryOptions& options, QueryCounters& counters) {
    Path path;
    if (!set_path(scene, way, options.max_fraction, path)) return 0;
    All<Scalar> all(scene, path, out, counters);
    traverse<Certified>(scene, path, options, counters, all);
    all.sort();
    TriangleRef before{};
    Candidate last;
    for (std::size_t i = 0; i < all.kept_count(); ++i) {
        Candidate candidate = All<Scalar>::candidate_of(out[i]);
        // Duplicates of one triangle, one behind the other: but for their numbers the answer is the same.
        if (i > 0 && scene.corners(candidate.triangle) == scene.corners(before)) {
            before = candidate.triangle;
            out[i] = out[i - 1];
            out[i].triangle = scene.number_of(before);
            out[i].face = scene.face_of(before);
            continue;
        }
        before = candidate.triangle;
        // Hits that count and come strictly before. One that `accept` refuses on the way to `to` may count on the way
        // to the point.
        const auto passed = [&](TriangleRef triangle) {
            Candidate other;
            if (masked(scene, triangle, options)) return false;
            if (!Certified::test(scene, triangle, path, options.sides, 1, counters, other)) return false;
            if (options.accept && !accepted(scene, path, triangle, other.decision, other.measured, options, counters))
                return false;
            if (other.latest < candidate.earliest) return true;
            return other.earliest <= candidate.latest &&
                   compare_fractions(path, scene.corners(triangle), scene.corners(candidate.triangle)) < 0;
        };
        measure_path<Scalar>(scene.corners(candidate.triangle), path, candidate.measured);
        answer<Certified>(scene, path, candidate, passed, options, counters, nullptr, out[i]);
        // Fractions that were rounded each by itself, within 1 ulp, may differ where the exact ones are equal, and go
        // back where they are not. So of equal ones the first one's value stands for all, and of others the larger of a
        // hit's own and the value before. Both are within 1 ulp of the true fraction f: a value from before belongs to
        // a true fraction g <= f, and is at most 1 ulp above g, so of f; and it is taken only where g = f, or where it
        // is larger than a value which is at most 1 ulp below f.
        if (i > 0) {
            const Scalar so_far = out[i - 1].exact_fraction;
            const bool equal = compare_exactly(scene, path, last, candidate, counters) == 0;
            out[i].exact_fraction = equal ? so_far : std::max(so_far, out[i].exact_fraction);
        }
        last = candidate;
    }
    return all.total();
}

template <class Scalar, class Way>
int crossings(const Scene<Scalar>& scene, const Way& way, QueryCounters& counters) {
    Path path;
    if (!set_path(scene, way, std::numeric_limits<double>::infinity(), path)) return 0;
    return crossings_of(scene, path, counters);
}

template <class Scalar>
int winding_number(const Scene<Scalar>& scene, const Vec3<Scalar>& at, QueryCounters& counters) {
    const Point point = to_point(at);
    if (is_clearly_outside(scene, point)) return 0;
    return -crossings_of(scene, way_out(point, OutTargets(scene.bounds)), counters);
}

#define PIERCE_QUERIES(Scalar, Way)                                                                              \
    template std::optional<Hit<Scalar>> first_hit(const Scene<Scalar>&, const Way<Scalar>&, const QueryOptions&, \
                                                  QueryCounters&);                                               \
    template bool any_hit(const Scene<Scalar>&, const Way<Scalar>&, const QueryOptions&, QueryCounters&);        \
    template std::size_t all_hits(const Scene<Scalar>&, const Way<Scalar>&, std::span<Hit<Scalar>>,              \
                                  const QueryOptions&, QueryCounters&);                                          \
    template int crossings(const Scene<Scalar>&, const Way<Scalar>&, QueryCounters&)
PIERCE_QUERIES(float, Segment);
PIERCE_QUERIES(float, Ray);
PIERCE_QUERIES(double, Segment);
PIERCE_QUERIES(double, Ray);
#undef PIERCE_QUERIES
template int winding_number(const Scene<float>&, const Vec3<float>&, QueryCounters&);
template int winding_number(const Scene<double>&, const Vec3<double>&, QueryCounters&);

}  // namespace pierce::detail
