// How one level is filled: a counting sort by slabs of bricks, then by cells within each slab, so that writes stay close together.
#pragma once

#include <span>

#include <grid/level.h>
#include <pierce/executor.h>

namespace pierce::detail {

class LevelBuilder {
  public:
    /// The box of triangle `first + i` is `boxes[i]`.
    LevelBuilder(const Raster& raster, std::uint32_t first, std::span<const Steps> boxes);

    /// Entries of all cell lists together: known before anything is allocated.
    [[nodiscard]] std::size_t reference_count() const { return references_; }
    [[nodiscard]] Level build(const Executor& executor);

    /// The directory's size in bytes for such a raster.
    [[nodiscard]] static double directory_bytes(const Raster& raster);

  private:
    struct Cells {
        std::array<int, 3> first;
        std::array<int, 3> last;
    };

    [[nodiscard]] Cells cells_of(const Steps& box) const;
    [[nodiscard]] int slab_of(int cell) const { return (cell >> 2) / layers_; }
    void sort_by_slab();
    void fill_slab(Level& level, std::size_t slab, std::vector<std::uint32_t>& starts) const;
    static void measure_empty_space(Level& level, const std::array<int, 3>& bricks);

    const Raster raster_;
    const std::uint32_t first_;
    const std::span<const Steps> boxes_;
    std::array<int, 3> bricks_{};
    std::array<std::size_t, 3> strides_{};
    std::size_t slow_ = 2;     ///< the axis with the most bricks: slabs are cut across it
    int layers_ = 1;           ///< of bricks to a slab
    std::size_t slabs_ = 1;
    std::size_t references_ = 0;
    std::vector<std::uint32_t> slab_starts_;       ///< in `sorted_`
    std::vector<std::uint32_t> reference_starts_;  ///< in the lists of the level
    std::vector<std::uint32_t> sorted_;            ///< places in `boxes_`, by slab; one that lies in two is in both
};

}  // namespace pierce::detail
