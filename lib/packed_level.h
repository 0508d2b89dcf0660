// What the grid writes and the wide kernels read: one level of cells as plain memory. No functions, as the kernels' files may share none.
#pragma once

#include <cstdint>

namespace pierce::detail {

/// Steps to a cell, along each axis: what a packed box is measured in, counted from the cell's lower corner.
constexpr int k_step_bits = 7;
constexpr int k_steps = 1 << k_step_bits;

/// The part of a box in one cell. Bytes 0-2 hold its lower corner, bytes 4-6 its upper one, negated; byte 3 has bit k set where the
/// cell before this one along axis k lists the box too, byte 7 where the one after it does. Each is a signed byte. So for a box and
/// a `Cull`, all that makes them disjoint is that a byte of the one is larger than that of the other.
using PackedBox = std::uint64_t;

/// What packed boxes are compared with: a box is of no use if one of its bytes, as signed numbers, is larger than that of `above`, or
/// if it has a bit of `seen`.
struct Cull {
    std::uint64_t above;
    std::uint64_t seen;
};

/// Four by four by four parts, and which of them hold anything.
struct Node {
    std::uint64_t parts = 0;  ///< bit x + 4 y + 16 z
    std::uint32_t first = 0;  ///< of a brick: how many non-empty cells come before its own; else the place of its first child
};

/// A layer above the roots: which of 4 x 4 x 4 of the layer below hold anything, for all of its places.
struct Top {
    const std::uint64_t* parts = nullptr;
    std::uint32_t strides[4] = {0, 0, 0, 0};
};

/// Layers of the tree, of four by four by four, that somewhat more than 2^20 cells along an axis need (grid/raster.h).
constexpr int k_most_layers = 11;

/// See grid/level.h. The arrays have a fourth entry, so that four lanes can be read: it is 0, and 1 for `most`.
struct PackedLevel {
    double half_low[4] = {0, 0, 0, 0};
    double scale[4] = {0, 0, 0, 0};    ///< steps for each half unit, see grid/raster.h
    double most[4] = {0, 0, 0, 1};     ///< steps along each axis
    std::uint32_t strides[4] = {0, 0, 0, 0};
    const Node* nodes = nullptr;       ///< the roots, then layer by layer, last the bricks
    const std::uint32_t* starts = nullptr;
    const PackedBox* boxes = nullptr;
    const std::uint32_t* ids = nullptr;
    const Top* tops = nullptr;         ///< from the one above the roots to one of a single place
    int cells[4] = {1, 1, 1, 1};
    int root_shift = 2;                ///< a root is of 2^root_shift cells along each axis
    int top_count = 0;
};

/// Where a query has come to: a cell that holds something, and which boxes it is to leave there.
struct Stop {
    std::uint32_t number;  ///< of the cell, see Level::range
    std::uint32_t query;   ///< of many: whose it is
    Cull cull;
    double fraction;       ///< of a walk: at which it enters the cell
};

/// What is to be culled of a cell.
struct Boxes {
    const PackedBox* boxes;
    const std::uint32_t* ids;
    std::uint32_t count;
    std::uint32_t query;  ///< of many: whose it is
    Cull cull;
};

/// A node of the tree that a walk is in, and which of its parts it has yet to see. Mirrored where the line goes down an axis, so that it
/// always goes up.
struct Turn {
    std::uint64_t parts;   ///< not mirrored
    std::uint64_t left;
    std::uint32_t first;   ///< as in Node
    int corner[4];         ///< its lowest, in cells
};

/// A segment on its way through a level (kernel/walk.h), all in cells. The arrays have a fourth entry for the lanes.
struct Walk {
    double from[4];         ///< the place at fraction s is from + s d
    double d[4];
    double origin[4];       ///< from, mirrored
    double inverse[4];      ///< fractions for a cell along each axis
    double first;           ///< fractions of the line that are in the level
    double last;
    std::uint64_t flips[3]; ///< for each axis all bits if it is mirrored
    int mirror[4];          ///< -1 if it is mirrored, else 0
    int flip;               ///< what a mirrored part's place differs in
    int shift;              ///< a part of the first node is of 2^shift cells along each axis
    int depth;              ///< of the node that the walk is in, below the first; -1 at the end
    bool once;
    Turn turns[k_most_layers];
};

/// `never`: the segment is too long to be followed.
enum class Walking : std::uint8_t { no, along, never };

/// A short segment's cells are asked for together, if they are not more than this. Measured: tests/bench/run.
constexpr int k_most_block = 8;

/// Segments that are looked at together: enough to cover the latency of main memory. Measured: tests/bench/run.
constexpr unsigned k_group = 16;

/// What a look at one of many segments says: that it has cells or not; that it must be asked singly, having too many; that it has no
/// meaning, as a coordinate is not finite.
enum class Look : std::uint8_t { seen, alone, invalid };

}  // namespace pierce::detail
