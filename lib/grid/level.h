// One uniform grid: cells in bricks of 4 x 4 x 4, and in each cell the boxes that it shares with triangles.
//
//   brick (16 bytes)  which of its 64 cells hold anything, and the number of the first that does; for an empty one, how far the
//                     nearest is that is not. Dense, small enough for the second-level cache: most misses end here.
//   starts            for each cell that holds something, its place in the two lists
//   boxes, ids        8 + 4 bytes for each triangle in each cell (packed_box.h)
#pragma once

#include <bit>
#include <cstdint>
#include <memory>
#include <vector>

#include <grid/raster.h>

namespace pierce::detail {

struct Brick {
    std::uint64_t cells = 0;  ///< bit x + 4 y + 16 z
    std::uint32_t first = 0;  ///< of the non-empty cells before this brick, how many there are
    std::uint32_t empty = 0;  ///< bricks less than this away, in the maximum norm, are empty; 0 if this one is not
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
    [[nodiscard]] const PackedBox* boxes(const Range& range) const { return boxes_.get() + range.begin; }
    [[nodiscard]] const std::uint32_t* ids(const Range& range) const { return ids_.get() + range.begin; }

    [[nodiscard]] const Brick& brick_of(const Cell& cell) const {
        return bricks_[static_cast<std::size_t>(cell[0] >> 2) * strides_[0] + static_cast<std::size_t>(cell[1] >> 2) * strides_[1] +
                       static_cast<std::size_t>(cell[2] >> 2) * strides_[2]];
    }
    [[nodiscard]] static std::uint64_t bit_of(const Cell& cell) {
        return std::uint64_t{1} << ((cell[0] & 3) | (cell[1] & 3) << 2 | (cell[2] & 3) << 4);
    }
    /// Of a cell that holds something.
    [[nodiscard]] std::size_t number(const Brick& brick, std::uint64_t bit) const {
        return brick.first + static_cast<std::size_t>(std::popcount(brick.cells & (bit - 1)));
    }
    [[nodiscard]] const std::uint32_t* start(std::size_t number) const { return &starts_[number]; }
    [[nodiscard]] Range range(std::size_t number) const { return {starts_[number], starts_[number + 1]}; }

    [[nodiscard]] std::size_t reference_count() const { return references_; }
    [[nodiscard]] std::size_t bytes() const {
        return bricks_.capacity() * sizeof(Brick) + starts_.capacity() * sizeof(std::uint32_t) +
               references_ * (sizeof(PackedBox) + sizeof(std::uint32_t)) + k_beyond * sizeof(PackedBox);
    }

    /// The kernels read on beyond the last box.
    static constexpr std::size_t k_beyond = 8;

  private:
    friend class LevelBuilder;

    Raster raster_;
    std::array<std::size_t, 3> strides_ = {0, 0, 0};
    std::vector<Brick> bricks_;
    std::vector<std::uint32_t> starts_;
    std::unique_ptr<PackedBox[]> boxes_;
    std::unique_ptr<std::uint32_t[]> ids_;
    std::size_t references_ = 0;
};

}  // namespace pierce::detail
