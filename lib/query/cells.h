// Which cells a query visits: level by level, a short segment's by its box, a long one's along its line.
#pragma once

#include <numeric>

#include <query/search.h>

namespace pierce::detail {

/// A path as the grid reads it: halves, so that the difference of two huge numbers does not overflow; a fourth one for the lanes.
struct Halves {
    explicit Halves(const Path& path) {
        for (std::size_t k = 0; k < 3; ++k) {
            from[k] = 0.5 * path.from[k];
            to[k] = 0.5 * path.to[k];
        }
    }
    std::array<double, 4> from = {0, 0, 0, 0};
    std::array<double, 4> to = {0, 0, 0, 0};
};

/// Whether what the cells of a walk leave holds for the path's rounded points as well: they leave the line by less than half a step.
template <class Scalar>
[[nodiscard]] bool covers_points(const Search<Scalar>& search, const Level& level) {
    return search.rounding() * (4 * k_steps) < level.raster().least_size();
}

/// Cells of a walk that are asked for together: more use the lanes and the memory better, but go beyond the hit. Measured: tests/bench/run.
constexpr unsigned k_most_walk = 2;

/// Room for what a few cells leave, and for a `Shortlist`.
constexpr unsigned k_most_ids = Shortlist::k_most;
using Ids = std::array<std::uint32_t, k_most_ids + k_beyond_ids>;

/// The triangles from `first` on, in parts: `use(ids, count)`.
template <class Scalar, class Use>
void each_triangle(const Scene<Scalar>& scene, std::uint32_t first, Use&& use) {
    Ids ids;
    const auto listed = static_cast<std::uint32_t>(scene.triangles.size() - scene.degenerate);
    for (std::uint32_t begin = first; begin < listed; begin += k_most_ids) {
        const unsigned some = std::min(listed - begin, k_most_ids);
        std::iota(ids.begin(), ids.begin() + some, begin);
        use(ids.data(), some);
    }
}

/// What `visit_near` does in a level where the path is not short. Returns whether the levels after this one are done as well.
template <class Scalar, class Limit, class Use>
[[gnu::noinline]] bool visit_along(Search<Scalar>& search, const Halves& half, const Level& level, bool once, bool& covered, Ids& ids,
                                   Limit&& limit, QueryCounters& counters, Use&& use) {
    const Backend& backend = *search.scene.backend;
    Walk walk;
    const Walking walking = backend.start_walk(level.packed(), half.from.data(), half.to.data(), limit(), once, walk);
    if (walking == Walking::never) {
        each_triangle(search.scene, level.first_id(), [&](std::uint32_t* some, unsigned count) { use(some, count, covered); });
        return true;
    }
    if (walking == Walking::no) return false;
    covered = covered && covers_points(search, level);
    std::array<Stop, k_most_walk> stops;
    for (;;) {
        const unsigned found = backend.walk(level.packed(), walk, limit(), stops.data(), k_most_walk);
        if (found == 0) return false;
        search.come_to(stops[0].fraction);
        unsigned count = 0;
        counters.cells += found;
        for (unsigned i = 0; i < found; ++i) {
            const Range range = level.range(stops[i].number);
            for (std::uint32_t begin = range.begin; begin < range.end;) {
                const unsigned some = std::min(range.end - begin, k_most_ids);
                if (count + some > k_most_ids) {
                    use(ids.data(), count, covered);
                    count = 0;
                }
                count += backend.cull(level.boxes(begin), level.ids(begin), some, stops[i].cull.above, stops[i].cull.seen, ids.data() + count);
                begin += some;
            }
        }
        if (count > 0) use(ids.data(), count, covered);
    }
}

/// Calls `use(ids, count, covered)` for the triangles whose boxes the path comes near; with `once`, no triangle twice.
template <class Scalar, class Limit, class Use>
void visit_near(Search<Scalar>& search, bool once, Limit&& limit, QueryCounters& counters, Use&& use) {
    const Backend& backend = *search.scene.backend;
    const Halves half(search.path);
    bool covered = true;
    Ids ids;
    for (const Level& level : search.scene.grid.levels()) {
        unsigned cells = 0;
        const int count = backend.look(level.packed(), half.from.data(), half.to.data(), ids.data(), k_most_ids, &cells);
        counters.cells += cells;
        if (count > 0) use(ids.data(), static_cast<unsigned>(count), covered);
        else if (count < 0 && visit_along(search, half, level, once, covered, ids, limit, counters, use)) return;
    }
}

}  // namespace pierce::detail
