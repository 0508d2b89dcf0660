// One uniform grid: cells under a tree of nodes, each of 4 x 4 x 4 parts, and in each cell the boxes that it shares with triangles.
//
//   node (16 bytes)  which of its 64 parts hold anything, and the number of the first that does. The roots are dense; where a mesh fills
//                    space evenly they are the lowest nodes as well, the bricks of cells, small enough for the second-level cache: most
//                    misses end there. Where it does not (a teapot in a stadium), there are more layers under them.
//   starts           for each cell that holds something, its place in the two lists
//   boxes, ids       8 + 4 bytes for each triangle in each cell (packed_box.h)
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <grid/raster.h>

namespace pierce::detail {

struct Node {
    std::uint64_t parts = 0;  ///< bit x + 4 y + 16 z
    std::uint32_t first = 0;  ///< of a brick: how many non-empty cells come before its own; else the place of its first child
    std::uint32_t empty = 0;  ///< of a root without parts: roots less than this away, in the maximum norm, have none either
};

/// What a cell holds: places in the lists.
struct Range {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
};

using Cell = std::array<int, 3>;

class Level {
  public:
    [[nodiscard]] const Raster& raster() const { return raster_; }
    [[nodiscard]] const PackedBox* boxes(std::uint32_t place) const { return boxes_.get() + place; }
    [[nodiscard]] const std::uint32_t* ids(std::uint32_t place) const { return ids_.get() + place; }

    /// Where a cell is in the tree: its brick, if that has any cells that hold something, else a cube around it that has none.
    struct Place {
        const Node* brick;  ///< or null
        int shift;          ///< the cube: of 2^shift cells along each axis, at a multiple of that,
        int reach;          ///< and this many cells more on all sides
    };
    [[nodiscard]] Place find(const Cell& cell) const {
        const Node* node = &nodes_[static_cast<std::size_t>(cell[0] >> root_shift_) * strides_[0] +
                                   static_cast<std::size_t>(cell[1] >> root_shift_) * strides_[1] +
                                   static_cast<std::size_t>(cell[2] >> root_shift_) * strides_[2]];
        if (node->parts == 0) return {nullptr, root_shift_, static_cast<int>(node->empty - 1) << root_shift_};
        for (int shift = root_shift_ - 2; shift > 0; shift -= 2) {
            const std::uint64_t bit = bit_of({cell[0] >> shift, cell[1] >> shift, cell[2] >> shift});
            if ((node->parts & bit) == 0) return {nullptr, shift, 0};
            node = &nodes_[number(*node, bit)];
        }
        return {node, 0, 0};
    }
    [[nodiscard]] static std::uint64_t bit_of(const Cell& cell) {
        return std::uint64_t{1} << ((cell[0] & 3) | (cell[1] & 3) << 2 | (cell[2] & 3) << 4);
    }
    /// Of a part that holds something: of a brick's, the number of the cell.
    [[nodiscard]] static std::size_t number(const Node& node, std::uint64_t bit) {
        return node.first + count_bits(node.parts & (bit - 1));
    }
    // Without an instruction for it, which not every x86-64 machine has, std::popcount is a call (Warren 2002, Hacker's Delight, 5-1).
    static std::size_t count_bits(std::uint64_t x) {
        x -= x >> 1 & 0x5555555555555555;
        x = (x & 0x3333333333333333) + (x >> 2 & 0x3333333333333333);
        x = (x + (x >> 4)) & 0x0f0f0f0f0f0f0f0f;
        return static_cast<std::size_t>(x * 0x0101010101010101 >> 56);
    }

    [[nodiscard]] const std::uint32_t* start(std::size_t number) const { return &starts_[number]; }
    [[nodiscard]] Range range(std::size_t number) const { return {starts_[number], starts_[number + 1]}; }

    [[nodiscard]] std::size_t reference_count() const { return references_; }
    [[nodiscard]] std::size_t bytes() const {
        return nodes_.capacity() * sizeof(Node) + starts_.capacity() * sizeof(std::uint32_t) +
               references_ * (sizeof(PackedBox) + sizeof(std::uint32_t)) + k_beyond * sizeof(PackedBox);
    }

    /// The kernels read on beyond the last box.
    static constexpr std::size_t k_beyond = 8;

  private:
    friend class LevelBuilder;

    Raster raster_;
    std::array<std::size_t, 3> strides_ = {0, 0, 0};
    std::vector<Node> nodes_;  ///< the roots, then layer by layer, last the bricks
    int root_shift_ = 2;       ///< a root is of 2^root_shift cells along each axis
    std::vector<std::uint32_t> starts_;
    std::unique_ptr<PackedBox[]> boxes_;
    std::unique_ptr<std::uint32_t[]> ids_;
    std::size_t references_ = 0;
};

}  // namespace pierce::detail
