// The one way through the rooms: grid, kernel, exact arithmetic where the kernel is in doubt, collector.
#pragma once

#include <grid/walk.h>
#include <kernel/filter.h>
#include <query/candidate.h>

namespace pierce::detail {

/// Gives each triangle that the path hits under `options` to the collector, in no certain order. A collector has
///   double limit()                hits beyond this fraction are of no use; negative: none is any more
///   void add(candidate, visit)    a certain hit with fraction <= max_fraction; it may come again, in another cell
/// `options.max_fraction` must not be NaN.
template <class Collector>
void traverse(const Scene& scene, const Path& path, const QueryOptions& options, QueryCounters& counters,
              Collector& collector) {
    const Box box = {{std::min(path.from[0], path.to[0]), std::min(path.from[1], path.to[1]),
                      std::min(path.from[2], path.to[2])},
                     {std::max(path.from[0], path.to[0]), std::max(path.from[1], path.to[1]),
                      std::max(path.from[2], path.to[2])}};
    if (scene.grid.empty() || !overlap(box, scene.grid.bounds())) return;

    const auto consider = [&](std::uint32_t triangle, const Visit& visit) {
        if (collector.limit() < 0) return;
        ++counters.triangles;
        const Filtered filtered = filter(scene.prepared[triangle], path, options.sides);
        if (filtered.verdict == Verdict::miss || filtered.earliest > collector.limit()) return;
        Candidate candidate;
        if (filtered.verdict == Verdict::hit) {
            candidate = {triangle,
                         {.hit = true, .side = filtered.side, .feature = Feature::face, .feature_index = 0, .at_start = false},
                         filtered.earliest,
                         filtered.latest};
        } else {
            ++counters.exact_decisions;
            const Corners corners = scene.corners(triangle);
            const Decision decision = decide(path, corners, options.sides);
            if (!decision.hit) return;
            candidate = exact_candidate(triangle, decision, measure(path, corners).fraction);
        }
        if (candidate.latest > options.max_fraction) {
            if (candidate.earliest > options.max_fraction) return;
            if (!fraction_at_most(path, scene.corners(triangle), options.max_fraction)) return;
        }
        collector.add(candidate, visit);
    };
    walk(
        scene.grid, path, [&] { return std::min(collector.limit(), options.max_fraction); },
        [&](std::size_t cell, const Visit& visit) {
            ++counters.cells;
            for (const std::uint32_t triangle : scene.grid.list(cell)) consider(triangle, visit);
        });
}

}  // namespace pierce::detail
