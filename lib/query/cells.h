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

enum class Walking : std::uint8_t { no, along, never };

/// Starts the walk of a path through a level, unless it does not come there before `limit`. `never`: it is too long to be followed.
template <class Scalar>
[[nodiscard]] Walking start_walk(const Search<Scalar>& search, const Halves& half, const Level& level, double limit, bool once,
                                 LineWalk& walk) {
    // In cells of the finest level. What the walk is proved for (walk.h): with the cells of a level, 2^20, its M is below 2^31.
    constexpr double k_longest = 0x1p30;
    const Raster& finest = search.scene.grid.levels().front().raster();
    const Raster& raster = level.raster();
    Point from;
    Point to;
    for (std::size_t k = 0; k < 3; ++k) {
        if (std::abs(half.to[k] - half.from[k]) > k_longest * finest.half_size(k)) return Walking::never;
        from[k] = raster.place(k, half.from[k]);
        to[k] = raster.place(k, half.to[k]);
    }
    const Line line(from, to, raster);
    if (line.empty() || limit < line.first) return Walking::no;
    walk.start(level, line, once);
    return Walking::along;
}

/// Whether what the cells of a walk leave holds for the path's rounded points as well: they leave the line by less than half a step.
template <class Scalar>
[[nodiscard]] bool covers_points(const Search<Scalar>& search, const Level& level) {
    return search.rounding() * (4 * k_steps) < level.raster().least_size();
}

/// Room for what a few cells leave.
constexpr unsigned k_most_ids = 256;
using Ids = std::array<std::uint32_t, k_most_ids + 8>;

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

/// Goes from cells to cells. Made to be left and come back to, so that a batch can wait for memory in between.
template <class Scalar>
class Cells {
  public:
    /// With `once`, no triangle is left by two cells.
    Cells(Search<Scalar>& search, bool once) : search_(&search), half_(search.path), once_(once) {}

    /// The next cells that hold something: `stops` of `level`. `limit`, a fraction of the path, says how far they are of use.
    bool next(double limit) {
        const std::span<const Level> levels = search_->scene.grid.levels();
        for (;;) {
            if (walking_ == Walking::along) {
                if (walk_.next(limit, stops_[0])) {
                    search_->come_to(walk_.fraction());
                    count_ = 1;
                    return true;
                }
                walking_ = Walking::no;
            }
            if (at_ == levels.size()) return false;
            level_ = &levels[at_++];
            const int found = search_->scene.backend->block(level_->packed(), half_.from.data(), half_.to.data(), stops_.data());
            if (found > 0) {
                count_ = static_cast<unsigned>(found);
                return true;
            }
            if (found == 0) continue;
            walking_ = start_walk(*search_, half_, *level_, limit, once_, walk_);
            if (walking_ == Walking::along) covered_ = covered_ && covers_points(*search_, *level_);
            if (walking_ == Walking::never) {
                at_ = levels.size();
                return true;
            }
        }
    }

    [[nodiscard]] const Level& level() const { return *level_; }
    [[nodiscard]] std::span<const Stop> stops() const { return {stops_.data(), count_}; }
    /// In place of cells: the path is too long to be followed, and each triangle from this level's first one on is to be asked.
    [[nodiscard]] bool all() const { return walking_ == Walking::never; }
    /// What the cells leave holds for the path's rounded points as well.
    [[nodiscard]] bool covered() const { return covered_; }

  private:
    Search<Scalar>* search_;
    Halves half_;
    bool once_;
    bool covered_ = true;
    Walking walking_ = Walking::no;
    std::size_t at_ = 0;
    const Level* level_ = nullptr;
    unsigned count_ = 0;
    std::array<Stop, k_most_block> stops_;
    LineWalk walk_;
};

/// What `visit_near` does in a level where the path is not short. Returns whether the levels after this one are done as well.
template <class Scalar, class Limit, class Use>
[[gnu::noinline]] bool visit_along(Search<Scalar>& search, const Halves& half, const Level& level, bool once, bool& covered, Ids& ids,
                                   Limit&& limit, QueryCounters& counters, Use&& use) {
    LineWalk walk;
    const Walking walking = start_walk(search, half, level, limit(), once, walk);
    if (walking == Walking::never) {
        each_triangle(search.scene, level.first_id(), [&](std::uint32_t* some, unsigned count) { use(some, count, covered); });
        return true;
    }
    if (walking == Walking::no) return false;
    covered = covered && covers_points(search, level);
    const Backend& backend = *search.scene.backend;
    for (Stop stop; walk.next(limit(), stop);) {
        ++counters.cells;
        search.come_to(walk.fraction());
        const Range range = level.range(stop.number);
        for (std::uint32_t begin = range.begin; begin < range.end; begin += k_most_ids) {
            const unsigned some = std::min(range.end - begin, k_most_ids);
            const unsigned count =
                backend.cull(level.boxes(begin), level.ids(begin), some, stop.cull.above, stop.cull.seen, ids.data());
            if (count > 0) use(ids.data(), count, covered);
        }
    }
    return false;
}

/// Calls `use(ids, count, covered)` for the triangles whose boxes the path comes near; see `Cells`.
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
