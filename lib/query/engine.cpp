// The queries: one traversal each, with the collector that makes the difference; crossings and winding numbers are sums
// over all candidates.
#include <query/engine.h>

#include <limits>

#include <exact/crossing.h>
#include <query/answer.h>
#include <query/ray_path.h>

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
            if (filtered.verdict == Verdict::hit && filtered.latest < path.end) {
                sum += filtered.decision.side == Sides::front ? 1 : -1;
            } else if (filtered.verdict != Verdict::miss) {
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

template <class Scalar, class Way>
int crossings(const Scene<Scalar>& scene, const Way& way, QueryCounters& counters) {
    Path path;
    if (!set_path(scene, way, std::numeric_limits<double>::infinity(), path)) return 0;
    return crossings_of(scene, path, counters);
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

#define PIERCE_QUERIES(Scalar, Way)                                                                                 \
    template std::optional<Hit<Scalar>> first_hit(const Scene<Scalar>&, const Way<Scalar>&, const QueryOptions&,    \
                                                  QueryCounters&);                                                 \
    template bool any_hit(const Scene<Scalar>&, const Way<Scalar>&, const QueryOptions&, QueryCounters&);          \
    template std::size_t all_hits(const Scene<Scalar>&, const Way<Scalar>&, std::span<Hit<Scalar>>,                \
                                  const QueryOptions&, QueryCounters&);                                            \
    template int crossings(const Scene<Scalar>&, const Way<Scalar>&, QueryCounters&)
PIERCE_QUERIES(float, Segment);
PIERCE_QUERIES(float, Ray);
PIERCE_QUERIES(double, Segment);
PIERCE_QUERIES(double, Ray);
#undef PIERCE_QUERIES
template int winding_number(const Scene<float>&, const Vec3<float>&, QueryCounters&);
template int winding_number(const Scene<double>&, const Vec3<double>&, QueryCounters&);

}  // namespace pierce::detail
