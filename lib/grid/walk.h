// Which cells a segment may touch.
//
// Short segments: every cell that their box shares a step with. Nothing is computed along the way, so nothing can be missed (raster.h).
//
// Long segments: cell by cell in the order of the segment (Amanatides and Woo 1987), striding over empty space by the distances kept
// with empty bricks (Cohen and Sheffer 1994, "Proximity clouds"). Two margins make it certain: boxes are listed in every cell that they
// come within a step (1/128 of a cell) of, and what is asked of a cell is a step larger on all sides. Why they are enough:
//
// Let P(s) be the exact place of the segment's point at fraction s, in cells, for the raster's numbers as stored, and
// L(s) = f + s d the line that the walk follows, with f, d computed. With u = 2^-52 and M the largest of |f|, |f + d| and the number
// of cells, f and t are within 3u M of their exact values (three roundings) and d = t - f within 8u M: |L(s) - P(s)| < 11u M for
// every s in [0, 1].
//   - The s at which L reaches a wall is computed with three roundings, each time from the start: a shift along L of less than 8u M.
//     Places on L are computed to within 4u M.
//   - An axis along which |d| < 2^-20 counts as constant, which is off by less than 2^-20.
// The walk keeps to M < 2^36: everything together is less than 23 * 2^-52 * 2^36 + 2^-20 < 2^-10 cells, an eighth of a step. So at every fraction s at which it is in a region (a cell, or a block of empty bricks), P(s) is within 2^-9 cells of it, also where L has left
// the grid by less than that: the outermost cells reach further by `k_pad`. A box that holds P(s) is then listed in
// that cell, or the region would not be empty; and shares a step with what is asked there.
//
// Longer segments: see clip().
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <grid/level.h>

namespace pierce::detail {

/// The cells from `first` to `last`, in order of z, y, x, that hold something: `visitor(range, cull)`. Each box that shares a step with
/// `box` is left by one of them only.
template <class Visitor>
void visit_block(const Level& level, const Steps& box, const Cell& first, const Cell& last, Visitor&& visitor) {
    Cell cell{};
    for (cell[2] = first[2]; cell[2] <= last[2]; ++cell[2])
        for (cell[1] = first[1]; cell[1] <= last[1]; ++cell[1])
            for (cell[0] = first[0]; cell[0] <= last[0]; ++cell[0]) {
                const Brick& brick = level.brick_of(cell);
                const std::uint64_t bit = Level::bit_of(cell);
                if ((brick.cells & bit) == 0) continue;
                Cull cull = cull_of(box, cell);
                cull.seen = seen_before(cell, first);
                visitor(level.range(level.number(brick, bit)), cull);
            }
}

/// A part of a segment, in cells of a level: the place at fraction s is `from + s * d`, for s in [first, last].
struct Line {
    Point from;
    Point d;
    double first;
    double last;
};

constexpr double k_pad = 0x1p-8;
constexpr double k_flat = 0x1p-20;
constexpr double k_furthest = 0x1p36;

/// The part of a segment that lies in the level's cells or within `k_pad` of them; `tame` says whether the walk may follow it.
[[nodiscard]] inline Line clip(const Raster& raster, const Path& path, bool& tame) {
    Line line{{}, {}, 0, 1};
    double most = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        line.from[k] = raster.place(k, path.from[k]);
        const double to = raster.place(k, path.to[k]);
        line.d[k] = to - line.from[k];
        most = std::max({most, std::abs(line.from[k]), std::abs(to)});
    }
    tame = most < k_furthest;
    for (std::size_t k = 0; k < 3; ++k) {
        if (std::abs(line.d[k]) < k_flat) continue;
        const double inverse = 1 / line.d[k];
        const double s0 = (-k_pad - line.from[k]) * inverse;
        const double s1 = (raster.cells()[k] + k_pad - line.from[k]) * inverse;
        line.first = std::max(line.first, std::min(s0, s1));
        line.last = std::min(line.last, std::max(s0, s1));
    }
    return line;
}

/// Calls `visitor(range, cull, s)` for the cells on a line that hold something, from its start to its end; s is the fraction at which the
/// line enters the cell. When it is done with one and `limit()` lies before the next, it stops: all that it has not seen is beyond the
/// limit. With `once`, `cull` leaves every box that the cells list exactly once; without, those near the line in each cell.
///
/// Once: the cells go one way along each axis, so those that list a box follow one another, and it is enough to know the one before.
template <class Limit, class Visitor>
void walk(const Level& level, const Line& line, bool once, Limit&& limit, Visitor&& visitor) {
    const Cell& cells = level.raster().cells();
    constexpr double k_never = std::numeric_limits<double>::infinity();
    Cell cell{};
    Cell step{};        // -1, 0 or 1
    Point inverse{};
    Point at{};         // where the line is, in cells
    double s = line.first;
    const auto locate = [&](double fraction) {
        for (std::size_t k = 0; k < 3; ++k) at[k] = line.from[k] + fraction * line.d[k];
    };
    Cull unseen = cull_none();
    locate(s);
    for (std::size_t k = 0; k < 3; ++k) {
        cell[k] = std::clamp(static_cast<int>(at[k]), 0, cells[k] - 1);
        if (std::abs(line.d[k]) < k_flat) continue;
        step[k] = line.d[k] > 0 ? 1 : -1;
        inverse[k] = 1 / line.d[k];
    }
    // The fraction at which the line leaves the cells from `low` to `high` along an axis.
    const auto leaves = [&](std::size_t k, int low, int high) {
        if (step[k] == 0) return k_never;
        const double wall = step[k] > 0 ? (high + 1 >= cells[k] ? cells[k] + k_pad : high + 1) : (low <= 0 ? -k_pad : low);
        return (wall - line.from[k]) * inverse[k];
    };
    for (;;) {
        const Brick& brick = level.brick_of(cell);
        const std::uint64_t bit = Level::bit_of(cell);
        Cell low = cell;
        Cell high = cell;
        if (brick.empty != 0) {
            const int reach = static_cast<int>(brick.empty) * 4 - 4;
            for (std::size_t k = 0; k < 3; ++k) {
                low[k] = (cell[k] & ~3) - reach;
                high[k] = (cell[k] | 3) + reach;
            }
        }
        const Point out = {leaves(0, low[0], high[0]), leaves(1, low[1], high[1]), leaves(2, low[2], high[2])};
        const std::size_t axis = out[0] < out[1] ? (out[0] < out[2] ? 0 : 2) : (out[1] < out[2] ? 1 : 2);
        const double leave = std::min(out[axis], line.last);
        const Point before = at;
        locate(leave);
        if ((brick.cells & bit) != 0 && once) {
            visitor(level.range(level.number(brick, bit)), unseen, s);
        } else if ((brick.cells & bit) != 0) {
            Steps box{};
            for (std::size_t k = 0; k < 3; ++k) {
                // In steps of the cell, and never far from it: 2^10 makes the truncation a rounding down.
                const double corner = cell[k];
                box.low[k] = static_cast<int>((std::min(before[k], at[k]) - corner) * k_steps + 1023) - 1024;
                box.high[k] = static_cast<int>((std::max(before[k], at[k]) - corner) * k_steps + 1025) - 1024;
            }
            visitor(level.range(level.number(brick, bit)), cull_of(box, {0, 0, 0}), s);
        }
        if (!(out[axis] < line.last) || limit() < leave) return;
        s = leave;
        const int next = step[axis] > 0 ? high[axis] + 1 : low[axis] - 1;
        if (next < 0 || next >= cells[axis]) return;
        for (std::size_t k = 0; k < 3; ++k) {
            if (step[k] == 0 || brick.empty == 0) continue;
            const int place = static_cast<int>(at[k]);
            cell[k] = step[k] > 0 ? std::clamp(place, cell[k], std::min(high[k], cells[k] - 1))
                                  : std::clamp(place, std::max(low[k], 0), cell[k]);
        }
        cell[axis] = next;
        unseen = brick.empty == 0 ? cull_seen(axis, step[axis]) : cull_none();
    }
}

}  // namespace pierce::detail
