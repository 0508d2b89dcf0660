// One uniform grid: cells under a tree of nodes, each of 4 x 4 x 4 parts, and in each cell the boxes that it shares with triangles.
//
//   node (16 bytes)  which of its 64 parts hold anything, and the number of the first that does. The roots are dense; where a mesh fills
//                    space evenly they are the lowest nodes as well, the bricks of cells, small enough for the second-level cache: most
//                    misses end there. Where it does not (a teapot in a stadium), there are more layers under them.
//   tops             layers above the roots, up to one node, dense and without numbers: long segments come down from there and meet no
//                    empty space
//   starts           for each cell that holds something, its place in the two lists
//   boxes, ids       8 + 4 bytes for each triangle in each cell (packed_box.h)
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <grid/raster.h>
#include <raw_array.h>

namespace pierce::detail {

/// What a cell holds: places in the lists.
struct Range {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
};

using Cell = std::array<int, 3>;

class Level {
  public:
    [[nodiscard]] const Raster& raster() const { return raster_; }
    [[nodiscard]] const PackedLevel& packed() const { return packed_; }
    /// The ids of a level follow one another, from this one on.
    [[nodiscard]] std::uint32_t first_id() const { return first_id_; }
    [[nodiscard]] const PackedBox* boxes(std::uint32_t place) const { return packed_.boxes + place; }
    [[nodiscard]] const std::uint32_t* ids(std::uint32_t place) const { return packed_.ids + place; }

    /// What a cell lists.
    [[nodiscard]] Range range(const Cell& cell) const {
        const int top = packed_.root_shift;
        const Node* node = packed_.nodes + (static_cast<std::size_t>(cell[0] >> top) * packed_.strides[0] +
                                            static_cast<std::size_t>(cell[1] >> top) * packed_.strides[1] +
                                            static_cast<std::size_t>(cell[2] >> top) * packed_.strides[2]);
        for (int shift = top - 2;; shift -= 2) {
            const std::uint64_t bit = bit_of({cell[0] >> shift, cell[1] >> shift, cell[2] >> shift});
            if ((node->parts & bit) == 0) return {};
            const std::uint32_t part = number(*node, bit);
            if (shift == 0) return range(part);
            node = packed_.nodes + part;
        }
    }
    [[nodiscard]] static std::uint64_t bit_of(const Cell& cell) {
        return std::uint64_t{1} << ((cell[0] & 3) | (cell[1] & 3) << 2 | (cell[2] & 3) << 4);
    }
    /// Of a part that holds something: of a brick's, the number of the cell.
    [[nodiscard]] static std::uint32_t number(const Node& node, std::uint64_t bit) {
        return node.first + count_bits(node.parts & (bit - 1));
    }
    // Without an instruction for it, which not every x86-64 machine has, std::popcount is a call (Warren 2002, Hacker's Delight, 5-1).
    static std::uint32_t count_bits(std::uint64_t x) {
        x -= x >> 1 & 0x5555555555555555;
        x = (x & 0x3333333333333333) + (x >> 2 & 0x3333333333333333);
        x = (x + (x >> 4)) & 0x0f0f0f0f0f0f0f0f;
        return static_cast<std::uint32_t>(x * 0x0101010101010101 >> 56);
    }

    [[nodiscard]] const std::uint32_t* start(std::uint32_t number) const { return packed_.starts + number; }
    [[nodiscard]] Range range(std::uint32_t number) const { return {packed_.starts[number], packed_.starts[number + 1]}; }

    [[nodiscard]] std::size_t reference_count() const { return references_; }
    [[nodiscard]] std::size_t bytes() const {
        return nodes_.capacity() * sizeof(Node) + starts_.capacity() * sizeof(std::uint32_t) +
               top_parts_.capacity() * sizeof(std::uint64_t) + tops_.capacity() * sizeof(Top) +
               (references_ + k_beyond) * (sizeof(PackedBox) + sizeof(std::uint32_t));
    }

    /// The kernels read on beyond the last box and id.
    static constexpr std::size_t k_beyond = 8;

  private:
    friend class LevelBuilder;

    Raster raster_;
    PackedLevel packed_;  ///< points into the rest
    std::vector<Node> nodes_;
    std::vector<std::uint64_t> top_parts_;
    std::vector<Top> tops_;
    std::vector<std::uint32_t> starts_;
    RawArray<PackedBox> boxes_;
    RawArray<std::uint32_t> ids_;
    std::size_t references_ = 0;
    std::uint32_t first_id_ = 0;
};

}  // namespace pierce::detail
