// From a hit that was found to a hit that is answered: its values, and its verified point.
#pragma once

#include <optional>

#include <query/collectors.h>
#include <query/place.h>
#include <query/report.h>
#include <query/traverse.h>

namespace pierce::detail {

/// What place() asks about the ways from a hit's start to other points. Its own triangle is no matter: place() has seen
/// to that.
template <class Kernel, class Scalar, class Passed>
struct OtherWays {
    const Scene<Scalar>& scene;
    const Path& path;
    TriangleRef own;
    const Passed& passed;
    const QueryOptions& options;
    QueryCounters& counters;
    const Shortlist* list;

    mutable unsigned last = 0;  ///< of the list, what stopped a way: likely to stop the next one too

    [[nodiscard]] bool clear(const Point& point, bool near) const {
        const Path way{path.from, point};
        Any any(passed, own);
        if (near && list != nullptr && list->complete) {
            if (last < list->count) test_triangle<Kernel>(scene, way, list->triangles[last], options, counters, any);
            for (unsigned i = 0; i < list->count && !any.found(); ++i) {
                test_triangle<Kernel>(scene, way, list->triangles[i], options, counters, any);
                if (any.found()) last = i;
            }
        } else {
            traverse<Kernel>(scene, way, options, counters, any);
        }
        return !any.found();
    }
    [[nodiscard]] bool stops(const Point& point, Corners& corners, Decision& decision) const {
        const Path way{path.from, point};
        FirstOther<Scalar, Passed> first(scene, way, counters, passed, own);
        if (list != nullptr && list->complete) {
            for (unsigned i = 0; i < list->count; ++i)
                test_triangle<Kernel>(scene, way, list->triangles[i], options, counters, first);
        } else {
            traverse<Kernel>(scene, way, options, counters, first);
        }
        if (!first.found()) return false;
        corners = scene.corners(first.best().triangle);
        decision = first.best().decision;
        return true;
    }
};

/// Writes the hit of a candidate, to where the caller wants it: a copy of what was just written number by number would
/// wait for memory. `passed(triangle)` says which triangles are hit strictly before it, and so on the way to any point
/// near it. With a complete list of the query's triangles nothing else is asked again.
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
    const OtherWays<Kernel, Scalar, Passed> ways{scene, path, triangle, passed, whole, counters, list};
    const int tries = place<Scalar>(path, corners, candidate.decision, scene.grain, measures.fraction, face, counters, ways, hit);
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
