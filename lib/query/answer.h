// From a hit that was found to a hit that is answered: its values, and its verified point.
#pragma once

#include <optional>

#include <query/collectors.h>
#include <query/report.h>
#include <query/traverse.h>

namespace pierce::detail {

/// Writes the hit of a candidate, to where the caller wants it: a copy of what was just written number by number would wait for memory.
/// `passed(triangle)` says which triangles are hit strictly before it, and so on the way to any point near it. With a complete
/// list of the query's triangles nothing else is asked again.
template <class Kernel, class Scalar, class Passed>
void answer(const Scene<Scalar>& scene, const Path& path, const Candidate& candidate, const Passed& passed, const QueryOptions& options,
            QueryCounters& counters, const Shortlist* list, Hit<Scalar>& hit) {
    const std::uint32_t triangle = candidate.triangle;
    const Corners corners = scene.corners(triangle);
    typename Kernel::template Face<Scalar> face(corners, counters);
    const Point normal = face.normal();
    report(face.measures(path, candidate.decision), normal, candidate.decision, scene.face_of(triangle), scene.triangle_numbers[triangle],
           hit);
    QueryOptions whole = options;
    whole.max_fraction = 1;  // a nearer limit was meant for the caller's own segment
    const auto side = [&](const Point& point) { return face.side(point); };
    const auto clear = [&](const Point& point) {
        const Path way{path.from, point};
        Any any(passed, triangle);  // verify() has seen to the hit's own triangle
        if (list != nullptr && list->complete) {
            for (unsigned i = 0; i < list->count && !any.found(); ++i)
                test_triangle<Kernel>(scene, way, list->ids[i], whole, counters, any);
        } else {
            Search<Scalar> search(scene, way, options.sides);
            traverse<Kernel>(search, whole, counters, any);
        }
        return !any.found();
    };
    const int tries = verify(hit, path, normal, options.sides, side, clear);
    counters.retreats += static_cast<std::uint64_t>(tries);
}

[[nodiscard]] inline bool none_passed(std::uint32_t) { return false; }

template <class Kernel, class Scalar>
[[nodiscard]] std::optional<Hit<Scalar>> first_answer(const Scene<Scalar>& scene, const Path& path, const QueryOptions& options,
                                                      QueryCounters& counters) {
    std::optional<Hit<Scalar>> hit;
    Ids ids;
    const Near near = look_near(scene, path, 0, ids, counters);
    if (near.count == 0) return hit;
    Search<Scalar> search(scene, path, options.sides);
    First<Scalar> first(scene, path, counters);
    Shortlist list;
    traverse<Kernel>(search, near, ids, options, counters, first, list);
    if (first.found()) answer<Kernel>(scene, path, first.best(), none_passed, options, counters, &list, hit.emplace());
    return hit;
}

}  // namespace pierce::detail
