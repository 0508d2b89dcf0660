// The one way through the rooms: grid, kernel, exact arithmetic where the kernel is in doubt, collector.
#pragma once

#include <exact/crossing.h>
#include <grid/walk.h>
#include <kernel/filter.h>
#include <query/candidate.h>

namespace pierce::detail {

/// Calls `visitor(triangle, visit)` for every triangle that the path may touch, once for each cell that they share; `limit` as in
/// `walk`.
template <class Limit, class Visitor>
void visit_near(const Scene& scene, const Path& path, Limit&& limit, QueryCounters& counters, Visitor&& visitor) {
    if (scene.grid.empty() || !overlap(box_of(path), scene.grid.bounds())) return;
    walk(scene.grid, path, limit, [&](std::size_t cell, const Visit& visit) {
        ++counters.cells;
        for (const std::uint32_t triangle : scene.grid.list(cell)) visitor(triangle, visit);
    });
}

[[nodiscard]] inline bool masked(const Scene& scene, std::uint32_t triangle, const QueryOptions& options) {
    if (options.face_mask.empty()) return false;
    const std::uint32_t face = scene.face_of(triangle);
    return face >= options.face_mask.size() || options.face_mask[face] == 0;
}

/// Whether the caller's own test takes a hit; `accept` must be given.
[[nodiscard]] inline bool accepted(const Scene& scene, const Path& path, const Candidate& candidate,
                                   const QueryOptions& options) {
    const Measures measures = measure(path, scene.corners(candidate.triangle));
    const Point& w = measures.barycentric;
    return options.accept({scene.face_of(candidate.triangle), candidate.triangle, candidate.decision.side,
                           candidate.decision.feature, candidate.decision.feature_index, candidate.decision.at_start,
                           measures.fraction, {w[0], w[1], w[2]}});
}

/// How a triangle is decided: the filter, and exact arithmetic where that is in doubt. (A policy, so that the benchmark can put another
/// in its place and measure what certainty costs.)
struct Certified {
    /// Whether the path hits, unless the hit lies beyond `limit`.
    static bool test(const Scene& scene, std::uint32_t triangle, const Path& path, Sides sides, double limit,
                     QueryCounters& counters, Candidate& candidate) {
        const Filtered filtered = filter(scene.prepared[triangle], path, sides);
        if (filtered.verdict == Verdict::miss || filtered.earliest > limit) return false;
        if (filtered.verdict == Verdict::hit) {
            // Certain of a hit, the filter is certain that it is on neither edge nor corner, and that it is not at the start.
            candidate = {triangle,
                         {.hit = true, .side = filtered.side, .feature = Feature::face, .feature_index = 0, .at_start = false},
                         filtered.earliest,
                         filtered.latest};
            return true;
        }
        ++counters.exact_decisions;
        const Corners corners = scene.corners(triangle);
        const Decision decision = decide(path, corners, sides);
        if (!decision.hit) return false;
        candidate = exact_candidate(triangle, decision, measure(path, corners).fraction);
        return true;
    }

    /// The side of its plane that a point is on.
    static int side(const Scene& scene, std::uint32_t triangle, const Point& point) {
        const int side = certain_side(scene.prepared[triangle], point);
        return side != 0 ? side : side_of(scene.corners(triangle), point);
    }
};

/// Gives each triangle that the path hits under `options` to the collector, in no certain order. A collector has
///   double limit()                hits beyond this fraction are of no use; negative: none is any more
///   bool wants(triangle)          whether to look at it at all
///   void add(candidate, visit)    a hit that counts; it may come again, in another cell
/// `options.max_fraction` must not be NaN.
template <class Kernel, class Collector>
void traverse(const Scene& scene, const Path& path, const QueryOptions& options, QueryCounters& counters,
              Collector& collector) {
    const auto limit = [&] { return std::min(collector.limit(), options.max_fraction); };
    visit_near(scene, path, limit, counters, [&](std::uint32_t triangle, const Visit& visit) {
        if (!collector.wants(triangle) || masked(scene, triangle, options)) return;
        ++counters.triangles;
        Candidate candidate;
        if (!Kernel::test(scene, triangle, path, options.sides, limit(), counters, candidate)) return;
        if (candidate.latest > options.max_fraction) {
            if (candidate.earliest > options.max_fraction) return;
            if (!fraction_at_most(path, scene.corners(triangle), options.max_fraction)) return;
        }
        if (options.accept && !accepted(scene, path, candidate, options)) return;
        collector.add(candidate, visit);
    });
}

}  // namespace pierce::detail
