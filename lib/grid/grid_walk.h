// The cells of a uniform grid that a segment may touch, slab by slab along its longest axis. The proof is below the
// code.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pierce::detail {

/// Cubes of edge `size`, `count[k]` of them along axis k, from `low[k]` on. Coordinates are relative to Frame::low.
struct GridCells {
    static constexpr int k_most_along = 65535;

    double low[3] = {};
    double size = 1;
    double inverse = 1;  ///< of the size, rounded
    double reach = 0;    ///< of all that is listed: no coordinate is larger
    int count[3] = {};

    /// In cells, not rounded to a whole number; it never decreases with x.
    [[nodiscard]] double place(std::size_t axis, double x) const { return (x - low[axis]) * inverse; }
    /// The cell of x; 0 below all and for NaN, `count` above all.
    [[nodiscard]] int cell_from(std::size_t axis, double x) const {
        const double p = place(axis, x);
        return p > 0 ? (p < count[axis] ? static_cast<int>(p) : count[axis]) : 0;
    }
    /// The cell of x; -1 below all, the last above all and for NaN.
    [[nodiscard]] int cell_to(std::size_t axis, double x) const {
        const double p = place(axis, x);
        return p < count[axis] ? (p >= 0 ? static_cast<int>(p) : -1) : count[axis] - 1;
    }
    [[nodiscard]] double wall(std::size_t axis, int cell) const { return low[axis] + cell * size; }
};

/// Cells of one slab: all from `low` to `high` in both axes across the walk. Where there are none, one end is beyond
/// the grid.
struct CellRectangle {
    int low[2];
    int high[2];
};
constexpr CellRectangle k_no_cells = {{GridCells::k_most_along, GridCells::k_most_along}, {-1, -1}};

class GridWalk {
  public:
    GridWalk(const GridCells& cells, const double origin[3], const double direction[3], double noise, double limit)
        : cells_(cells) {
        double most_origin = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            if (std::abs(direction[k]) > std::abs(direction[along])) along = k;
            most_origin = std::max(most_origin, std::abs(origin[k]));
        }
        across[0] = along == 0 ? 1 : 0;
        across[1] = along == 2 ? 1 : 2;
        forward_ = !(direction[along] < 0);
        length_ = std::abs(direction[along]);
        margin_ = noise + 0x1p-47 * (most_origin + length_ + cells.reach + cells.size + noise);
        origin_ = origin[along];
        for (std::size_t i = 0; i < 2; ++i) {
            start_[i] = origin[across[i]];
            slope_[i] = length_ == 0 ? 0 : direction[across[i]] / length_;
        }
        shorten(limit);
        const double end = forward_ ? origin_ + end_ : origin_ - end_;
        const int from = cells.cell_from(along, (forward_ ? origin_ : end) - margin_);
        const int to = cells.cell_to(along, (forward_ ? end : origin_) + margin_);
        left_ = to - from + 1;  // the origin's slab may be above the end's: then none
        slab = forward_ ? from : to;
    }

    /// The segment ends at the fraction `limit`. Slabs begun are not changed.
    void shorten(double limit) { end_ = limit * length_; }

    /// The next slab's rectangle; false if there is none.
    bool next(CellRectangle& rectangle) {
        if (left_-- <= 0) return false;
        if (begun_) slab += step();
        begun_ = true;
        const double enter = from_origin(forward_ ? slab : slab + 1) - margin_;
        const double leave = from_origin(forward_ ? slab + 1 : slab) + margin_;
        const double near = enter > 0 ? enter : 0;       // NaN: from the origin on
        const double far = leave < end_ ? leave : end_;  // NaN: to the end
        if (near > end_) return false;
        for (std::size_t i = 0; i < 2; ++i) {
            const double x = start_[i] + near * slope_[i];
            const double y = start_[i] + far * slope_[i];
            const bool rises = slope_[i] >= 0;
            rectangle.low[i] = cells_.cell_from(across[i], (rises ? x : y) - margin_);
            rectangle.high[i] = cells_.cell_to(across[i], (rises ? y : x) + margin_);
        }
        return true;
    }

    [[nodiscard]] int step() const { return forward_ ? 1 : -1; }

    std::size_t along = 0;
    std::size_t across[2];
    int slab;  ///< the one that `next` was last about

  private:
    /// How far a wall is from the origin in the direction of the walk.
    [[nodiscard]] double from_origin(int cell) const {
        const double x = cells_.wall(along, cell) - origin_;
        return forward_ ? x : -x;
    }

    const GridCells& cells_;
    double origin_, length_, margin_, end_ = 0;
    double start_[2], slope_[2];
    int left_;
    bool forward_, begun_ = false;
};

// What is claimed. A box is listed in the cells F(b) of its points b, F being `place` of the rounded b, cut to a whole
// number, axis by axis. Let the point p(t) = origin + t * direction, 0 <= t <= limit, be within `noise` of a point b of
// the box in each coordinate. Then the slab F(b) along the walk is not left out, and its rectangle has the cells F(b)
// across it.
//
// Roundings. e = 2^-52 bounds the relative error of one operation in any rounding mode.
// R = |origin| + |direction| + reach + size, in the maximum norm; `reach` bounds |b| and |low|. An operation that
// underflows errs by 2^-1074 more, which is nothing beside e * R: sizes are 2^-47 or more (UniformGrid::make). (Nor are
// the 2^-150 that the box of a float's cluster may have lost when it was scaled.) m is the margin.
//
//  1. F against walls. With j <= place(b) < j + 1: the error of the rounded b is e * reach, those of the difference, of
//     the product and of the inverse are each 2 e * reach, at first order; so low + j * size - b <= 7.1 e * reach, and
//     b - (low + (j + 1) * size) is no more. A wall's own error: e * |j * size| + e * |wall| <= e * (3 reach + 2 size).
//     Together b is beyond the walls of its slab as computed by <= 10.1 e * R.
//  2. r = t * |direction[along]| is how far p(t) is along the walk. r >= (wall - origin) - noise - 10.1 e * R; `enter`
//     has the error of a difference, e * R, and that of subtracting m, e * (R + m). So enter <= r - e * R if m >= noise
//     + 13.1 e * R + e * m. (`leave` likewise, >= r.) `end_` is at least r - e * R. Hence near <= end_: the slab isn't
//     left out; and near <= r <= far + e * R.
//  3. Across: the real slope is <= 1 in size, since `along` is the longest axis. start + near * slope errs by 2.1 e *
//     near for slope and product and e * R for the sum, so by <= 3.1 e * R (near, far <= R); `far` may lack e * R;
//     subtracting m errs by e * (R + m). The line being monotone, what is given to `cell_from` is <= p - noise <= b if
//     m >= noise + 5.1 e * R + e * m. It is a double, so the rounded b is no less, and `place` never decreases.
//     `cell_to` likewise. The first and the last slab: the same with fewer operations (e * R for the end, e * R for its
//     sum, e * (R + m)).
//  4. m = noise + 2^-47 (R + noise) as computed is at least noise + 31 e * (R + noise), more than all of these ask for.
//
// Each once. Along the walk `enter`, so `near`, never decreases: each operation in it is monotone in the slab, rounded
// or not. `leave` neither; `end_` never increases, as limits don't (UniformGrid::visit sees to that); so `far` rises,
// then falls. Hence of an axis across with slope >= 0 the low end of the rectangles rises, and the high end rises, then
// falls; with slope < 0 the high end falls, and the low end falls, then rises. In each case "the rectangle meets the
// range c.low..c.high in this axis" holds for slabs that follow one another: where an end rises then falls, "high end
// >= c.low" holds in between, and so on. So do the slabs of the range itself. A box is therefore met in an interval of
// the walk, and it is visited where it is met but was not in the slab before, in the least cell of rectangle and range.
// (A rectangle without cells meets no range: x - m <= y + m, since y is below x by roundings at most, so it lacks cells
// only where an end is beyond the grid.) NaN in any number makes `near` 0, `far` the end, or an end of all rectangles
// the outermost cell: all the walk long, so all of this holds.

}  // namespace pierce::detail
