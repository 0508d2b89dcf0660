// The cells of a short segment, found without a branch for each axis: every cell that holds something and that the segment's box shares
// a step with. Nothing is computed along the way, so nothing can be missed (grid/raster.h).
//
// As lanes.h: for any instruction set, included by backend_*.cpp, with nothing that other files could share.
#pragma once

#include <kernel/lanes.h>

namespace pierce::detail {

namespace {

using Double4 [[gnu::vector_size(32)]] = double;
using Int4 [[gnu::vector_size(16)]] = int;

// For machines without an instruction for it (Warren 2002, Hacker's Delight, 5-1).
[[gnu::always_inline]] inline unsigned count_bits_by_halves(std::uint64_t x) {
    x -= x >> 1 & 0x5555555555555555;
    x = (x & 0x3333333333333333) + (x >> 2 & 0x3333333333333333);
    x = (x + (x >> 4)) & 0x0f0f0f0f0f0f0f0f;
    return static_cast<unsigned>(x * 0x0101010101010101 >> 56);
}

/// Which cells of a brick have a place along an axis from one to another, `from + 4 * to`; and where a cell is in its brick.
struct Places {
    constexpr Places() {
        for (int from = 0; from < 4; ++from)
            for (int to = from; to < 4; ++to)
                for (int i = 0; i < 64; ++i) {
                    const std::uint64_t bit = std::uint64_t{1} << i;
                    const auto within = [&](int place) { return place >= from && place <= to; };
                    if (within(i & 3)) x[from + 4 * to] |= bit;
                    if (within(i >> 2 & 3)) y[from + 4 * to] |= bit;
                    if (within(i >> 4)) z[from + 4 * to] |= bit;
                }
        for (int i = 0; i < 64; ++i) {
            cell[i][0] = i & 3;
            cell[i][1] = i >> 2 & 3;
            cell[i][2] = i >> 4;
        }
    }
    std::uint64_t x[16] = {};
    std::uint64_t y[16] = {};
    std::uint64_t z[16] = {};
    int cell[64][4] = {};
};
constexpr Places k_places;

/// A segment's box in a level, in steps.
struct Reach {
    Int4 first_step;
    Int4 last_step;
};

/// Where a segment has cells to look at. Most short ones that are not near anything end here.
struct First {
    const Node* brick;    ///< the only one, or null
    std::uint64_t cells;  ///< of it
};

}  // namespace

/// The root above a brick at a place, given in bricks.
[[gnu::always_inline]] inline const Node* root_of(const PackedLevel& level, const Int4& brick) {
    Int4 strides;
    __builtin_memcpy(&strides, level.strides, sizeof strides);
    const Int4 way = (brick >> (level.root_shift - 2)) * strides;
    return level.nodes + static_cast<unsigned>(way[0] + way[1] + way[2]);
}

/// The brick itself; null where there is none. Where roots are bricks, it may hold nothing.
template <class Wide>
[[gnu::always_inline]] inline const Node* brick_under(const PackedLevel& level, const Node* node, const Int4& brick) {
    const int x = brick[0];
    const int y = brick[1];
    const int z = brick[2];
    for (int down = level.root_shift - 4; down >= 0; down -= 2) {
        const std::uint64_t bit = std::uint64_t{1} << ((x >> down & 3) | (y >> down & 3) << 2 | (z >> down & 3) << 4);
        if ((node->parts & bit) == 0) return nullptr;
        node = level.nodes + (node->first + Wide::count_bits(node->parts & (bit - 1)));
    }
    return node;
}

template <class Wide>
[[gnu::always_inline]] inline const Node* find_brick(const PackedLevel& level, const Int4& brick) {
    return brick_under<Wide>(level, root_of(level, brick), brick);
}

/// The cells of a brick that hold something and share a step with a segment's box.
[[gnu::always_inline]] inline std::uint64_t cells_in_brick(const Node& brick, const Int4& corner, const Reach& reach) {
    const Int4 zero = {0, 0, 0, 0};
    const Int4 three = {3, 3, 3, 3};
    Int4 lowest = (reach.first_step >> k_step_bits) - corner;
    Int4 highest = (reach.last_step >> k_step_bits) - corner;
    lowest = lowest > zero ? lowest : zero;
    highest = highest < three ? highest : three;
    const Int4 places = lowest + (highest << 2);
    return brick.parts & k_places.x[places[0]] & k_places.y[places[1]] & k_places.z[places[2]];
}

/// The stops in some cells of a brick, behind those that are there already; returns how many there are then, -1 if that is more than
/// `k_most_block`.
template <class Wide>
[[gnu::always_inline]] inline int stops_in_brick(const Node& brick, const Int4& corner, std::uint64_t cells, const Reach& reach, Stop* stops,
                                                 int found) {
    const Int4 first = reach.first_step >> k_step_bits;
    if (found + static_cast<int>(Wide::count_bits(cells)) > k_most_block) return -1;
    for (; cells != 0; cells &= cells - 1) {
        const int place = __builtin_ctzll(cells);
        Int4 cell;
        __builtin_memcpy(&cell, k_places.cell[place], sizeof cell);
        cell += corner;
        const Int4 corner_step = cell << k_step_bits;
        // Bytes as in a packed box, cut to the range of one by saturation: beyond it they refuse nothing.
        const Int4 unused = {0, 0, 0, 127};
        const Int4 upper = (reach.last_step - corner_step) | unused;
        const Int4 lower = (corner_step - reach.first_step) | unused;
        // Boxes that the cell before this one lists too, along an axis where that is one of the query's as well, are left to that
        // one: it leaves them whenever this one would, as the query's box then reaches to its end.
        const std::uint64_t seen = Wide::negative(first - cell);
        const std::uint64_t before_it = brick.parts & ((std::uint64_t{1} << place) - 1);
        Stop& stop = stops[found++];
        stop.number = brick.first + Wide::count_bits(before_it);
        stop.cull = {Wide::pack(upper, lower), seen << 24};
    }
    return found;
}

/// Three numbers: one by one, as they were mostly written that way a moment ago, and a load of all of them would wait for it.
template <class Scalar>
[[gnu::always_inline]] inline void read(const Scalar* x, Double4& point) {
    using Numbers [[gnu::vector_size(4 * sizeof(Scalar))]] = Scalar;
    point = __builtin_convertvector((Numbers{x[0], x[1], x[2], 0}), Double4);
}

/// The steps of the segment between two points, which become places in steps, in a level; false if it is outside.
template <class Wide>
[[gnu::always_inline]] inline bool reach_of(const PackedLevel& level, Double4& from, Double4& to, Reach& reach) {
    Double4 low;
    Double4 scale;
    Double4 most;
    __builtin_memcpy(&low, level.half_low, sizeof low);
    __builtin_memcpy(&scale, level.scale, sizeof scale);
    __builtin_memcpy(&most, level.most, sizeof most);
    // Raster::place of halves, operation for operation, so that it is the same function for boxes and for queries.
    from *= 0.5;
    to *= 0.5;
    Wide::settle(from);
    Wide::settle(to);
    from = (from - low) * scale;
    to = (to - low) * scale;
    // What lies outside of the cells counts as on their border; before that as -1 or `most`, for the one look that says so.
    const Double4 before = {-1, -1, -1, -1};
    Double4 least = from;
    Wide::lower(least, to);
    Wide::raise(least, before);
    Wide::lower(least, most);
    Double4 greatest = from;
    Wide::raise(greatest, to);
    Wide::raise(greatest, before);
    Wide::lower(greatest, most);
    const Int4 one = {1, 1, 1, 1};
    const Int4 zero = {0, 0, 0, 0};
    const Int4 end = __builtin_convertvector(most, Int4) - one;
    reach.first_step = __builtin_convertvector(least, Int4);
    reach.last_step = __builtin_convertvector(greatest, Int4);
    if (Wide::negative(reach.last_step | (end - reach.first_step)) != 0) return false;
    reach.first_step = reach.first_step > zero ? reach.first_step : zero;
    reach.last_step = reach.last_step < end ? reach.last_step : end;
    return true;
}

/// False if there are certainly none.
template <class Wide>
[[gnu::always_inline]] inline bool first_look(const PackedLevel& level, const Reach& reach, First& first) {
    const Int4 first_brick = reach.first_step >> (k_step_bits + 2);
    const Int4 last_brick = reach.last_step >> (k_step_bits + 2);
    first.brick = nullptr;
    if (Wide::negative(first_brick - last_brick) != 0) return true;
    first.brick = find_brick<Wide>(level, first_brick);
    if (first.brick == nullptr) return false;
    first.cells = cells_in_brick(*first.brick, first_brick << 2, reach);
    return first.cells != 0;
}

/// How many cells hold something, and which boxes are to be left in them, each by one cell only. -1: more than `k_most_block`, or too far
/// apart to be looked at.
template <class Wide>
[[gnu::always_inline]] inline int stops_of(const PackedLevel& level, const Reach& reach, const First& look, Stop* stops) {
    const Int4 first_brick = reach.first_step >> (k_step_bits + 2);
    if (look.brick != nullptr) return stops_in_brick<Wide>(*look.brick, first_brick << 2, look.cells, reach, stops, 0);
    const Int4 one = {1, 1, 1, 1};
    const Int4 zero = {0, 0, 0, 0};
    const Int4 more = (reach.last_step >> (k_step_bits + 2)) - first_brick;
    if (Wide::negative(one - more) != 0) return -1;
    // Bit k of a brick: the second one along axis k. Of two bricks or four, and not of eight with branches for those there are not.
    const unsigned most_bits = Wide::negative(zero - more);
    int found = 0;
    for (unsigned bits = 0;; bits = (bits - most_bits) & most_bits) {
        const Int4 brick_at = first_brick + Int4{static_cast<int>(bits & 1), static_cast<int>(bits >> 1 & 1), static_cast<int>(bits >> 2), 0};
        const Node* brick = find_brick<Wide>(level, brick_at);
        if (brick != nullptr) {
            const Int4 corner = brick_at << 2;
            found = stops_in_brick<Wide>(*brick, corner, cells_in_brick(*brick, corner, reach), reach, stops, found);
            if (found < 0) return -1;
        }
        if (bits == most_bits) break;
    }
    return found;
}

// Not inlined: a look that ends before it then has no room to make for it.
template <class Wide>
[[gnu::noinline]] int look_closer(const PackedLevel& level, const Reach& reach, const First& first, std::uint32_t* out, unsigned room,
                                  unsigned* cells) {
    Stop stops[k_most_block];
    const int found = stops_of<Wide>(level, reach, first, stops);
    if (found <= 0) return found;
    // First what all of them read: the branches of the culling would let the memory wait.
    std::uint32_t begin[k_most_block];
    std::uint32_t count[k_most_block];
    for (int i = 0; i < found; ++i) {
        begin[i] = level.starts[stops[i].number];
        count[i] = level.starts[stops[i].number + 1] - begin[i];
        const auto* boxes = reinterpret_cast<const char*>(level.boxes + begin[i]);
        __builtin_prefetch(level.ids + begin[i]);
        for (std::uint32_t at = 0; at < 3; ++at) __builtin_prefetch(boxes + 64 * at);
    }
    unsigned left = 0;
    for (int i = 0; i < found; ++i) {
        if (count[i] > room - left) return -1;
        left += cull<Wide>(level.boxes + begin[i], level.ids + begin[i], count[i], stops[i].cull.above, stops[i].cull.seen, out + left);
    }
    *cells = static_cast<unsigned>(found);
    return static_cast<int>(left);
}

/// The ids that the cells of the segment between two points leave, and how many cells they are. -1: too many cells, or what they
/// list is more than `room`.
template <class Wide>
[[gnu::always_inline]] inline int look(const PackedLevel& level, const double* from, const double* to, std::uint32_t* out,
                                       unsigned room, unsigned* cells) {
    Double4 start;
    Double4 finish;
    read(from, start);
    read(to, finish);
    Reach reach;
    First first;
    *cells = 0;
    if (!reach_of<Wide>(level, start, finish, reach) || !first_look<Wide>(level, reach, first)) return 0;
    return look_closer<Wide>(level, reach, first, out, room, cells);
}

}  // namespace pierce::detail
