// The queries: one traversal each, with the collector that makes the difference; crossings and winding numbers are sums
// over all candidates.
#include <query/engine.h>

#include <limits>

#include <exact/crossing.h>
#include <query/answer.h>

namespace pierce::detail {

template <class Scalar>
std::optional<Hit<Scalar>> first_hit(const Scene<Scalar>& scene, const Segment<Scalar>& segment,
                                     const QueryOptions& options, QueryCounters& counters) {
    return first_answer<Certified, Scalar>(scene, to_path(segment), options, counters);
}

template <class Scalar>
bool any_hit(const Scene<Scalar>& scene, const Segment<Scalar>& segment, const QueryOptions& options,
             QueryCounters& counters) {
    Any any(none_passed);
    traverse<Certified>(scene, to_path(segment), options, counters, any);
    return any.found();
}

template <class Scalar>
std::size_t all_hits(const Scene<Scalar>& scene, const Segment<Scalar>& segment, std::span<Hit<Scalar>> out,
                     const QueryOptions& options, QueryCounters& counters) {
    const Path path = to_path(segment);
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

namespace {

// The move is infinitesimal: a path that does not even touch a closed triangle does not cross it when moved either.
template <class Scalar>
int crossings_of(const Scene<Scalar>& scene, const Path& path, QueryCounters& counters) {
    int sum = 0;
    each_candidate(scene, path, Sides::both, 1, counters, [&](ClusterRef cluster, unsigned lanes) {
        for (; lanes != 0; lanes &= lanes - 1) {
            const Corners corners = scene.corners({cluster, static_cast<std::uint32_t>(std::countr_zero(lanes))});
            Measured measured;
            measure_path<Scalar>(corners, path, measured);
            const Filtered filtered = filter_strictly(measured, Sides::both);
            if (filtered.verdict == Verdict::hit) {
                sum += filtered.decision.side == Sides::front ? 1 : -1;
            } else if (filtered.verdict == Verdict::doubtful) {
                ++counters.exact_decisions;
                sum += crossing(path, corners);
            }
        }
        return 1.0;
    });
    return sum;
}

/// The way out of the box that is shortest along an axis, tilted by some of its length along the two others: along an
/// axis it would follow the edges that models have there, which only exact arithmetic can tell from crossings. It ends
/// clearly outside: at the next number below 0 it would end among denormal numbers, and take the widest arithmetic. An
/// end beyond the box along one axis has winding number 0, wherever it is along the others.
[[nodiscard]] Path way_out(const Point& point, const Box& box) {
    Path way{point, point};
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
        const double margin = std::max({(box.high[k] - box.low[k]) * 0x1p-20, std::abs(box.low[k]) * 0x1p-40,
                                        std::abs(box.high[k]) * 0x1p-40, std::numeric_limits<double>::min()});
        for (const double target : {box.high[k] + margin, box.low[k] - margin}) {
            const double distance = std::abs(target - point[k]);
            // The first one is taken whatever its length, which may overflow.
            if (!std::isfinite(target) || (way.to != point && !(distance < shortest))) continue;
            shortest = distance;
            way.to = point;
            way.to[k] = target;
            const double some = std::isfinite(distance) ? distance : 0;
            for (std::size_t i = 1; i < 3; ++i) {
                double& other = way.to[(k + i) % 3];
                const double tilted = other + (i == 1 ? 0.0131 : 0.0277) * some;
                if (std::isfinite(tilted)) other = tilted;
            }
        }
    }
    return way;
}

}  // namespace

template <class Scalar>
int crossings(const Scene<Scalar>& scene, const Segment<Scalar>& segment, QueryCounters& counters) {
    return crossings_of(scene, to_path(segment), counters);
}

template <class Scalar>
int winding_number(const Scene<Scalar>& scene, const Vec3<Scalar>& at, QueryCounters& counters) {
    const Point point = to_point(at);
    if (scene.empty()) return 0;
    // In the infinitesimal step's sense a point on the box's upper side is outside already, since the step goes up;
    // below, it must lie beyond.
    for (std::size_t k = 0; k < 3; ++k)
        if (point[k] >= scene.bounds.high[k] || point[k] < scene.bounds.low[k]) return 0;
    return -crossings_of(scene, way_out(point, scene.bounds), counters);
}

template std::optional<Hit<float>> first_hit(const Scene<float>&, const Segment<float>&, const QueryOptions&,
                                             QueryCounters&);
template bool any_hit(const Scene<float>&, const Segment<float>&, const QueryOptions&, QueryCounters&);
template std::size_t all_hits(const Scene<float>&, const Segment<float>&, std::span<Hit<float>>, const QueryOptions&,
                              QueryCounters&);
template int crossings(const Scene<float>&, const Segment<float>&, QueryCounters&);
template int winding_number(const Scene<float>&, const Vec3<float>&, QueryCounters&);
template std::optional<Hit<double>> first_hit(const Scene<double>&, const Segment<double>&, const QueryOptions&,
                                              QueryCounters&);
template bool any_hit(const Scene<double>&, const Segment<double>&, const QueryOptions&, QueryCounters&);
template std::size_t all_hits(const Scene<double>&, const Segment<double>&, std::span<Hit<double>>, const QueryOptions&,
                              QueryCounters&);
template int crossings(const Scene<double>&, const Segment<double>&, QueryCounters&);
template int winding_number(const Scene<double>&, const Vec3<double>&, QueryCounters&);

}  // namespace pierce::detail
