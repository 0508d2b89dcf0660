// The cells that a segment may touch, slice by slice along it. It knows cells, no triangles.
//
// Certified: if a point of the segment lies in a listed box, some visited cell lists that box. Source: a slab walk in the place
// of Amanatides and Woo 1987, whose running sums drift; here each slice is computed afresh from the segment's ends.
//
// Let G(x) = (x - low) * scale be the exact place of a coordinate, for the scale as stored, and g(x) the computed one:
// |g - G| <= 2.1 u |G| with u = 2^-52 (two roundings, any rounding mode). A box [a, b] is listed in the cells from
// g(a) to g(b), cut to integers and clamped; a point x of it has G(a) <= G(x) <= G(b), so a listed cell lies within
// 2.1 u |G| of G(x). The segment runs from G(from) to G(to), a straight line. With f = g(from), t = g(to), d = t - f and M the
// largest of |f|, |t| and the number of cells on the axis:
//   - f + s d, computed, is within 2.1 u M (f) + s (4.2 u M + 2 u M) (d, its difference) + 2 u M (product) + 3 u M (sum) < 16 u M
//     of the exact place at s;
//   - the s at which the line reaches a wall w of the main axis, (w - f) / d, computed, is off by what moves the line by less than
//     16 u M along that axis (the terms above), and two roundings of s, |s| <= 1 after clamping, which move it by less than
//     4 u M along any axis; along the other axes |d| is smaller, so the shift is no larger there.
// Everything together is below 40 u M. The walk pads every interval by 64 u M, taken over all three axes: less than 2^-26 cells
// for a segment around the grid. From 2^40 cells outside on it is a part of a cell, and from 2^55 on the whole grid: every cell is
// visited then, which is right, and as slow as it sounds.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <grid/grid.h>

namespace pierce::detail {

/// The cells visited in one slice: `index` on the main axis, a block on the other two.
struct Slice {
    int index = -1;  // -1: none
    std::array<int, 2> first = {0, 0};
    std::array<int, 2> last = {-1, -1};

    /// Whether the slice has a cell of `range`; `axis` is the main axis.
    [[nodiscard]] bool meets(const CellRange& range, std::size_t axis) const {
        if (index < range.first[axis] || index > range.last[axis]) return false;
        for (std::size_t k = 0; k < 2; ++k) {
            const std::size_t other = (axis + 1 + k) % 3;
            if (last[k] < range.first[other] || first[k] > range.last[other]) return false;
        }
        return true;
    }
};

/// Where the walk stands.
struct Visit {
    std::size_t axis = 0;  ///< the main axis: the one along which the segment crosses the most cells
    Slice slice;
    Slice before;           ///< the slice visited just before; its index is -1 at the start, or if that one held no cell
    std::array<int, 2> at = {0, 0};  ///< the cell on the two other axes, (axis + 1) % 3 and (axis + 2) % 3

    /// Whether this cell is the first of the walk to list a box with that range. Along the walk both other intervals move one way
    /// only, so the slices that meet the range follow one another, and it is enough to look at the one before.
    [[nodiscard]] bool first_with(const CellRange& range) const {
        if (before.index >= 0 && before.meets(range, axis)) return false;
        for (std::size_t k = 0; k < 2; ++k)
            if (at[k] != std::max(slice.first[k], range.first[(axis + 1 + k) % 3])) return false;
        return true;
    }
};

/// Calls `visitor(cell, visit)` for the cells that the segment may touch, in slices from `from` to `to`. Before each slice the
/// walk stops if `limit()`, a fraction of the segment, lies before it: all that is still to come is then beyond the limit.
template <class Limit, class Visitor>
void walk(const Grid& grid, const Path& path, Limit&& limit, Visitor&& visitor) {
    const GridShape& shape = grid.shape();
    Point f{};
    Point t{};
    Point d{};
    double most = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        f[k] = shape.place(k, path.from[k]);
        t[k] = shape.place(k, path.to[k]);
        d[k] = t[k] - f[k];
        most = std::max({most, std::abs(f[k]), std::abs(t[k]), static_cast<double>(shape.cells[k])});
    }
    const std::size_t axis =
        std::abs(d[0]) >= std::abs(d[1]) ? (std::abs(d[0]) >= std::abs(d[2]) ? 0U : 2U)
                                         : (std::abs(d[1]) >= std::abs(d[2]) ? 1U : 2U);
    // Not finite (an end that overflows on its way into the grid): pad with infinity, which visits every cell.
    double pad = 64 * 0x1p-52 * most;
    const bool tame = std::isfinite(d[0]) && std::isfinite(d[1]) && std::isfinite(d[2]) && pad < 0x1p100;
    if (!tame) pad = std::numeric_limits<double>::infinity();

    // The padded interval of places between two fractions, as cells; empty if it lies outside of the grid.
    const auto interval = [&](std::size_t k, double s0, double s1, int& first, int& last) {
        double low = -pad;
        double high = pad;
        if (tame) {
            const double p0 = f[k] + s0 * d[k];
            const double p1 = f[k] + s1 * d[k];
            low += std::min(p0, p1);
            high += std::max(p0, p1);
        }
        const double cells = shape.cells[k];
        if (high < 0 || low > cells) return false;
        first = low >= 1 ? std::min(static_cast<int>(low), shape.cells[k] - 1) : 0;
        last = high >= cells ? shape.cells[k] - 1 : static_cast<int>(high);
        return true;
    };

    int lowest = 0;
    int highest = -1;
    if (!interval(axis, 0, 1, lowest, highest)) return;
    const bool forward = d[axis] >= 0 || !tame;
    const std::size_t one = (axis + 1) % 3;
    const std::size_t two = (axis + 2) % 3;
    // Shorter than the padding along its main axis: every slice may hold all of it.
    const bool divisible = tame && std::abs(d[axis]) > 4 * pad;

    Visit visit;
    visit.axis = axis;
    std::array<int, 3> cell{};
    for (int step = 0; step <= highest - lowest; ++step) {
        const int index = forward ? lowest + step : highest - step;
        double enter = 0;
        double leave = 1;
        if (divisible) {
            const double s0 = (index - pad - f[axis]) / d[axis];
            const double s1 = (index + 1 + pad - f[axis]) / d[axis];
            enter = std::clamp(std::min(s0, s1), 0.0, 1.0);
            leave = std::clamp(std::max(s0, s1), 0.0, 1.0);
        }
        if (enter > limit()) return;
        visit.before = visit.slice;
        visit.slice.index = -1;
        Slice slice;
        if (!interval(one, enter, leave, slice.first[0], slice.last[0]) ||
            !interval(two, enter, leave, slice.first[1], slice.last[1]))
            continue;
        slice.index = index;
        visit.slice = slice;
        cell[axis] = index;
        for (cell[two] = slice.first[1]; cell[two] <= slice.last[1]; ++cell[two])
            for (cell[one] = slice.first[0]; cell[one] <= slice.last[0]; ++cell[one]) {
                visit.at = {cell[one], cell[two]};
                visitor(shape.index(cell[0], cell[1], cell[2]), visit);
            }
    }
}

}  // namespace pierce::detail
