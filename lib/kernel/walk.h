// Which cells a long segment may touch, in its order: from cell to cell (Amanatides and Woo 1987), striding over empty space by the
// tree's empty parts and the distances kept with empty roots (Cohen and Sheffer 1994, "Proximity clouds").
//
// Two margins make it certain: boxes are listed in every cell that they come within a step (1/128 of a cell) of, and lie at least a
// step inside of the grid; and what is asked of a cell is a step larger on all sides. Why they are enough:
//
// Let P(s) be the exact place of the segment's point at fraction s, in cells, for the raster's numbers as stored, and
// L(s) = f + s d the line that the walk follows, with f, d computed. With u = 2^-52 and M the largest of |f|, |f + d| and the number
// of cells, f and t are within 3u M of their exact values (three roundings) and d = t - f within 8u M: |L(s) - P(s)| < 11u M for
// every s in [0, 1].
//   - The s at which L reaches a wall is computed with a few roundings, each time from the start: a shift along L of less than 8u M.
//     Places on L are computed to within 4u M.
//   - An axis along which |d| < 2^-20 counts as constant, which is off by less than 2^-20.
// The walk is for M < 2^35 only: everything together is less than 23 * 2^-52 * 2^35 + 2^-20 < 2^-11 cells, a sixteenth of a step. So at
// every fraction s at which it is in a region (a cell, or a cube of empty ones), P(s) is within 2^-10 cells of it, and where L is
// outside of the grid, P(s) is in no box. A box that holds P(s) is then listed in that cell, or the region would not be empty; and
// shares a step with what is asked there.
//
// As lanes.h: for any instruction set, included by backend_*.cpp, with nothing that other files could share.
#pragma once

#include <kernel/block.h>

namespace pierce::detail {

namespace {

constexpr double k_infinity = __builtin_inf();
constexpr double k_flat = 0x1p-20;  ///< an axis along which a line goes less counts as constant

[[gnu::always_inline]] inline double smaller(double x, double y) { return x < y ? x : y; }
[[gnu::always_inline]] inline double larger(double x, double y) { return x > y ? x : y; }

// The fraction at which the line leaves the current cells along an axis; infinity where it is constant. `wall` is in its direction.
[[gnu::always_inline]] inline double leaves(const Walk& walk, int k, double wall) {
    return (wall - walk.from[k]) * walk.inverse[k] + walk.bias[k];
}

[[gnu::always_inline]] inline void enter_cell(Walk& walk, int k, int cell) {
    walk.cell[k] = cell;
    walk.wall[k] = cell + (walk.step[k] > 0 ? 1 : 0);
    walk.leave[k] = leaves(walk, k, walk.wall[k]);
}

[[gnu::always_inline]] inline int first_to_leave(const double* leave) {
    const int k = leave[1] < leave[0] ? 1 : 0;
    return leave[2] < leave[k] ? 2 : k;
}

}  // namespace

/// Starts the walk of the segment between two points.
template <class Wide>
[[gnu::always_inline]] inline Walking start_walk(const PackedLevel& level, const double* start, const double* finish, double limit,
                                                 bool once, Walk& walk) {
    double first = 0;
    double last = 1;
    double most = 0;
    for (int k = 0; k < 3; ++k) {
        const double from = (0.5 * start[k] - level.half_low[k]) * level.scale[k] * (1.0 / k_steps);
        const double to = (0.5 * finish[k] - level.half_low[k]) * level.scale[k] * (1.0 / k_steps);
        const double d = to - from;
        most = larger(most, larger(from < 0 ? -from : from, to < 0 ? -to : to));
        walk.from[k] = from;
        walk.d[k] = d;
        const bool flat = d < k_flat && d > -k_flat;
        walk.step[k] = flat ? 0 : d > 0 ? 1 : -1;
        walk.inverse[k] = flat ? 0 : 1 / d;
        walk.bias[k] = flat ? k_infinity : 0;
        if (flat) {
            if (!(from > -1 && from < level.cells[k] + 1)) return Walking::no;
        } else if (!(smaller(from, to) >= 0 && larger(from, to) <= level.cells[k])) {
            const double s0 = (0 - from) * walk.inverse[k];
            const double s1 = (level.cells[k] - from) * walk.inverse[k];
            first = larger(first, smaller(s0, s1));
            last = smaller(last, larger(s0, s1));
        }
    }
    if (!(most < 0x1p34)) return Walking::never;  // one more for the cells, of which there are at most 2^20
    if (!(first <= last) || limit < first) return Walking::no;
    for (int k = 0; k < 3; ++k) {
        // Truncation is rounding down from 0 on, and below it the first cell is meant.
        const int place = static_cast<int>(walk.from[k] + first * walk.d[k]);
        enter_cell(walk, k, place < 0 ? 0 : place >= level.cells[k] ? level.cells[k] - 1 : place);
    }
    walk.enter = first;
    walk.last = last;
    walk.unseen = 0;
    walk.once = once;
    walk.over = false;
    return Walking::along;
}

/// What is near the line in the cell that it enters, and a step more. 2^10 makes the truncation a rounding down.
template <class Wide>
[[gnu::always_inline]] inline std::uint64_t near_line(const Walk& walk) {
    const double leave = smaller(smaller(walk.leave[0], walk.leave[1]), smaller(walk.leave[2], walk.last));
    Double4 from;
    Double4 d;
    // One by one: they were just written that way, and a load of all four would wait for it.
    const Int4 cell = {walk.cell[0], walk.cell[1], walk.cell[2], 0};
    __builtin_memcpy(&from, walk.from, sizeof from);
    __builtin_memcpy(&d, walk.d, sizeof d);
    from -= __builtin_convertvector(cell, Double4);
    Double4 low = (from + walk.enter * d) * double{k_steps};
    Double4 high = (from + leave * d) * double{k_steps};
    const Double4 other = low;
    Wide::lower(low, high);
    Wide::raise(high, other);
    low += 1023;
    high += 1025;
    const Int4 before = {1024, 1024, 1024, 1024};
    const Int4 zero = {0, 0, 0, 0};
    const Int4 least = {-127, -127, -127, -127};
    Int4 upper = __builtin_convertvector(high, Int4) - before;
    Int4 lower = before - __builtin_convertvector(low, Int4);
    upper = upper > zero ? upper : zero;
    lower = lower > least ? lower : least;
    upper[3] = 127;
    lower[3] = 127;
    return Wide::pack(upper, lower);
}

/// The next cells on the line that hold something, at most `room`; fewer only when there are no more, or when the line comes to them only
/// beyond `limit`. With `once`, the stops leave every box that the cells list exactly once: the cells go one way along each axis, so
/// those that list a box follow one another, and it is enough to know the one before. Without, those near the line in each cell.
template <class Wide>
[[gnu::always_inline]] inline unsigned walk_on(const PackedLevel& level, Walk& walk, double limit, Stop* stops, unsigned room) {
    if (walk.over) return 0;
    unsigned found = 0;
    const double end = smaller(walk.last, limit);
    const int top = level.root_shift;
    for (;;) {
        // Down the tree, to the brick or to an empty cube around.
        const Node* node = level.nodes + (static_cast<std::size_t>(walk.cell[0] >> top) * level.strides[0] +
                                          static_cast<std::size_t>(walk.cell[1] >> top) * level.strides[1] +
                                          static_cast<std::size_t>(walk.cell[2] >> top) * level.strides[2]);
        std::uint64_t parts = node->parts;
        int shift = top;
        int reach = static_cast<int>(node->empty - 1) << top;
        while (parts != 0 && shift > 2) {
            shift -= 2;
            const std::uint64_t bit = std::uint64_t{1} << ((walk.cell[0] >> shift & 3) | (walk.cell[1] >> shift & 3) << 2 |
                                                           (walk.cell[2] >> shift & 3) << 4);
            reach = 0;
            if ((parts & bit) == 0) {
                parts = 0;
            } else {
                node = level.nodes + (node->first + Wide::count_bits(parts & (bit - 1)));
                parts = node->parts;
            }
        }
        int axis;
        if (parts == 0) {
            const int mask = (1 << shift) - 1;
            double leave[3];
            int furthest[3];
            for (int k = 0; k < 3; ++k) {
                furthest[k] = walk.step[k] > 0 ? (walk.cell[k] | mask) + reach : (walk.cell[k] & ~mask) - reach;
                leave[k] = leaves(walk, k, furthest[k] + (walk.step[k] > 0 ? 1 : 0));
            }
            axis = first_to_leave(leave);
            walk.enter = leave[axis];
            if (!(walk.enter < end)) break;
            const int next = furthest[axis] + walk.step[axis];
            if (next < 0 || next >= level.cells[axis]) break;
            for (int k = 0; k < 3; ++k) {
                // Forward only, and not out of the cube.
                const int place = static_cast<int>(walk.from[k] + walk.enter * walk.d[k]);
                int low = walk.step[k] > 0 ? walk.cell[k] : furthest[k];
                int high = walk.step[k] < 0 ? walk.cell[k] : furthest[k];
                if (walk.step[k] == 0) low = high = walk.cell[k];
                high = high < level.cells[k] ? high : level.cells[k] - 1;
                low = low > 0 ? low : 0;
                const int cell = k == axis ? next : place < low ? low : place > high ? high : place;
                enter_cell(walk, k, cell);
            }
            walk.unseen = 0;
            continue;
        }
        // From cell to cell of the brick.
        const int brick[3] = {walk.cell[0] & ~3, walk.cell[1] & ~3, walk.cell[2] & ~3};
        for (;;) {
            const std::uint64_t bit = std::uint64_t{1} << ((walk.cell[0] & 3) | (walk.cell[1] & 3) << 2 | (walk.cell[2] & 3) << 4);
            if ((parts & bit) != 0) {
                Stop& stop = stops[found++];
                stop.number = node->first + Wide::count_bits(parts & (bit - 1));
                stop.cull = walk.once ? Cull{0x7f7f7f7f7f7f7f7f, walk.unseen} : Cull{near_line<Wide>(walk), 0};
                stop.fraction = walk.enter;
            }
            axis = first_to_leave(walk.leave);
            walk.enter = walk.leave[axis];
            const int next = walk.cell[axis] + walk.step[axis];
            if (!(walk.enter < end) || next < 0 || next >= level.cells[axis]) {
                walk.over = true;
                return found;
            }
            walk.cell[axis] = next;
            walk.wall[axis] += walk.step[axis];
            walk.leave[axis] = leaves(walk, axis, walk.wall[axis]);
            // As a box's flags: bit k of byte 3 if the cell before lists it, of byte 7 if the one after does.
            walk.unseen = std::uint64_t{1} << ((walk.step[axis] > 0 ? 24 : 56) + axis);
            if (found == room) return found;
            if ((next & ~3) != brick[axis]) break;
        }
    }
    walk.over = true;
    return found;
}

}  // namespace pierce::detail
