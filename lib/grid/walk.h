// Which cells a long segment may touch. (A short one's: kernel/block.h.)
//
// Cell by cell in the order of the segment (Amanatides and Woo 1987), striding over empty space by the tree's empty parts and the distances kept
// with empty roots (Cohen and Sheffer 1994, "Proximity clouds"). Two margins make it certain: boxes are listed in every cell that they
// come within a step (1/128 of a cell) of, and what is asked of a cell is a step larger on all sides. Why they are enough:
//
// Let P(s) be the exact place of the segment's point at fraction s, in cells, for the raster's numbers as stored, and
// L(s) = f + s d the line that the walk follows, with f, d computed. With u = 2^-52 and M the largest of |f|, |f + d| and the number
// of cells, f and t are within 3u M of their exact values (three roundings) and d = t - f within 8u M: |L(s) - P(s)| < 11u M for
// every s in [0, 1].
//   - The s at which L reaches a wall is computed with three roundings, each time from the start: a shift along L of less than 8u M.
//     Places on L are computed to within 4u M.
//   - An axis along which |d| < 2^-20 counts as constant, which is off by less than 2^-20.
// The walk is for M < 2^36 only: everything together is less than 23 * 2^-52 * 2^36 + 2^-20 < 2^-10 cells, an eighth of a step. So at every fraction s at which it is in a region (a cell, or a cube of empty ones), P(s) is within 2^-9 cells of it, also where L has left
// the grid by less than that: the outermost cells reach further by `k_pad`. A box that holds P(s) is then listed in
// that cell, or the region would not be empty; and shares a step with what is asked there.
//
// Longer segments are not walked along: query/cells.h.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <grid/level.h>

namespace pierce::detail {

constexpr double k_pad = 0x1p-8;        ///< how far the outermost cells reach beyond the grid
constexpr double k_flat = 0x1p-20;      ///< an axis along which a line goes less counts as constant

/// A part of a segment, in cells of a level: the place at fraction s is `from + s * d`, for s in [first, last].
struct Line {
    Point from;
    Point d;
    double first = 0;
    double last = 1;

    /// A segment from its places in steps.
    Line(const Point& start, const Point& end, const Raster& raster) {
        bool inside = true;
        for (std::size_t k = 0; k < 3; ++k) {
            from[k] = start[k] * (1.0 / k_steps);
            const double to = end[k] * (1.0 / k_steps);
            d[k] = to - from[k];
            inside = inside && std::min(from[k], to) >= 0 && std::max(from[k], to) <= raster.cells()[k];
        }
        if (inside) return;
        for (std::size_t k = 0; k < 3; ++k) {
            if (std::abs(d[k]) < k_flat) continue;
            const double s0 = (-k_pad - from[k]) / d[k];
            const double s1 = (raster.cells()[k] + k_pad - from[k]) / d[k];
            first = std::max(first, std::min(s0, s1));
            last = std::min(last, std::max(s0, s1));
        }
    }
    [[nodiscard]] bool empty() const { return !(first <= last); }
};

/// `start`, then `next` until it says no: the cells on a line that hold something, from its start to its end. With `once`, the stops' culling leaves every box that the cells list
/// exactly once; without, those near the line in each cell.
///
/// Once: the cells go one way along each axis, so those that list a box follow one another, and it is enough to know the one before.
class LineWalk {
  public:
    void start(const Level& level, const Line& line, bool once) {
        level_ = &level;
        from_ = line.from;
        d_ = line.d;
        last_ = line.last;
        once_ = once;
        started_ = false;
        unseen_ = cull_none();
        for (std::size_t k = 0; k < 3; ++k) {
            cell_[k] = std::clamp(static_cast<int>(from_[k] + line.first * d_[k]), 0, cells(k) - 1);
            step_[k] = std::abs(d_[k]) < k_flat ? 0 : d_[k] > 0 ? 1 : -1;
            inverse_[k] = 1 / d_[k];
            leave_[k] = leaves(k, cell_[k], cell_[k]);
        }
        enter_ = line.first;
    }

    /// Goes on to the next such cell. False when there is none, or when the line comes to it only beyond `limit`.
    bool next(double limit, Stop& stop) {
        for (;; started_ = true) {
            if (started_) {
                const std::size_t axis = leave_[0] < leave_[1] ? (leave_[0] < leave_[2] ? 0 : 2) : (leave_[1] < leave_[2] ? 1 : 2);
                enter_ = leave_[axis];
                if (!(enter_ < last_) || limit < enter_) return false;
                if (!step(axis, cell_[axis])) return false;
                unseen_ = cull_seen(axis, step_[axis]);
            }
            Level::Place place = level_->find(cell_);
            for (; place.brick == nullptr; place = level_->find(cell_)) {
                if (!stride(place, limit)) return false;
                unseen_ = cull_none();
            }
            const std::uint64_t bit = Level::bit_of(cell_);
            if ((place.brick->parts & bit) == 0) continue;
            stop = {Level::number(*place.brick, bit), once_ ? unseen_ : cull_here()};
            started_ = true;
            return true;
        }
    }

    /// The fraction at which the segment enters the cell that it has come to.
    [[nodiscard]] double fraction() const { return enter_; }

  private:
    [[nodiscard]] int cells(std::size_t k) const { return level_->raster().cells()[k]; }

    // The fraction at which the line leaves the cells from `low` to `high` along an axis.
    [[nodiscard]] double leaves(std::size_t k, int low, int high) const {
        if (step_[k] == 0) return std::numeric_limits<double>::infinity();
        const double wall = step_[k] > 0 ? (high + 1 >= cells(k) ? cells(k) + k_pad : high + 1) : (low <= 0 ? -k_pad : low);
        return (wall - from_[k]) * inverse_[k];
    }

    // To the next cell along an axis, from `edge`; false when there is none.
    bool step(std::size_t axis, int edge) {
        const int next = edge + step_[axis];
        if (next < 0 || next >= cells(axis)) return false;
        cell_[axis] = next;
        leave_[axis] = leaves(axis, next, next);
        return true;
    }

    // Out of the empty cube around; false when the line ends in it or comes out beyond the limit.
    bool stride(const Level::Place& cube, double limit) {
        const int mask = (1 << cube.shift) - 1;
        Cell low{};
        Cell high{};
        Point leave{};
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = (cell_[k] & ~mask) - cube.reach;
            high[k] = (cell_[k] | mask) + cube.reach;
            leave[k] = leaves(k, low[k], high[k]);
        }
        const std::size_t axis = leave[0] < leave[1] ? (leave[0] < leave[2] ? 0 : 2) : (leave[1] < leave[2] ? 1 : 2);
        enter_ = leave[axis];
        if (!(enter_ < last_) || limit < enter_) return false;
        for (std::size_t k = 0; k < 3; ++k) {
            if (k == axis || step_[k] == 0) continue;
            const int place = static_cast<int>(from_[k] + enter_ * d_[k]);
            cell_[k] = step_[k] > 0 ? std::clamp(place, cell_[k], std::min(high[k], cells(k) - 1))
                                    : std::clamp(place, std::max(low[k], 0), cell_[k]);
            leave_[k] = leaves(k, cell_[k], cell_[k]);
        }
        return step(axis, step_[axis] > 0 ? high[axis] : low[axis]);
    }

    // What is near the line in this cell, and a step more. 2^10 makes the truncation a rounding down.
    [[nodiscard]] Cull cull_here() const {
        const double leave = std::min({leave_[0], leave_[1], leave_[2], last_});
        Steps box{};
        for (std::size_t k = 0; k < 3; ++k) {
            const double corner = cell_[k];
            const double x = (from_[k] + enter_ * d_[k] - corner) * k_steps;
            const double y = (from_[k] + leave * d_[k] - corner) * k_steps;
            box.low[k] = static_cast<int>(std::min(x, y) + 1023) - 1024;
            box.high[k] = static_cast<int>(std::max(x, y) + 1025) - 1024;
        }
        return cull_of(box, {0, 0, 0});
    }

    const Level* level_;
    Point from_;
    Point d_;
    Point inverse_;
    Point leave_;        ///< the fraction at which the line leaves the cell along each axis
    double enter_;       ///< at which it has come into it
    double last_;
    bool once_;
    bool started_;
    Cell cell_;
    Cell step_;          ///< -1, 0 or 1
    Cull unseen_;
};

}  // namespace pierce::detail
