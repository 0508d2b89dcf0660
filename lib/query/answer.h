// From a hit that was found to a hit that is answered: its values, and its verified point.
#pragma once

#include <optional>

#include <query/collectors.h>
#include <query/nearby.h>
#include <query/place.h>
#include <query/report.h>
#include <query/traverse.h>

namespace pierce::detail {

/// Whether start and end of a way are certainly on one side of a triangle's plane, strictly: it is not hit. `measured`
/// is of a path with that start.
[[nodiscard]] inline bool stays_on_one_side(const Measured& measured, const Point& end) {
    constexpr double u = Arithmetic<double>::unit;
    const Triple<Pair>& nr = measured.meeting.nr;
    const Triple<Pair>& a = measured.lines.af;
    const Triple<double> o = {end[0] - a.x[0], end[1] - a.y[0], end[2] - a.z[0]};
    // As v in meeting.h.
    const double there = nr.x[0] * o.x + nr.y[0] * o.y + nr.z[0] * o.z;
    const double bar = measured.bar_nr.x[0] * std::abs(o.x) + measured.bar_nr.y[0] * std::abs(o.y) +
                       measured.bar_nr.z[0] * std::abs(o.z);
    const double v = measured.v();
    const double ev = 9 * u * measured.bar_vc[0];
    return measured.tame && ((v < -ev && there > 9 * u * bar) || (v > ev && there < -9 * u * bar));
}

/// What place() asks about the ways from a hit's start to other points. Its own triangle is no matter: place() has seen
/// to that.
template <class Kernel, class Scalar, class Passed, class List>
struct OtherWays {
    using Nearby = detail::Nearby<OtherWays>;

    const Scene<Scalar>& scene;
    const Path& path;
    TriangleRef own;
    const Passed& passed;
    const QueryOptions& options;
    QueryCounters& counters;
    const List* list;

    mutable Nearby* nearby = nullptr;  ///< where many near places are asked about
    mutable unsigned last = 0;  ///< of the list, what stopped a way: likely to stop the next one too

    [[nodiscard]] bool hides(const Point& point) const { return nearby != nullptr && nearby->hides(point); }
    [[nodiscard]] bool clear(const Point& point, bool near) const {
        const Path way{path.from, point};
        Any any(passed, own);
        if (near && nearby != nullptr && nearby->knows(point))
            return nearby->clear([&](TriangleRef triangle) {
                test_triangle<Kernel>(scene, way, triangle, options, 1, counters, any);
                return any.found();
            });
        if (near && list != nullptr && list->complete) {
            if (last > 0) test(way, last, any);
            for (unsigned i = 0; i < list->count && !any.found(); ++i) {
                test(way, i, any);
                if (any.found()) last = i;
            }
        } else {
            traverse<Kernel>(scene, way, options, 1, counters, any);
        }
        return !any.found();
    }
    [[nodiscard]] bool stops(const Point& point, Corners& corners, Decision& decision) const {
        const Path way{path.from, point};
        FirstOther<Scalar, Passed> first(scene, way, counters, passed, own);
        if (nearby != nullptr && nearby->knows(point)) {
            nearby->each([&](TriangleRef triangle) {
                test_triangle<Kernel>(scene, way, triangle, options, 1, counters, first);
            });
        } else if (list != nullptr && list->complete) {
            for (unsigned i = 0; i < list->count; ++i) test(way, i, first);
        } else {
            traverse<Kernel>(scene, way, options, 1, counters, first);
        }
        if (!first.found()) return false;
        corners = scene.corners(first.best().triangle);
        decision = first.best().decision;
        return true;
    }

  private:
    // One of the list's. What was measured for the path itself has the way's start; of a masked one nothing was.
    template <class Collector>
    void test(const Path& way, unsigned i, Collector& collector) const {
        if (list->triangles[i] == own || masked(scene, list->triangles[i], options) ||
            (i < List::k_measured && stays_on_one_side(list->measured[i], way.to)))
            return;
        test_triangle<Kernel>(scene, way, list->triangles[i], options, 1, counters, collector);
    }
};

/// Writes the hit of a candidate, to where the caller wants it: a copy of what was just written number by number would
/// wait for memory. `passed(triangle)` says which triangles are hit strictly before it, and so on the way to any point
/// near it. With a complete list of the query's triangles nothing else is asked again.
template <class Kernel, class Scalar, class Passed, class List>
void answer(const Scene<Scalar>& scene, const Path& path, const Candidate& candidate, const Measured& measured,
            const Passed& passed, const QueryOptions& options, QueryCounters& counters, const List* list,
            Hit<Scalar>& hit) {
    const TriangleRef triangle = candidate.triangle;
    const Corners corners = corners_of(measured);
    typename Kernel::template Face<Scalar> face(path, measured, candidate.decision, *scene.backend->refine, counters);
    const std::uint32_t number = scene.number_of(triangle);
    const Measures measures = face.measures();
    report(measures, face.normal(), candidate.decision, scene.face_of_number(number), number, hit);
    // A limit that is nearer was meant for the caller's own segment: of ways it is 1.
    const OtherWays<Kernel, Scalar, Passed, List> ways{scene, path, triangle, passed, options, counters, list};
    const int tries =
        place<Scalar>(path, corners, candidate.decision, scene.grain, measures.fraction, face, counters, ways, hit);
    counters.retreats += static_cast<std::uint64_t>(tries);
}

[[nodiscard]] inline bool none_passed(TriangleRef) { return false; }
/// For answers of which no list of triangles is kept.
inline constexpr const Shortlist<0>* k_no_list = nullptr;

template <class Kernel, class Scalar>
[[nodiscard]] std::optional<Hit<Scalar>> first_answer(const Scene<Scalar>& scene, const Path& path,
                                                      const QueryOptions& options, QueryCounters& counters) {
    std::optional<Hit<Scalar>> hit;
    First<Scalar> first(scene, path, counters);
    traverse<Kernel>(scene, path, options, counters, first);
    if (first.found())
        answer<Kernel>(scene, path, first.best(), first.best_measured(), none_passed, options, counters, &first.list(),
                       hit.emplace());
    return hit;
}

}  // namespace pierce::detail
