// The broadphase: levels of uniform grids, by the size of what they hold, so that a teapot in a stadium gets its own resolution.
//
// Levels by size as in hierarchical spatial hashing (Ericson 2005, Real-Time Collision Detection, 7.2); each has its own box and its own
// bricks. A box is listed in every cell of its level that it shares a step with (raster.h), or comes within a step of.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <grid/level.h>
#include <pierce/executor.h>

namespace pierce::detail {

/// The box of one triangle in the caller's own numbers. One whose `low[0]` is above its `high[0]` is not listed.
template <class Scalar>
struct PlainBox {
    std::array<Scalar, 3> low;
    std::array<Scalar, 3> high;
    [[nodiscard]] bool listed() const { return low[0] <= high[0]; }
};

struct GridOptions {
    double cell_size = 0;       ///< of the finest level; 0: chosen from the boxes
    std::size_t max_bytes = 0;  ///< for the levels together
};

class Grid {
  public:
    Grid() = default;
    template <class Scalar>
    Grid(std::span<const PlainBox<Scalar>> boxes, const GridOptions& options, const Executor& executor);

    [[nodiscard]] std::span<const Level> levels() const { return levels_; }  ///< the finest first
    [[nodiscard]] const Box& bounds() const { return bounds_; }              ///< of what is listed
    /// The ids in the cells are places in this list of the caller's numbers: sorted by level and cell, so that what is near in space
    /// is near in memory. It is for the caller to take, and to sort his own by.
    [[nodiscard]] std::vector<std::uint32_t> take_order() { return std::move(order_); }
    [[nodiscard]] bool empty() const { return levels_.empty(); }
    [[nodiscard]] std::size_t bytes() const;

  private:
    std::vector<Level> levels_;
    std::vector<std::uint32_t> order_;
    Box bounds_{};
};

}  // namespace pierce::detail
