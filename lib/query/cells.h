// Which cells a query visits: level by level, a short segment's by its box, a long one's along its line.
#pragma once

#include <numeric>

#include <query/search.h>

namespace pierce::detail {

/// Cells of a walk that are asked for together: more use the lanes and the memory better, but go beyond the hit. Measured: tests/bench/run.
constexpr unsigned k_most_walk = 2;

/// Whether what the cells of a walk leave holds for the path's rounded points as well: they leave the line by less than half a step.
template <class Scalar>
[[nodiscard]] bool covers_points(const Search<Scalar>& search, const Level& level) {
    return search.rounding() * (4 * k_steps) < level.raster().least_size();
}

/// The triangles from `first` on, in parts: `use(ids, count)`.
template <class Scalar, class Use>
void each_triangle(const Scene<Scalar>& scene, std::uint32_t first, Shortlist& list, Use&& use) {
    const auto listed = static_cast<std::uint32_t>(scene.triangles.size() - scene.degenerate);
    for (std::uint32_t begin = first; begin < listed; begin += Shortlist::k_room) {
        const unsigned some = std::min(listed - begin, Shortlist::k_room);
        std::uint32_t* ids = list.room();
        std::iota(ids, ids + some, begin);
        list.take(some);
        use(ids, some);
    }
}

/// What `visit_near` does in a level where the path is not short. Returns whether the levels after this one are done as well.
template <class Scalar, class Limit, class Use>
[[gnu::noinline]] bool visit_along(Search<Scalar>& search, const Level& level, bool once, Shortlist& list, Limit&& limit,
                                   QueryCounters& counters, Use&& use) {
    const Backend& backend = *search.scene.backend;
    Walk walk;
    const Walking walking = backend.start_walk(level.packed(), search.path.from.data(), search.path.to.data(), limit(), once, walk);
    if (walking == Walking::never) {
        each_triangle(search.scene, level.first_id(), list, use);
        return true;
    }
    if (walking == Walking::no) return false;
    list.complete = list.complete && covers_points(search, level);
    std::array<Stop, k_most_walk> stops;
    for (;;) {
        const unsigned found = backend.walk(level.packed(), walk, limit(), stops.data(), k_most_walk);
        if (found == 0) return false;
        search.come_to(stops[0].fraction);
        counters.cells += found;
        std::uint32_t* ids = list.room();
        unsigned count = 0;
        const auto use_all = [&] {
            list.take(count);
            if (count > 0) use(ids, count);
            ids = list.room();
            count = 0;
        };
        for (unsigned i = 0; i < found; ++i) {
            const Range range = level.range(stops[i].number);
            for (std::uint32_t begin = range.begin; begin < range.end;) {
                const unsigned some = std::min(range.end - begin, Shortlist::k_room);
                if (count + some > Shortlist::k_room) use_all();
                count += backend.cull(level.boxes(begin), level.ids(begin), some, stops[i].cull.above, stops[i].cull.seen, ids + count);
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
[[nodiscard]] [[gnu::always_inline]] inline Near look_near(const Scene<Scalar>& scene, const Path& path, std::size_t from, Shortlist& list,
                                                           QueryCounters& counters) {
    const std::span<const Level> levels = scene.grid.levels();
    for (Near near{from, 0}; near.level < levels.size(); ++near.level) {
        unsigned cells = 0;
        near.count = scene.backend->look(levels[near.level].packed(), path.from.data(), path.to.data(), list.room(), Shortlist::k_room, &cells);
        counters.cells += cells;
        if (near.count != 0) return near;
    }
    return {};
}

/// Calls `use(ids, count)` for the triangles whose boxes the path comes near, from what a first look found on; with `once`, no triangle
/// twice.
template <class Scalar, class Limit, class Use>
void visit_near(Search<Scalar>& search, Near near, bool once, Shortlist& list, Limit&& limit, QueryCounters& counters, Use&& use) {
    for (; near.count != 0; near = look_near(search.scene, search.path, near.level + 1, list, counters)) {
        if (near.count > 0) {
            std::uint32_t* ids = list.room();
            const auto count = static_cast<unsigned>(near.count);
            list.take(count);
            use(ids, count);
        } else if (visit_along(search, search.scene.grid.levels()[near.level], once, list, limit, counters, use)) {
            return;
        }
    }
}

}  // namespace pierce::detail
