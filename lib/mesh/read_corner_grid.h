// A uniform grid over some corners of a polygon: finds those near a triangle without looking at all of them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

#include "mesh/read_orient2d.h"

namespace pierce::detail {

struct Box2 {
    Point2 low = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    Point2 high = {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

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
    /// About one cell for each corner; linear time. All corners, and all triangles asked for later, are inside
    /// `bounds`.
    void build(std::span<const Point2> points, std::span<const std::uint32_t> corners, const Box2& bounds) {
        side_ = static_cast<std::size_t>(std::sqrt(static_cast<double>(corners.size()))) + 1;
        low_ = bounds.low;
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const double extent = bounds.high[axis] - bounds.low[axis];
            cells_per_length_[axis] = extent > 1e-290 ? static_cast<double>(side_) / extent : 0;
        }
        // Counting sort by cell. first_[cell + 2] counts; summed up, first_[cell + 1] is where a cell starts, and moves
        // to where it ends, which is where the next one starts, as the cell is filled.
        first_.assign(side_ * side_ + 2, 0);
        for (const std::uint32_t corner : corners) {
            ++first_[cell_of(points[corner]) + 2];
        }
        for (std::size_t cell = 2; cell < first_.size(); ++cell) {
            first_[cell] += first_[cell - 1];
        }
        sorted_.resize(corners.size());
        for (const std::uint32_t corner : corners) {
            sorted_[first_[cell_of(points[corner]) + 1]++] = corner;
        }
    }

    /// True if `test` is true for a corner in the triangle. It is asked for corners nearby as well.
    template <class Test>
    [[nodiscard]] bool any_near(const Point2& a, const Point2& b, const Point2& c, Test test) const {
        const Triangle triangle = {in_cells(a), in_cells(b), in_cells(c)};
        const auto [lowest, highest] = std::minmax({triangle[0][1], triangle[1][1], triangle[2][1]});
        for (std::size_t row = line_of(lowest); row <= line_of(highest); ++row) {
            const auto [left, right] = columns(triangle, static_cast<double>(row));
            for (std::size_t i = first_[row * side_ + left]; i < first_[row * side_ + right + 1]; ++i) {
                if (test(sorted_[i])) {
                    return true;
                }
            }
        }
        return false;
    }

  private:
    using Triangle = std::array<Point2, 3>;

    struct Columns {
        std::size_t left;
        std::size_t right;
    };

    /// The columns that a triangle reaches in the row between y and y + 1. In units of cells, at most 2^16 or so, all
    /// numbers are right to about 2^-35, and an edge higher than 2^-6 crosses a line within 2^-10 of where it is
    /// computed to: a whole cell on each side makes up for that. Rows are safe since a rounded position never decreases
    /// as a coordinate grows.
    [[nodiscard]] Columns columns(const Triangle& triangle, double y) const {
        double left = std::numeric_limits<double>::infinity();
        double right = -left;
        for (std::size_t i = 0; i < 3; ++i) {
            const Point2& one = triangle[i];
            const Point2& other = triangle[(i + 1) % 3];
            const auto& [low, high] = one[1] < other[1] ? std::tie(one, other) : std::tie(other, one);
            if (low[1] > y + 1 || high[1] < y) {
                continue;
            }
            const double height = high[1] - low[1];
            for (const double line : {y, y + 1}) {
                const double upwards = (std::clamp(line, low[1], high[1]) - low[1]) / height;
                const double x = low[0] + upwards * (high[0] - low[0]);
                left = std::min(left, height > 0x1p-6 ? x : std::min(low[0], high[0]));
                right = std::max(right, height > 0x1p-6 ? x : std::max(low[0], high[0]));
            }
        }
        return {line_of(left - 1), line_of(right + 1)};
    }

    [[nodiscard]] Point2 in_cells(const Point2& point) const {
        return {(point[0] - low_[0]) * cells_per_length_[0], (point[1] - low_[1]) * cells_per_length_[1]};
    }
    [[nodiscard]] std::size_t line_of(double position) const {
        return position > 0 ? static_cast<std::size_t>(std::min(position, static_cast<double>(side_ - 1))) : 0;
    }
    [[nodiscard]] std::size_t cell_of(const Point2& point) const {
        const Point2 position = in_cells(point);
        return line_of(position[1]) * side_ + line_of(position[0]);
    }

    std::size_t side_ = 1;
    Point2 low_{};
    Point2 cells_per_length_{};
    std::vector<std::uint32_t> first_, sorted_;  // the corners by cell, and where each cell starts among them
};

}  // namespace pierce::detail
