// How one level is filled. Even ones by a counting sort: by slabs of bricks, then by cells within each slab, so that writes stay close
// together. Uneven ones, whose cells are too many to be counted one by one, by sorting what is listed.
#pragma once

#include <span>

#include <grid/level.h>
#include <pierce/executor.h>
#include <raw_array.h>

namespace pierce::detail {

class LevelBuilder {
  public:
    /// The box of triangle `first + i` is `boxes[i]`.
    LevelBuilder(const Raster& raster, std::uint32_t first, std::span<const Steps> boxes, const Executor& executor);

    /// Entries of all cell lists together: known before anything is allocated.
    [[nodiscard]] std::size_t reference_count() const { return references_; }
    [[nodiscard]] Level build();

  private:
    struct Cells {
        Ints first;
        Ints last;
    };

    [[nodiscard]] Cells cells_of(const Steps& box) const {
        const Ints zero = {0, 0, 0, 0};
        const Ints margin = {k_margin, k_margin, k_margin, 0};
        const Ints low = box.low - margin;
        const Ints high = (box.high + margin) >> k_step_bits;
        return {(low > zero ? low : zero) >> k_step_bits, high < last_cell_ ? high : last_cell_};
    }
    [[nodiscard]] int slab_of(int cell) const { return static_cast<int>(slab_of_root_[static_cast<std::size_t>(cell >> root_shift_)]); }
    void count_slabs();
    void sort_by_slab();
    void place_roots();
    template <class Visit>
    void each_box(Visit&& visit) const;
    void build_dense(Level& level) const;
    void build_sparse(Level& level) const;
    [[nodiscard]] RawArray<std::uint32_t> fill_slab(Level& level, std::size_t slab) const;
    void build_tops(Level& level) const;
    template <class Visit>
    void each_cell(const Cells& cells, Visit&& visit) const;

    const Raster raster_;
    const Ints last_cell_;
    const std::uint32_t first_;
    const std::span<const Steps> boxes_;
    const Executor& executor_;
    int root_shift_ = 2;
    std::array<int, 3> roots_{};
    std::array<std::size_t, 3> strides_{};
    std::size_t slow_ = 2;     ///< the axis with the most roots: slabs are cut across it
    int layers_ = 1;           ///< of bricks to a slab
    std::size_t slabs_ = 1;
    std::vector<std::uint32_t> slab_of_root_;
    std::size_t references_ = 0;
    std::vector<std::uint32_t> slab_starts_;       ///< in `sorted_`
    std::vector<std::uint32_t> chunk_starts_;      ///< the same for each chunk of boxes and slab in it
    std::vector<std::uint32_t> reference_starts_;  ///< in the lists of the level
    RawArray<std::uint32_t> sorted_;               ///< places in `boxes_`, by slab; one that lies in two is in both
};

}  // namespace pierce::detail
