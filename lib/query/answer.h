// From a hit that was found to a hit that is answered: its values, and its verified point.
#pragma once

#include <optional>

#include <query/collectors.h>
#include <query/report.h>
#include <query/traverse.h>

namespace pierce::detail {

/// The hit of a candidate. `passed(triangle)` says which triangles are hit strictly before it, and so on the way to any point near
/// it. With a complete `shortlist` of the query's triangles the grid is not asked again.
template <class Kernel, class Scalar, class Passed>
[[nodiscard]] Hit<Scalar> answer(const Scene<Scalar>& scene, const Path& path, const Candidate& candidate, const Passed& passed,
                                 const QueryOptions& options, QueryCounters& counters, Shortlist* shortlist = nullptr) {
    const std::uint32_t triangle = candidate.triangle;
    typename Kernel::template Face<Scalar> face(scene.corners(triangle), counters);
    const Point normal = face.normal();
    Hit<Scalar> hit = report<Scalar>(face.measures(path, candidate.decision), normal, candidate.decision, scene.face_of(triangle),
                                     scene.triangle_numbers[triangle]);
    QueryOptions whole = options;
    whole.max_fraction = 1;  // a nearer limit was meant for the caller's own segment
    const auto side = [&](const Point& point) { return face.side(point); };
    const auto clear = [&](const Point& point) {
        Search<Scalar> search(scene, {path.from, point}, options.sides);
        Any any(passed, triangle);  // verify() has seen to the hit's own triangle
        if (shortlist != nullptr && shortlist->complete) {
            test_triangles<Kernel>(search, shortlist->ids, shortlist->count, whole, counters, any);
        } else {
            traverse<Kernel>(search, whole, counters, any);
        }
        return !any.found();
    };
    const int tries = verify(hit, path, normal, side, clear);
    counters.retreats += static_cast<std::uint64_t>(tries);
    return hit;
}

[[nodiscard]] inline bool none_passed(std::uint32_t) { return false; }

template <class Kernel, class Scalar>
[[nodiscard]] std::optional<Hit<Scalar>> first_answer(const Scene<Scalar>& scene, const Path& path, const QueryOptions& options,
                                                      QueryCounters& counters) {
    Search<Scalar> search(scene, path, options.sides);
    First<Scalar> first(scene, path, counters);
    Ids ids;
    Shortlist shortlist(ids.data());
    traverse<Kernel>(search, options, counters, first, &shortlist);
    if (!first.found()) return std::nullopt;
    return answer<Kernel>(scene, path, first.best(), none_passed, options, counters, &shortlist);
}

}  // namespace pierce::detail
