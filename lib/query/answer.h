// From a hit that was found to a hit that is answered: its values, and its verified point.
#pragma once

#include <optional>

#include <query/collectors.h>
#include <query/report.h>
#include <query/traverse.h>

namespace pierce::detail {

template <class Scalar>
[[nodiscard]] Hit<Scalar> reported(const Scene& scene, const Path& path, const Candidate& candidate) {
    return report<Scalar>(path, scene.corners(candidate.triangle), scene.prepared[candidate.triangle],
                          candidate.decision, scene.face_of(candidate.triangle), candidate.triangle);
}

/// Sets the verified point. `passed(triangle)` says which triangles are hit strictly before this one, and so on the way to any point
/// near it.
template <class Kernel, class Scalar, class Passed>
void place(const Scene& scene, Hit<Scalar>& hit, const Path& path, const Passed& passed, const QueryOptions& options,
           QueryCounters& counters) {
    QueryOptions whole = options;
    whole.max_fraction = 1;  // a nearer limit was meant for the caller's own segment
    const auto side = [&](const Point& point) { return Kernel::side(scene, hit.triangle, point); };
    const auto clear = [&](const Point& point) {
        Any any(passed, hit.triangle);  // verify() has seen to the hit's own triangle
        traverse<Kernel>(scene, {path.from, point}, whole, counters, any);
        return !any.found();
    };
    const int tries = verify(hit, path, scene.prepared[hit.triangle].normal, side, clear);
    counters.retreats += static_cast<std::uint64_t>(tries);
}

[[nodiscard]] inline bool none_passed(std::uint32_t) { return false; }

template <class Kernel, class Scalar>
[[nodiscard]] std::optional<Hit<Scalar>> first_answer(const Scene& scene, const Path& path, const QueryOptions& options,
                                                      QueryCounters& counters) {
    First first(scene, path, counters);
    traverse<Kernel>(scene, path, options, counters, first);
    if (!first.found()) return std::nullopt;
    Hit<Scalar> hit = reported<Scalar>(scene, path, first.best());
    place<Kernel>(scene, hit, path, none_passed, options, counters);
    return hit;
}

}  // namespace pierce::detail
