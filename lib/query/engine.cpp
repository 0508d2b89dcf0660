// The queries: one traversal each, with the collector that makes the difference.
#include <query/engine.h>

#include <limits>

#include <exact/crossing.h>
#include <query/answer.h>

namespace pierce::detail {

template <class Scalar>
std::optional<Hit<Scalar>> first_hit(const Scene<Scalar>& scene, const Segment<Scalar>& segment, const QueryOptions& options,
                                     QueryCounters& counters) {
    return first_answer<Certified, Scalar>(scene, to_path(segment), options, counters);
}

template <class Scalar>
bool any_hit(const Scene<Scalar>& scene, const Segment<Scalar>& segment, const QueryOptions& options,
             QueryCounters& counters) {
    const Path path = to_path(segment);
    Ids ids;
    const Near near = look_near(scene, path, 0, ids, counters);
    if (near.count == 0) return false;
    Search<Scalar> search(scene, path, options.sides);
    Any any(none_passed);
    Shortlist unused;
    traverse<Certified>(search, near, ids, options, counters, any, unused);
    return any.found();
}

template <class Scalar>
std::size_t all_hits(const Scene<Scalar>& scene, const Segment<Scalar>& segment, std::span<Hit<Scalar>> out,
                     const QueryOptions& options, QueryCounters& counters) {
    const Path path = to_path(segment);
    Search<Scalar> search(scene, path, options.sides);
    All<Scalar> all(scene, path, out, counters);
    traverse<Certified>(search, options, counters, all);
    for (std::size_t i = 0; i < all.kept_count(); ++i) {
        const Candidate candidate = all.kept(i);
        // Hits that count and come strictly before. One that `accept` refuses on the way to `to` may count on the way to the point.
        const auto passed = [&](std::uint32_t triangle) {
            Candidate other;
            if (masked(scene, triangle, options)) return false;
            if (!Certified::test(scene.corners(triangle), triangle, path, options.sides, 1, counters, other)) return false;
            if (options.accept && !accepted(scene, path, other, options, counters)) return false;
            if (other.latest < candidate.earliest) return true;
            return other.earliest <= candidate.latest &&
                   compare_fractions(path, scene.corners(triangle), scene.corners(candidate.triangle)) < 0;
        };
        answer<Certified>(scene, path, candidate, passed, options, counters, nullptr, out[i]);
    }
    return all.total();
}

namespace {

template <class Scalar>
int crossings_of(const Scene<Scalar>& scene, const Path& path, QueryCounters& counters) {
    int sum = 0;
    Search<Scalar> search(scene, path, Sides::both);
    // The move is infinitesimal: a path that does not even touch a closed triangle does not cross it when moved either.
    visit_all_near(search, counters, [&](std::uint32_t* ids, unsigned count) {
        Ids left;
        const unsigned found = scene.backend->refine(search.probe(Certified::unit), scene.coordinates.data(), ids, count, left.data());
        counters.triangles += count;
        for (unsigned i = 0; i < found; ++i) {
            const Corners corners = scene.corners(left[i]);
            const Filtered filtered = filter(corners, path, Sides::both);
            if (filtered.verdict == Verdict::hit) {
                sum += filtered.side == Sides::front ? 1 : -1;
            } else if (filtered.verdict == Verdict::doubtful) {
                ++counters.exact_decisions;
                sum += crossing(path, corners);
            }
        }
    });
    return sum;
}

}  // namespace

template <class Scalar>
int crossings(const Scene<Scalar>& scene, const Segment<Scalar>& segment, QueryCounters& counters) {
    return crossings_of(scene, to_path(segment), counters);
}

template <class Scalar>
int winding_number(const Scene<Scalar>& scene, const Vec3<Scalar>& at, QueryCounters& counters) {
    const Point point = to_point(at);
    if (scene.grid.empty()) return 0;
    // Outside of the box, on the shortest way along an axis: in the infinitesimal step's sense a point on the box's upper side is
    // outside already, since the step goes up; below, it must lie beyond by the least there is.
    const Box& box = scene.grid.bounds();
    Path way{point, point};
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
        if (point[k] >= box.high[k] || point[k] < box.low[k]) return 0;
        const double below = std::nextafter(box.low[k], -std::numeric_limits<double>::infinity());
        for (const double target : {box.high[k], below}) {
            const double distance = std::abs(target - point[k]);
            // The first one is taken whatever its length, which may overflow.
            if (!std::isfinite(target) || (way.to != point && !(distance < shortest))) continue;
            shortest = distance;
            way.to = point;
            way.to[k] = target;
        }
    }
    return -crossings_of(scene, way, counters);
}

template std::optional<Hit<float>> first_hit(const Scene<float>&, const Segment<float>&, const QueryOptions&, QueryCounters&);
template bool any_hit(const Scene<float>&, const Segment<float>&, const QueryOptions&, QueryCounters&);
template std::size_t all_hits(const Scene<float>&, const Segment<float>&, std::span<Hit<float>>, const QueryOptions&,
                              QueryCounters&);
template int crossings(const Scene<float>&, const Segment<float>&, QueryCounters&);
template int winding_number(const Scene<float>&, const Vec3<float>&, QueryCounters&);
template std::optional<Hit<double>> first_hit(const Scene<double>&, const Segment<double>&, const QueryOptions&, QueryCounters&);
template bool any_hit(const Scene<double>&, const Segment<double>&, const QueryOptions&, QueryCounters&);
template std::size_t all_hits(const Scene<double>&, const Segment<double>&, std::span<Hit<double>>, const QueryOptions&,
                              QueryCounters&);
template int crossings(const Scene<double>&, const Segment<double>&, QueryCounters&);
template int winding_number(const Scene<double>&, const Vec3<double>&, QueryCounters&);

}  // namespace pierce::detail
