// From a hit that was found to a hit that is answered: its values, and its verified point.
#pragma once

#include <optional>

#include <query/collectors.h>
#include <query/place.h>
#include <query/report.h>
#include <query/traverse.h>

namespace pierce::detail {

/// Writes the hit of a candidate, to where the caller wants it: a copy of what was just written number by number would wait for memory.
/// `passed(triangle)` says which triangles are hit strictly before it, and so on the way to any point near it. With a complete
/// list of the query's triangles nothing else is asked again.
template <class Kernel, class Scalar, class Passed>
void answer(const Scene<Scalar>& scene, const Path& path, const Candidate& candidate, const Passed& passed, const QueryOptions& options,
            QueryCounters& counters, const Shortlist* list, Hit<Scalar>& hit) {
    const TriangleRef triangle = candidate.triangle;
    const Corners corners = scene.corners(triangle);
    typename Kernel::template Face<Scalar> face(corners, counters);
    const Point normal = face.normal();
    const std::uint32_t number = scene.number_of(triangle);
    const Measures measures = face.measures(path, candidate.decision);
    report(measures, normal, candidate.decision, scene.face_of_number(number), number, hit);
    QueryOptions whole = options;
    whole.max_fraction = 1;  // a nearer limit was meant for the caller's own segment
    const auto clear = [&](const Point& point, bool near) {
        const Path way{path.from, point};
        Any any(passed, triangle);  // place() has seen to the hit's own triangle
        if (near && list != nullptr && list->complete) {
            for (unsigned i = 0; i < list->count && !any.found(); ++i)
                test_triangle<Kernel>(scene, way, list->triangles[i], whole, counters, any);
        } else {
            traverse<Kernel>(scene, way, whole, counters, any);
        }
        return !any.found();
    };
    const int tries = place<Scalar>(path, corners, candidate.decision, scene.grain, measures.fraction, face, counters, clear, hit);
    counters.retreats += static_cast<std::uint64_t>(tries);
}

[[nodiscard]] inline bool none_passed(TriangleRef) { return false; }

template <class Kernel, class Scalar>
[[nodiscard]] std::optional<Hit<Scalar>> first_answer(const Scene<Scalar>& scene, const Path& path, const QueryOptions& options,
                                                      QueryCounters& counters) {
    std::optional<Hit<Scalar>> hit;
    First<Scalar> first(scene, path, counters);
    Shortlist list;
    traverse<Kernel>(scene, path, options, counters, first, &list);
    if (first.found()) answer<Kernel>(scene, path, first.best(), none_passed, options, counters, &list, hit.emplace());
    return hit;
}

}  // namespace pierce::detail
