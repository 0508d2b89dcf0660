// The one way through the rooms: grid, kernels, exact arithmetic where they are in doubt, collector.
#pragma once

#include <kernel/filter.h>
#include <query/candidate.h>
#include <query/search.h>

namespace pierce::detail {

template <class Scalar>
[[nodiscard]] bool masked(const Scene<Scalar>& scene, std::uint32_t triangle, const QueryOptions& options) {
    if (options.face_mask.empty()) return false;
    const std::uint32_t face = scene.face_of(triangle);
    return face >= options.face_mask.size() || options.face_mask[face] == 0;
}

/// Whether the caller's own test takes a hit; `accept` must be given.
template <class Scalar>
[[nodiscard]] bool accepted(const Scene<Scalar>& scene, const Path& path, const Candidate& candidate,
                            const QueryOptions& options) {
    const Measures measures = measure(path, scene.corners(candidate.triangle));
    const Point& w = measures.barycentric;
    return options.accept({scene.face_of(candidate.triangle), scene.triangle_numbers[candidate.triangle], candidate.decision.side,
                           candidate.decision.feature, candidate.decision.feature_index, candidate.decision.at_start,
                           measures.fraction, {w[0], w[1], w[2]}});
}

/// How a triangle that the wide kernels leave is decided: the filter, and exact arithmetic where that is in doubt. (A policy, so that the
/// benchmark can put another in its place and measure what certainty costs.)
struct Certified {
    static constexpr float unit = 0x1p-24F;  ///< of the wide kernels' bounds

    /// Whether the path hits, unless the hit lies beyond `limit`.
    static bool test(const Corners& corners, std::uint32_t triangle, const Path& path, Sides sides, double limit,
                     QueryCounters& counters, Candidate& candidate) {
        const Filtered filtered = filter(corners, path, sides);
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
        const Decision decision = decide(path, corners, sides);
        if (!decision.hit) return false;
        candidate = exact_candidate(triangle, decision, measure(path, corners).fraction);
        return true;
    }

    /// The side of its plane that a point is on.
    static int side(const Corners& corners, const Point& point) {
        const int side = certain_side(corners, point);
        return side != 0 ? side : side_of(corners, point);
    }
};

/// Asks the kernels about a list of triangles and gives the collector those that the path hits under `options`.
template <class Kernel, class Scalar, class Collector>
void test_triangles(const Search<Scalar>& search, const std::uint32_t* ids, unsigned count, const QueryOptions& options,
                    QueryCounters& counters, Collector& collector) {
    const Scene<Scalar>& scene = search.scene;
    std::array<std::uint32_t, 64> left;
    for (; count > 0;) {
        const unsigned some = std::min<unsigned>(count, left.size());
        const unsigned found = scene.backend->refine(search.probe, scene.coordinates.data(), ids, some, left.data());
        counters.triangles += some;
        ids += some;
        count -= some;
        for (unsigned i = 0; i < found; ++i) {
            const std::uint32_t triangle = left[i];
            if (!collector.wants(triangle) || masked(scene, triangle, options)) continue;
            Candidate candidate;
            const double limit = std::min(collector.limit(), options.max_fraction);
            const Corners corners = scene.corners(triangle);
            if (!Kernel::test(corners, triangle, search.path, options.sides, limit, counters, candidate)) continue;
            if (candidate.latest > options.max_fraction) {
                if (candidate.earliest > options.max_fraction) continue;
                if (!fraction_at_most(search.path, corners, options.max_fraction)) continue;
            }
            if (options.accept && !accepted(scene, search.path, candidate, options)) continue;
            collector.add(candidate);
        }
    }
}

/// The triangles of one cell that the path's box there leaves: `use(ids, count)`, in parts.
template <class Scalar, class Use>
void cull_cell(const Scene<Scalar>& scene, const Level& level, const Range& range, const Cull& cull, Use&& use) {
    std::array<std::uint32_t, 128 + 8> ids;
    for (std::uint32_t begin = range.begin; begin < range.end; begin += 128) {
        const Range part{begin, std::min(range.end, begin + 128)};
        const unsigned count = scene.backend->cull(level.boxes(part), level.ids(part), part.end - part.begin, cull.above,
                                                   cull.seen, ids.data());
        if (count > 0) use(ids.data(), count);
    }
}

/// A short segment's cells in one level: those of its box. More than this, and the walk visits fewer.
constexpr int k_most_block = 8;

struct Block {
    Steps box;
    Cell first;
    Cell last;
    int cells;  ///< how many; 0 if the box lies outside
};

[[nodiscard]] inline Block block_of(const Level& level, const Path& path) {
    const Raster& raster = level.raster();
    const Box box = box_of(path);
    Block block{raster.steps(box.low, box.high), {}, {}, 0};
    if (raster.outside(block.box)) return block;
    block.first = raster.cell_of(block.box.low);
    block.last = raster.cell_of(block.box.high);
    double cells = 1;
    for (std::size_t k = 0; k < 3; ++k) cells *= block.last[k] - block.first[k] + 1;
    block.cells = static_cast<int>(std::min(cells, 1e6));
    return block;
}

/// Calls `use(ids, count)` for the triangles whose boxes the path's comes near, in about its order; `limit()`, a fraction of the path, says how
/// far they are of use. With `once`, no triangle comes twice.
template <class Scalar, class Limit, class Use>
void visit_near(Search<Scalar>& search, bool once, Limit&& limit, QueryCounters& counters, Shortlist* shortlist, Use&& use) {
    const Scene<Scalar>& scene = search.scene;
    for (const Level& level : scene.grid.levels()) {
        const Block block = block_of(level, search.path);
        if (block.cells == 0) continue;
        const auto visit = [&](const Range& range, const Cull& cull) {
            ++counters.cells;
            cull_cell(scene, level, range, cull, [&](const std::uint32_t* ids, unsigned count) {
                if (shortlist != nullptr) {
                    if (shortlist->count + count > Shortlist::k_most) shortlist->complete = false;
                    if (shortlist->complete) {
                        std::copy_n(ids, count, shortlist->ids.begin() + shortlist->count);
                        shortlist->count += count;
                    }
                }
                use(ids, count);
            });
        };
        bool tame = true;
        if (block.cells > k_most_block) {
            const Line line = clip(level.raster(), search.path, tame);
            if (tame) {
                if (!(line.first <= line.last) || limit() < line.first) continue;
                // The shortlist has what comes near the path itself; a rounded point may leave it by less than half a step.
                if (shortlist != nullptr && !(search.rounding * 4 * k_steps < level.raster().least_size())) shortlist->complete = false;
                walk(level, line, once, limit, [&](const Range& range, const Cull& cull, double s) {
                    if (search.is_far) search.move_to(s);
                    visit(range, cull);
                });
                continue;
            }
        }
        visit_block(level, block.box, block.first, block.last, visit);
    }
}

/// Gives each triangle that the path hits under `options` to the collector. A collector has
///   bool once                     whether a hit must not come twice
///   double limit()                hits beyond this fraction are of no use; negative: none is any more
///   bool wants(triangle)          whether to look at it at all
///   void add(candidate)           a hit that counts
/// `options.max_fraction` must not be NaN.
template <class Kernel, class Scalar, class Collector>
void traverse(Search<Scalar>& search, const QueryOptions& options, QueryCounters& counters, Collector& collector,
              Shortlist* shortlist = nullptr) {
    search.probe.unit = Kernel::unit;
    const auto limit = [&] { return std::min(collector.limit(), options.max_fraction); };
    visit_near(search, Collector::once, limit, counters, shortlist, [&](const std::uint32_t* ids, unsigned count) {
        test_triangles<Kernel>(search, ids, count, options, counters, collector);
    });
}

}  // namespace pierce::detail
