// Which cells a query visits: level by level, a short segment's by its box, a long one's along its line.
#pragma once

#include <numeric>

#include <query/search.h>

namespace pierce::detail {

/// Cells of a walk that are asked for together: more use the lanes and the memory better, but go beyond the hit. Measured: tests/bench/run.
constexpr unsigned k_most_walk = 2;

/// Whether what the cells of a walk leave holds for the path's rounded points as well: they leave the line by less than a quarter of a step,
/// an eighth of which is what the walk itself may be off (kernel/walk.h), of the one step that it allows for.
template <class Scalar>
[[nodiscard]] bool covers_points(const Path& path, const Level& level) {
    return rounding<Scalar>(path) * (4 * k_steps) < level.raster().least_size();
}

/// The triangles from `first` on, in parts: `use(ids, count)`.
template <class Scalar, class Use>
void each_triangle(const Scene<Scalar>& scene, std::uint32_t first, Ids& ids, Use&& use) {
    const auto listed = static_cast<std::uint32_t>(scene.triangles.size() - scene.degenerate);
    for (std::uint32_t begin = first; begin < listed; begin += k_room) {
        const unsigned some = std::min(listed - begin, k_room);
        std::iota(ids.begin(), ids.begin() + some, begin);
        use(ids.data(), some);
    }
}

/// What `visit_near` does in a level where the path is not short. Returns whether the levels after this one are done as well; `complete`
/// becomes false if what is used is not all that a path to a rounded point may hit.
template <class Scalar, class Limit, class Use>
[[gnu::noinline]] bool visit_along(Search<Scalar>& search, const Level& level, bool once, Ids& ids, bool& complete, Limit&& limit,
                                   QueryCounters& counters, Use&& use) {
    const Backend& backend = *search.scene.backend;
    Walk walk;
    const Walking walking = backend.start_walk(level.packed(), search.path.from.data(), search.path.to.data(), limit(), once, walk);
    if (walking == Walking::never) {
        each_triangle(search.scene, level.first_id(), ids, use);
        return true;
    }
    // Before all else: the way to a rounded point may come to a level that the line does not.
    complete = complete && covers_points<Scalar>(search.path, level);
    if (walking == Walking::no) return false;
    std::array<Stop, k_most_walk> stops;
    for (;;) {
        const unsigned found = backend.walk(level.packed(), walk, limit(), stops.data(), k_most_walk);
        if (found == 0) return false;
        search.come_to(stops[0].fraction);
        counters.cells += found;
        unsigned count = 0;
        const auto use_all = [&] {
            if (count > 0) use(ids.data(), count);
            count = 0;
        };
        for (unsigned i = 0; i < found; ++i) {
            const Range range = level.range(stops[i].number);
            for (std::uint32_t begin = range.begin; begin < range.end;) {
                const unsigned some = std::min(range.end - begin, k_room);
                if (count + some > k_room) use_all();
                count += backend.cull(level.boxes(begin), level.ids(begin), some, stops[i].cull.above, stops[i].cull.seen, ids.data() + count);
                begin += some;
            }
        }
        use_all();
    }
}

/// What a first look at the levels found: the first of them that leaves anything.
struct Near {
    std::size_t level = 0;
    int count = 0;  ///< as `Backend::look`; 0 where none does: most short segments that are not near anything end here
};

/// Looks at the levels from one on, up to the first that leaves anything.
template <class Scalar>
[[nodiscard]] [[gnu::always_inline]] inline Near look_near(const Scene<Scalar>& scene, const Path& path, std::size_t from, Ids& ids,
                                                           QueryCounters& counters) {
    const std::span<const Level> levels = scene.grid.levels();
    for (Near near{from, 0}; near.level < levels.size(); ++near.level) {
        unsigned cells = 0;
        near.count = scene.backend->look(levels[near.level].packed(), path.from.data(), path.to.data(), ids.data(), k_room, &cells);
        counters.cells += cells;
        if (near.count != 0) return near;
    }
    return {};
}

/// Calls `use(ids, count)` for the triangles whose boxes the path comes near, from what a first look found on; with `once`, no triangle
/// twice.
template <class Scalar, class Limit, class Use>
void visit_near(Search<Scalar>& search, Near near, bool once, Ids& ids, bool& complete, Limit&& limit, QueryCounters& counters, Use&& use) {
    for (; near.count != 0; near = look_near(search.scene, search.path, near.level + 1, ids, counters)) {
        if (near.count > 0) use(ids.data(), static_cast<unsigned>(near.count));
        else if (visit_along(search, search.scene.grid.levels()[near.level], once, ids, complete, limit, counters, use)) return;
    }
}

/// The same where nobody asks again.
template <class Scalar, class Use>
void visit_all_near(Search<Scalar>& search, QueryCounters& counters, Use&& use) {
    Ids ids;
    bool complete = true;
    const Near near = look_near(search.scene, search.path, 0, ids, counters);
    visit_near(search, near, true, ids, complete, [] { return 1.0; }, counters, use);
}

}  // namespace pierce::detail
