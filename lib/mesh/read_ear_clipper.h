// Ear clipping of a polygon in the plane, with exact turns and a grid over the corners that can be in the way.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesh/read_corner_grid.h"
#include "mesh/read_orient2d.h"

namespace pierce::detail {

/// Cuts off one ear after another: a corner that turns left, with no other corner in the triangle that it makes with
/// its neighbours. (Meisters 1975, "Polygons have ears"; only the two neighbours of a clipped ear have to be looked at
/// again, O'Rourke 1998, "Computational Geometry in C", section 1.4, so at most 3 n corners are looked at.)
///
/// Only corners that do not turn left can lie in such a triangle; a grid finds them. The shortest cut goes first, so
/// that the triangles stay small. Outlines of letters or lakes, and combs and spirals, take about n log n: less than a
/// second for 10^5 corners. The worst case, when most triangles are long and have many corners near them all the time,
/// is quadratic: the number of corners times the number of those that do not turn left.
class EarClipper {
  public:
    /// Writes the triangles, as places in `points`, which run counter-clockwise around the polygon. There must be two
    /// fewer triangles than points. All turn left if the polygon does not cross or touch itself; touching, as along the
    /// bridge between an outline and its hole, is mostly cut well too. When no ear is left, corners on a line with
    /// their neighbours are cut off, and after that the rest is cut as a fan.
    void cut(std::span<const Point2> points, std::span<std::array<std::uint32_t, 3>> triangles);

  private:
    void start(std::span<const Point2> points);
    bool clip_next_ear();
    bool clip_next_flat();
    void clip(std::uint32_t tip);
    void look_again(std::uint32_t corner);
    [[nodiscard]] double diagonal(std::uint32_t tip) const;
    [[nodiscard]] int turn_at(std::uint32_t corner) const;
    [[nodiscard]] bool is_in_the_way(std::uint32_t corner) const { return !clipped_[corner] && turn_[corner] <= 0; }
    [[nodiscard]] bool is_blocked(std::uint32_t tip) const;
    void rebuild_grid();

    std::span<const Point2> points_;
    std::span<std::array<std::uint32_t, 3>> left_;  // triangles still to be written
    std::vector<std::uint32_t> previous_, next_;    // the ring of corners not yet clipped
    std::vector<std::int8_t> turn_;
    std::vector<std::uint8_t> clipped_;
    // Corners to look at: those that turn left as a heap, those that do not turn as a stack.
    std::vector<std::pair<double, std::uint32_t>> ears_;
    std::vector<std::uint32_t> flats_;
    std::vector<std::uint32_t> in_the_way_;
    CornerGrid grid_;
    std::size_t obstacles_ = 0;
};

}  // namespace pierce::detail
