// A uniform grid over some corners of a polygon: finds those in a box without looking at all of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/read_orient2d.h"

namespace pierce::detail {

struct Box2 {
    Point2 low;
    Point2 high;

    void add(const Point2& point) {
        for (std::size_t axis = 0; axis < 2; ++axis) {
            low[axis] = std::min(low[axis], point[axis]);
            high[axis] = std::max(high[axis], point[axis]);
        }
    }
    [[nodiscard]] bool holds(const Point2& point) const {
        return point[0] >= low[0] && point[0] <= high[0] && point[1] >= low[1] && point[1] <= high[1];
    }
};

class CornerGrid {
  public:
    /// About one cell for each corner; linear time.
    void build(std::span<const Point2> points, std::span<const std::uint32_t> corners) {
        points_ = points;
        side_ = static_cast<std::size_t>(std::sqrt(static_cast<double>(corners.size()))) + 1;
        bounds_ = corners.empty() ? Box2{{0, 0}, {0, 0}} : Box2{points[corners[0]], points[corners[0]]};
        for (const std::uint32_t corner : corners) {
            bounds_.add(points[corner]);
        }
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const double extent = bounds_.high[axis] - bounds_.low[axis];
            per_length_[axis] = extent > 1e-290 ? static_cast<double>(side_) / extent : 0;
        }
        // Counting sort by cell.
        first_.assign(side_ * side_ + 1, 0);
        for (const std::uint32_t corner : corners) {
            ++first_[cell_of(points[corner]) + 1];
        }
        for (std::size_t cell = 1; cell < first_.size(); ++cell) {
            first_[cell] += first_[cell - 1];
        }
        sorted_.resize(corners.size());
        fill_.assign(first_.begin(), first_.end());
        for (const std::uint32_t corner : corners) {
            sorted_[fill_[cell_of(points[corner])]++] = corner;
        }
    }

    /// True if `test` is true for a corner in the box. It is asked for corners outside as well.
    template <class Test>
    [[nodiscard]] bool any_in(const Box2& box, Test test) const {
        // Row and column never decrease as a coordinate grows, rounded or not: no corner in the box is in another cell.
        const std::size_t left = line_of(box.low, 0);
        const std::size_t right = line_of(box.high, 0);
        const std::size_t top = line_of(box.high, 1);
        for (std::size_t row = line_of(box.low, 1); row <= top; ++row) {
            for (std::size_t i = first_[row * side_ + left]; i < first_[row * side_ + right + 1]; ++i) {
                if (test(sorted_[i])) {
                    return true;
                }
            }
        }
        return false;
    }

  private:
    [[nodiscard]] std::size_t line_of(const Point2& point, std::size_t axis) const {
        const double line = (point[axis] - bounds_.low[axis]) * per_length_[axis];
        return line > 0 ? static_cast<std::size_t>(std::min(line, static_cast<double>(side_ - 1))) : 0;
    }
    [[nodiscard]] std::size_t cell_of(const Point2& point) const { return line_of(point, 1) * side_ + line_of(point, 0); }

    std::span<const Point2> points_;
    std::size_t side_ = 1;
    Box2 bounds_{};
    Point2 per_length_{};
    std::vector<std::uint32_t> first_, fill_, sorted_;  // per cell its first place in sorted_
};

}  // namespace pierce::detail
