// From a hit that was found to a hit that is answered: its values, and its verified point.
#pragma once

#include <optional>

#include <query/collectors.h>
#include <query/nearby.h>
#include <query/place.h>
#include <query/report.h>
#include <query/traverse.h>

namespace pierce::detail {

/// What place() asks about the ways from a hit's start to other points. Its own triangle is no matter: place() has seen
/// to that.
template <class Kernel, class Scalar, class Passed>
struct OtherWays {
    using Nearby = detail::Nearby<OtherWays>;

    const Scene<Scalar>& scene;
    const Path& path;
    TriangleRef own;
    const Passed& passed;
    const QueryOptions& options;
    QueryCounters& counters;
    const Shortlist* list;  ///< null: none was kept

    mutable Nearby* nearby = nullptr;  ///< where many near places are asked about
    mutable unsigned last = 0;         ///< of the list, what stopped a way: likely to stop the next one too

    [[nodiscard]] bool hides(const Point& point) const { return nearby != nullptr && nearby->hides(point); }
    [[nodiscard]] bool clear(const Point& point, bool near) const {
        if (near && nearby != nullptr && nearby->knows(point)) {
            const Path way{path.from, point};
            Any any(passed, own);
            return nearby->clear([&](TriangleRef triangle) {
                test_triangle<Kernel>(scene, way, triangle, options, counters, any);
                return any.found();
            });
        }
        if (near && list != nullptr && list->complete) {
            if (last > 0 && is_hit(point, last)) return false;
            for (unsigned i = 0; i < list->count; ++i) {
                if (!is_hit(point, i)) continue;
                last = i;
                return false;
            }
            return true;
        }
        Any any(passed, own);
        traverse<Kernel>(scene, Path{path.from, point}, options, counters, any);
        return !any.found();
    }
    [[nodiscard]] bool stops(const Point& point, Corners& corners, Decision& decision) const {
        const Path way{path.from, point};
        FirstOther<Scalar, Passed> first(scene, way, counters, passed, own);
        if (nearby != nullptr && nearby->knows(point)) {
            nearby->each(
                [&](TriangleRef triangle) { test_triangle<Kernel>(scene, way, triangle, options, counters, first); });
        } else if (list != nullptr && list->complete) {
            for (unsigned i = 0; i < list->count; ++i) test(way, i, first);
        } else {
            traverse<Kernel>(scene, way, options, counters, first);
        }
        if (!first.found()) return false;
        corners = scene.corners(first.best().triangle);
        decision = first.best().decision;
        return true;
    }

  private:
    // One of the list's, on the way to a point. As a rule there is no other than the hit's own.
    [[nodiscard]] bool is_hit(const Point& point, unsigned i) const {
        if (list->triangles[i] == own) return false;
        Any any(passed, own);
        test(Path{path.from, point}, i, any);
        return any.found();
    }
    template <class Collector>
    void test(const Path& way, unsigned i, Collector& collector) const {
        test_triangle<Kernel>(scene, way, list->triangles[i], options, counters, collector);
    }
};

/// Writes the hit of a candidate whose values are certified, to where the caller wants it: a copy of what was just
/// written number by number would wait for memory. `passed(triangle)` says which triangles are hit strictly before it,
/// and so on the way to any point near it. With a complete list of the query's triangles (null: none was kept) nothing
/// else is asked again.
template <class Kernel, class Scalar, class Passed>
void write_answer(const Scene<Scalar>& scene, const Path& path, const Candidate& candidate, const Values& values,
                  const Rounded<Scalar>& rounded, const Passed& passed, const QueryOptions& options,
                  QueryCounters& counters, const Shortlist* list, Hit<Scalar>& hit) {
    const TriangleRef triangle = candidate.triangle;
    const std::uint32_t number = scene.number_of(triangle);
    report(rounded, candidate.decision, scene.face_of_number(number), number, hit);
    // A limit that is nearer was meant for the caller's own path: ways have none.
    const OtherWays<Kernel, Scalar, Passed> ways{scene, path, triangle, passed, options, counters, list};
    const int tries =
        place(path, candidate.measured, candidate.decision, scene.grain, values, rounded, counters, ways, hit);
    counters.retreats += static_cast<std::uint64_t>(tries);
}

/// The same of one whose values are not.
template <class Kernel, class Scalar, class Passed>
void answer(const Scene<Scalar>& scene, const Path& path, const Candidate& candidate, const Passed& passed,
            const QueryOptions& options, QueryCounters& counters, const Shortlist* list, Hit<Scalar>& hit) {
    Values values;
    Rounded<Scalar> rounded;
    Kernel::certify(scene, candidate, path, counters, values, rounded);
    if (path.ray) {
        const double parameter = to_parameter(path, values.weights[3], candidate.decision.at_start,
                                              [&] { return corners_of(candidate.measured); });
        rounded.weights[3] =
            static_cast<Scalar>(std::min(parameter, static_cast<double>(std::numeric_limits<Scalar>::max())));
    }
    write_answer<Kernel>(scene, path, candidate, values, rounded, passed, options, counters, list, hit);
}

[[nodiscard]] inline bool none_passed(TriangleRef) { return false; }

template <class Kernel, class Scalar>
[[nodiscard]] std::optional<Hit<Scalar>> first_answer(const Scene<Scalar>& scene, const Path& path,
                                                      const QueryOptions& options, QueryCounters& counters) {
    std::optional<Hit<Scalar>> hit;
    First<Scalar> first(scene, path, counters);
    traverse<Kernel>(scene, path, options, counters, first);
    if (first.found())
        answer<Kernel>(scene, path, first.best(), none_passed, options, counters, &first.list(), hit.emplace());
    return hit;
}

}  // namespace pierce::detail
