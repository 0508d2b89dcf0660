// Which cells a query visits: level by level, a short segment's by its box, a long one's along its line.
#pragma once

#include <numeric>

#include <query/search.h>

namespace pierce::detail {

/// Goes from cell to cell. Made to be left and come back to, so that a batch can wait for memory in between.
template <class Scalar>
class Cells {
  public:
    /// With `once`, no triangle is left by two cells.
    Cells(Search<Scalar>& search, bool once) : search_(&search), once_(once) {
        for (std::size_t k = 0; k < 3; ++k) {
            half_from_[k] = 0.5 * search.path.from[k];
            half_to_[k] = 0.5 * search.path.to[k];
        }
        const Grid& grid = search.scene.grid;
        if (grid.empty()) return;
        const Raster& finest = grid.levels().front().raster();
        for (std::size_t k = 0; k < 3; ++k)
            if (std::abs(half_to_[k] - half_from_[k]) > k_longest * finest.half_size(k)) way_ = Way::all;
    }

    /// The next cell that holds something; `limit`, a fraction of the path, says how far it is of use.
    bool next(double limit) {
        const std::span<const Level> levels = search_->scene.grid.levels();
        for (;;) {
            if (way_ == Way::block && block_.next(stop_)) return true;
            if (way_ == Way::line && line_.next(limit, stop_)) {
                if (search_->is_far) search_->move_to(stop_.fraction);
                return true;
            }
            if (way_ == Way::all) {
                way_ = Way::none;
                level_ = levels.size();
                stop_.level = nullptr;
                return true;
            }
            if (level_ == levels.size()) return false;
            enter(levels[level_++], limit);
        }
    }

    [[nodiscard]] const Stop& stop() const { return stop_; }
    /// In place of all cells: the path is too long to be followed from one to the next, and each triangle is to be asked.
    [[nodiscard]] bool all() const { return stop_.level == nullptr; }
    /// What the cells leave holds for the path's rounded points as well: they leave the line by less than half a step.
    [[nodiscard]] bool covered() const { return covered_; }

  private:
    enum class Way : std::uint8_t { none, block, line, all };

    // Of more cells than this the line visits fewer, and asks for less in each. Measured: tests/bench/run.
    static constexpr int k_most_block = 3;
    // In cells of the finest level. What the walk is proved for (walk.h): with the cells of a level, 2^20, its M is below 2^31.
    static constexpr double k_longest = 0x1p30;

    void enter(const Level& level, double limit) {
        way_ = Way::none;
        const Raster& raster = level.raster();
        Point from;
        Point to;
        Steps box;
        bool outside = false;
        for (std::size_t k = 0; k < 3; ++k) {
            from[k] = raster.place(k, half_from_[k]);
            to[k] = raster.place(k, half_to_[k]);
            const double low = std::min(from[k], to[k]);
            const double high = std::max(from[k], to[k]);
            outside = outside || !(high >= 0) || !(low < raster.most(k));
            // What lies outside of the cells counts as on their border: as raster.steps, which is as monotone.
            box.low[k] = static_cast<int>(std::clamp(low, 0.0, raster.most(k)));
            box.high[k] = static_cast<int>(std::clamp(high, 0.0, raster.most(k)));
        }
        if (outside) return;
        const Cell first = raster.cell_of(box.low);
        const Cell last = raster.cell_of(box.high);
        const int found = block_.start(level, box, first, last);
        if (found == 0) return;
        if (found > 0 && found <= k_most_block) {
            way_ = Way::block;
            return;
        }
        const Line line(from, to, raster);
        if (line.empty() || limit < line.first) return;
        line_.start(level, line, once_);
        covered_ = covered_ && search_->rounding * (4 * k_steps) < raster.least_size();
        way_ = Way::line;
    }

    Search<Scalar>* search_;
    Point half_from_;
    Point half_to_;
    bool once_;
    bool covered_ = true;
    Way way_ = Way::none;
    std::size_t level_ = 0;
    BlockWalk block_;
    LineWalk line_;
    Stop stop_;
};

/// Room for what one call of the kernels leaves.
constexpr unsigned k_most_ids = 128;
using Ids = std::array<std::uint32_t, k_most_ids + 8>;

/// All triangles that can be hit, in parts: `use(ids, count)`.
template <class Scalar, class Use>
void each_triangle(const Scene<Scalar>& scene, Use&& use) {
    Ids ids;
    const auto listed = static_cast<std::uint32_t>(scene.triangles.size() - scene.degenerate);
    for (std::uint32_t begin = 0; begin < listed; begin += k_most_ids) {
        const unsigned some = std::min(listed - begin, k_most_ids);
        std::iota(ids.begin(), ids.begin() + some, begin);
        use(ids.data(), some);
    }
}

/// Calls `use(ids, count, covered)` for the triangles whose boxes the path comes near; see `Cells`.
template <class Scalar, class Limit, class Use>
void visit_near(Search<Scalar>& search, bool once, Limit&& limit, QueryCounters& counters, Use&& use) {
    const Backend& backend = *search.scene.backend;
    Ids ids;
    for (Cells<Scalar> cells(search, once); cells.next(limit());) {
        ++counters.cells;
        if (cells.all()) {
            each_triangle(search.scene, [&](const std::uint32_t* some, unsigned count) { use(some, count, true); });
            return;
        }
        const Stop& stop = cells.stop();
        const Range range = stop.level->range(stop.number);
        for (std::uint32_t begin = range.begin; begin < range.end; begin += k_most_ids) {
            const unsigned some = std::min(range.end - begin, k_most_ids);
            const unsigned count = backend.cull(stop.level->boxes(begin), stop.level->ids(begin), some, stop.cull.above,
                                                stop.cull.seen, ids.data());
            if (count > 0) use(ids.data(), count, cells.covered());
        }
    }
}

}  // namespace pierce::detail
