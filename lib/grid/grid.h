// The broad phase: a uniform grid of cells, each with the list of the boxes that it may touch. It knows boxes, no triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <point.h>

namespace pierce::detail {

/// An axis-parallel box, closed.
struct Box {
    Point low;
    Point high;
};

[[nodiscard]] inline bool overlap(const Box& x, const Box& y) {
    for (std::size_t k = 0; k < 3; ++k)
        if (x.low[k] > y.high[k] || y.low[k] > x.high[k]) return false;
    return true;
}

/// A block of cells: for each axis the first and the last.
struct CellRange {
    std::array<int, 3> first;
    std::array<int, 3> last;
};

/// Where the cells are. The cell of a coordinate x on axis k is the integer part of
///
///     place(k, x) = (x - low[k]) * scale[k],      computed in double and clamped to [0, cells[k])
///
/// Rounded subtraction, multiplication by a number >= 0, cutting and clamping never reverse the order of two coordinates, so
/// neither does the cell: a box and a point in it agree on the cells between the box's ends, however inexact `place` is,
/// as long as both sides use this one function. (NaN, from an overflow times zero, goes to cell 0, on an axis of one cell.)
struct GridShape {
    Point low = {0, 0, 0};
    Point scale = {0, 0, 0};
    std::array<int, 3> cells = {1, 1, 1};

    [[nodiscard]] double place(std::size_t axis, double x) const { return (x - low[axis]) * scale[axis]; }
    [[nodiscard]] int cell(std::size_t axis, double x) const {
        const double at = place(axis, x);
        if (!(at >= 1)) return 0;
        return at < cells[axis] ? static_cast<int>(at) : cells[axis] - 1;
    }
    [[nodiscard]] CellRange range(const Box& box) const;
    [[nodiscard]] std::size_t cell_count() const;
    [[nodiscard]] std::size_t index(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(cells[1]) + static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(cells[0]) +
               static_cast<std::size_t>(x);
    }
};

struct GridOptions {
    std::array<std::uint32_t, 3> cells = {0, 0, 0};  ///< see BuildOptions
    std::size_t max_bytes = 0;
};

/// Every box is listed in every cell of its range. Immutable once built.
class Grid {
  public:
    Grid() = default;
    /// `boxes[i]` is listed as `numbers[i]`, in that order within each cell. Counting sort: two passes over the boxes,
    /// linear in them and in the entries of the lists. Memory is counted before it is allocated, and the grid made coarser
    /// until it fits.
    Grid(std::span<const Box> boxes, std::span<const std::uint32_t> numbers, const GridOptions& options);

    [[nodiscard]] const GridShape& shape() const { return shape_; }
    [[nodiscard]] const Box& bounds() const { return bounds_; }
    [[nodiscard]] std::span<const std::uint32_t> list(std::size_t cell) const {
        return {entries_.data() + start_[cell], start_[cell + 1] - start_[cell]};
    }
    [[nodiscard]] bool empty() const { return entries_.empty(); }
    [[nodiscard]] std::size_t entry_count() const { return entries_.size(); }
    [[nodiscard]] std::size_t bytes() const {
        return start_.capacity() * sizeof(start_[0]) + entries_.capacity() * sizeof(entries_[0]);
    }

  private:
    GridShape shape_;
    Box bounds_ = {{0, 0, 0}, {0, 0, 0}};
    std::vector<std::uint32_t> start_;    // where each cell's list begins, and the end of the last
    std::vector<std::uint32_t> entries_;
};

}  // namespace pierce::detail
