// Which cells a long segment may touch, in its order: down the tree of nodes of 4 x 4 x 4 parts, where all parts of a node that the line
// touches are found at once, whether they hold anything or not, so that it takes no step through what is empty. (The tree is that of
// sparse voxels, as in Museth 2013, VDB; without a step for each of its cells, and with all margins that certainty needs.)
//
// Along each axis, the line is in a slab of cells for an interval of fractions; it is in a cell where its three intervals have a fraction
// in common. Two margins make it certain: boxes are listed in every cell that they come within a step (1/128 of a cell) of, and lie at
// least a step inside of the grid; and what is asked of a cell is a step larger on all sides. Why they are enough:
//
// Let P(s) be the exact place of the segment's point at fraction s, in cells, for the raster's numbers as stored, and
// L(s) = f + s d the line that the walk follows, with f, d computed. With u = 2^-52 and M the largest of |f|, |f + d| and the number
// of cells, f and t are within 3u M of their exact values (three roundings) and d = t - f within 8u M: |L(s) - P(s)| < 11u M for
// every s in [0, 1].
//   - An axis along which |d| < 2^-20 is given that much, which puts L off by less than 2^-20.
//   - Where an interval ends, (wall - f) / d, is computed with three roundings: a shift along the axis of less than 4u M. Places on L are
//     computed to within 4u M.
// The walk is for M < 2^35 only (2^34, and the cells): everything together is less than 23 * 2^-52 * 2^35 + 2^-20 < 2^-11 cells, a sixteenth of a step. One slab's
// interval ends where the next one's begins, as computed: so for every s there is a cell whose three intervals hold it. P(s) is within
// 2^-11 cells of it. A box that holds P(s) is then listed in that cell, and shares a step with what is asked there.
//
// Nodes are asked in single precision, so what the cells of a node are in is looked for with all parts made wider, by k_margin of a part:
// relative to the fraction at which the line comes to the node, made wider, which is at most s. It leaves the node within 5 parts' worth
// along each axis: an interval's end is below that, and computed with three roundings to within 20 * 2^-24 of a part, as s is.
//
// With `once`, every box that the cells list is left to exactly one of them: a cell leaves it to the neighbour before it along an axis if
// that lists the box, too, and is visited. The first of the visited cells that list the box keeps it. For they are all in the box's range
// along each axis, and where a visited cell's neighbour before it is in that range and is visited, it comes first. No other cell keeps it:
// a cell begins at a fraction n, where its last interval begins. Before n the line is in the neighbour before it along that axis, which
// is visited, or n is where the line comes to the range (or where it starts). Then all cells of the range that begin at n are those of
// one or two slabs along each axis, and all but the first have a neighbour before them among these. For this to be true as computed,
// `touched` decides in one and the same way for a cell and for its neighbours, and what it needs is only that a slab's interval ends
// where the next begins, and that they come in order.
//
// As lanes.h: for any instruction set, included by backend_*.cpp, with nothing that other files could share.
#pragma once

#include <kernel/block.h>

namespace pierce::detail {

namespace {

constexpr double k_flat = 0x1p-20;    ///< an axis along which a line goes less counts as this
constexpr double k_margin = 0x1p-10;  ///< of a part; and of the level, as all that it holds is a step inside

[[gnu::always_inline]] inline double smaller(double x, double y) { return x < y ? x : y; }
[[gnu::always_inline]] inline double larger(double x, double y) { return x > y ? x : y; }
[[gnu::always_inline]] inline double smallest(const Double4& x) { return smaller(smaller(x[0], x[1]), x[2]); }
[[gnu::always_inline]] inline double largest(const Double4& x) { return larger(larger(x[0], x[1]), x[2]); }

[[gnu::always_inline]] inline Int4 all_axes(int x) { return Int4{x, x, x, x}; }

/// Where the 16 parts of a layer of a node are along two axes.
constexpr float k_part_x[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
constexpr float k_part_y[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};

/// The parts of a node, its axes mirrored. (Bits are exchanged in pairs: Warren 2002, Hacker's Delight, 7-1.)
[[gnu::always_inline]] inline std::uint64_t mirrored(std::uint64_t parts, const std::uint64_t* flips) {
    const auto exchange = [&](int shift, std::uint64_t bits) {
        const std::uint64_t different = ((parts >> shift) ^ parts) & bits;
        parts ^= different | different << shift;
    };
    exchange(3, 0x1111111111111111 & flips[0]);
    exchange(1, 0x2222222222222222 & flips[0]);
    exchange(12, 0x000f000f000f000f & flips[1]);
    exchange(4, 0x00f000f000f000f0 & flips[1]);
    exchange(48, 0x000000000000ffff & flips[2]);
    exchange(16, 0x00000000ffff0000 & flips[2]);
    return parts;
}

/// The fractions at which a line is in a cell.
struct Stay {
    double enter;
    double leave;
};

[[gnu::always_inline]] inline Stay stay_in(const Walk& walk, const Int4& cell, double end) {
    Double4 origin;
    Double4 inverse;
    __builtin_memcpy(&origin, walk.origin, sizeof origin);
    __builtin_memcpy(&inverse, walk.inverse, sizeof inverse);
    const double enter = largest((__builtin_convertvector(cell, Double4) - origin) * inverse);
    const double leave = smallest((__builtin_convertvector(cell + all_axes(1), Double4) - origin) * inverse);
    return {larger(enter, walk.first), smaller(leave, end)};
}
[[gnu::always_inline]] inline bool touched(const Stay& stay) { return stay.enter <= stay.leave; }

}  // namespace

/// The parts of a node that a line touches. It comes to part 0 along each axis at `near`, and stays there for `width`; it comes to the next
/// one `step` later. Nothing before 0 and after `end` counts.
template <class Wide>
[[gnu::always_inline]] inline std::uint64_t touched_parts(const float* near, const float* step, float wider, float end) {
    using Float = typename Wide::Float;
    constexpr unsigned rows = 16 / Wide::width;
    Float enter[rows];
    Float leave[rows];
    for (unsigned r = 0; r < rows; ++r) {
        const Float x = Wide::all(near[0]) + Wide::load(k_part_x + r * Wide::width) * Wide::all(step[0]);
        const Float y = Wide::all(near[1]) + Wide::load(k_part_y + r * Wide::width) * Wide::all(step[1]);
        enter[r] = Wide::max(Wide::max(x, y), Wide::all(0));
        leave[r] = Wide::min(Wide::min(x + Wide::all(step[0] * wider), y + Wide::all(step[1] * wider)), Wide::all(end));
    }
    std::uint64_t parts = 0;
    float z = near[2];
    for (unsigned layer = 0; layer < 4; ++layer) {
        const float beyond = z + step[2] * wider;
        for (unsigned r = 0; r < rows; ++r) {
            const unsigned apart = Wide::less(Wide::min(leave[r], Wide::all(beyond)), Wide::max(enter[r], Wide::all(z)));
            parts |= std::uint64_t{~apart & ((1U << Wide::width) - 1)} << (16 * layer + r * Wide::width);
        }
        z += step[2];
    }
    return parts;
}

/// Comes to a node, whose parts are of 2^shift cells.
template <class Wide>
[[gnu::always_inline]] inline void turn_to(const Walk& walk, const Int4& corner, int shift, std::uint64_t parts, std::uint32_t first, double end,
                                           Turn& turn) {
    const double size = 1 << shift;
    Double4 origin;
    Double4 inverse;
    __builtin_memcpy(&origin, walk.origin, sizeof origin);
    __builtin_memcpy(&inverse, walk.inverse, sizeof inverse);
    const Double4 come = (__builtin_convertvector(corner, Double4) - origin - k_margin * size) * inverse;
    const double enter = larger(largest(come), walk.first);
    const Double4 later = come - enter;
    const Double4 each = inverse * size;
    const float near[3] = {static_cast<float>(later[0]), static_cast<float>(later[1]), static_cast<float>(later[2])};
    const float step[3] = {static_cast<float>(each[0]), static_cast<float>(each[1]), static_cast<float>(each[2])};
    constexpr float wider = 1 + 2 * static_cast<float>(k_margin);
    const auto over = static_cast<float>(end - enter);
    turn.parts = parts;
    turn.first = first;
    turn.left = over < 0 ? 0 : touched_parts<Wide>(near, step, wider, over) & mirrored(parts, walk.flips);
    __builtin_memcpy(turn.corner, &corner, sizeof corner);
}

/// The cell at the lower end of a part of a node, not mirrored.
[[gnu::always_inline]] inline Int4 lowest_cell(const Walk& walk, const Int4& corner, int shift) {
    Int4 mirror;
    __builtin_memcpy(&mirror, walk.mirror, sizeof mirror);
    return (corner ^ mirror) - (mirror & all_axes((1 << shift) - 1));
}

/// What the tree holds at a cell, in the node with parts of 2^shift cells.
template <class Wide>
[[gnu::always_inline]] inline Node node_at(const PackedLevel& level, const Int4& cell, int shift) {
    if (shift >= level.root_shift) {
        const Top& top = level.tops[(shift - level.root_shift) / 2];
        Int4 strides;
        __builtin_memcpy(&strides, top.strides, sizeof strides);
        const Int4 way = (cell >> (shift + 2)) * strides;
        return {top.parts[static_cast<unsigned>(way[0] + way[1] + way[2])], 0};
    }
    const Node* node = root_of(level, cell >> 2);
    for (int down = level.root_shift - 2; down > shift; down -= 2) {
        const std::uint64_t bit = std::uint64_t{1} << ((cell[0] >> down & 3) | (cell[1] >> down & 3) << 2 | (cell[2] >> down & 3) << 4);
        if ((node->parts & bit) == 0) return {};
        node = level.nodes + (node->first + Wide::count_bits(node->parts & (bit - 1)));
    }
    return *node;
}

/// Starts the walk of the segment between two points.
template <class Wide>
[[gnu::always_inline]] inline Walking start_walk(const PackedLevel& level, const double* start, const double* finish, double limit,
                                                 bool once, Walk& walk) {
    double first = 0;
    double last = 1;
    double most = 0;
    walk.flip = 0;
    for (int k = 0; k < 3; ++k) {
        const double from = (0.5 * start[k] - level.half_low[k]) * level.scale[k] * (1.0 / k_steps);
        const double to = (0.5 * finish[k] - level.half_low[k]) * level.scale[k] * (1.0 / k_steps);
        const double d = to - from;
        most = larger(most, larger(from < 0 ? -from : from, to < 0 ? -to : to));
        const bool down = d < 0;
        const double length = larger(down ? -d : d, k_flat);
        walk.from[k] = from;
        walk.d[k] = down ? -length : length;
        walk.origin[k] = down ? -from : from;
        walk.inverse[k] = 1 / length;
        walk.flips[k] = down ? ~std::uint64_t{0} : 0;
        walk.mirror[k] = down ? -1 : 0;
        walk.flip |= down ? 3 << 2 * k : 0;
        const double low = (down ? -level.cells[k] : 0) - walk.origin[k];
        first = larger(first, (low - k_margin) * walk.inverse[k]);
        last = smaller(last, (low + level.cells[k] + k_margin) * walk.inverse[k]);
    }
    if (!(most < 0x1p34)) return Walking::never;  // one more for the cells, of which there are at most 2^20
    if (!(first <= last) || limit < first) return Walking::no;
    walk.from[3] = walk.d[3] = walk.origin[3] = walk.inverse[3] = 0;
    walk.mirror[3] = 0;
    walk.first = first;
    walk.last = last;
    walk.once = once;
    // The lowest node that holds both ends and all cells near them, so that none that the line is in is beyond it by rounding.
    Int4 cell = {0, 0, 0, 0};
    int different = 0;
    for (int k = 0; k < 3; ++k) {
        const auto place = [&](double fraction, double beyond) {
            const int at = static_cast<int>(walk.from[k] + fraction * walk.d[k] + beyond);
            return at < 0 ? 0 : at >= level.cells[k] ? level.cells[k] - 1 : at;
        };
        const double back = walk.d[k] < 0 ? k_margin : -k_margin;
        cell[k] = place(first, back);
        different |= cell[k] ^ place(last, -back);
    }
    walk.shift = different < 4 ? 0 : (31 - __builtin_clz(static_cast<unsigned>(different))) & ~1;
    const Node node = node_at<Wide>(level, cell, walk.shift);
    const Int4 whole = all_axes((4 << walk.shift) - 1);
    cell &= ~whole;
    Int4 mirror;
    __builtin_memcpy(&mirror, walk.mirror, sizeof mirror);
    const Int4 corner = (cell ^ mirror) - (mirror & whole);
    turn_to<Wide>(walk, corner, walk.shift, node.parts, node.first, smaller(last, limit), walk.turns[0]);
    walk.depth = 0;
    return Walking::along;
}

/// What is near the line in a cell, and a step more. 2^10 makes the truncation a rounding down.
template <class Wide>
[[gnu::always_inline]] inline std::uint64_t near_line(const Walk& walk, const Int4& cell, const Stay& stay) {
    Double4 from;
    Double4 d;
    __builtin_memcpy(&from, walk.from, sizeof from);
    __builtin_memcpy(&d, walk.d, sizeof d);
    from -= __builtin_convertvector(cell, Double4);
    Double4 low = (from + stay.enter * d) * double{k_steps};
    Double4 high = (from + stay.leave * d) * double{k_steps};
    const Double4 other = low;
    Wide::lower(low, high);
    Wide::raise(high, other);
    // Beyond the cell nothing is asked for, whatever the numbers.
    const Double4 least = {-1, -1, -1, -1};
    const Double4 most = {k_steps, k_steps, k_steps, k_steps};
    Wide::raise(low, least);
    Wide::lower(low, most);
    Wide::raise(high, least);
    Wide::lower(high, most);
    low += 1023;
    high += 1025;
    const Int4 before = {1024, 1024, 1024, 1024};
    const Int4 unused = {0, 0, 0, 127};
    return Wide::pack((__builtin_convertvector(high, Int4) - before) | unused, (before - __builtin_convertvector(low, Int4)) | unused);
}

/// What the neighbours before a cell have seen of its boxes: `Cull::seen`.
[[gnu::always_inline]] inline std::uint64_t seen_before(const Walk& walk, const Int4& cell) {
    std::uint64_t seen = 0;
    for (int k = 0; k < 3; ++k) {
        Int4 before = cell;
        before[k] -= 1;
        // As a box's flags: bit k of byte 3 if the cell before lists it, of byte 7 if the one after does. It begins no later than this one, so it
        // is not beyond any limit.
        if (touched(stay_in(walk, before, walk.last))) seen |= std::uint64_t{1} << ((walk.mirror[k] == 0 ? 24 : 56) + k);
    }
    return seen;
}

/// The next cells on the line that hold something, at most `room`; fewer only when there are no more, or when the line comes to them only
/// beyond `limit`. With `once`, the stops leave every box that the cells list exactly once. Without, those near the line in each cell.
template <class Wide>
[[gnu::always_inline]] inline unsigned walk_on(const PackedLevel& level, Walk& walk, double limit, Stop* stops, unsigned room) {
    unsigned found = 0;
    const double end = smaller(walk.last, limit);
    int depth = walk.depth;
    while (depth >= 0) {
        Turn& turn = walk.turns[depth];
        const int shift = walk.shift - 2 * depth;
        Int4 corner;
        __builtin_memcpy(&corner, turn.corner, sizeof corner);
        std::uint64_t left = turn.left;
        if (left == 0) {
            --depth;
            continue;
        }
        const auto next = [&](std::uint64_t& bit) {
            const int place = __builtin_ctzll(left);
            left &= left - 1;
            bit = std::uint64_t{1} << (place ^ walk.flip);
            Int4 part;
            __builtin_memcpy(&part, k_places.cell[place], sizeof part);
            return corner + (part << shift);
        };
        std::uint64_t bit;
        if (shift > 0) {
            const Int4 part = next(bit);
            turn.left = left;
            if (shift < level.root_shift) {
                const Node& node = level.nodes[turn.first + Wide::count_bits(turn.parts & (bit - 1))];
                turn_to<Wide>(walk, part, shift - 2, node.parts, node.first, end, walk.turns[++depth]);
            } else {
                const Node node = node_at<Wide>(level, lowest_cell(walk, part, shift), shift - 2);
                turn_to<Wide>(walk, part, shift - 2, node.parts, node.first, end, walk.turns[++depth]);
            }
            continue;
        }
        while (left != 0 && found < room) {
            const Int4 cell = next(bit);
            const Stay stay = stay_in(walk, cell, end);
            if (!touched(stay)) continue;
            Stop& stop = stops[found++];
            stop.number = turn.first + Wide::count_bits(turn.parts & (bit - 1));
            stop.cull = walk.once ? Cull{0x7f7f7f7f7f7f7f7f, seen_before(walk, cell)}
                                  : Cull{near_line<Wide>(walk, lowest_cell(walk, cell, 0), stay), 0};
            stop.fraction = stay.enter;
        }
        turn.left = left;
        if (found == room) break;
    }
    walk.depth = depth;
    return found;
}

}  // namespace pierce::detail
