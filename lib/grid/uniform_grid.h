// The second broadphase: one uniform grid whose cells list clusters, for whoever wants the simple thing and for the
// tests' second opinion.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include <cluster/clusters.h>
#include <grid/grid_walk.h>
#include <node.h>
#include <pierce/executor.h>
#include <raw_array.h>

namespace pierce::detail {

class UniformGrid {
  public:
    UniformGrid() = default;

    /// `cell_size` in scene units; 0: a small multiple of the median cluster's. `most_bytes` is kept by larger cells,
    /// down to what one cell for all needs (20 bytes a cluster); 0: `k_bytes` a cluster, `k_least_bytes` at least. The
    /// same grid for any executor.
    template <class Scalar>
    static UniformGrid make(std::span<const ClusterBox<Scalar>> boxes, const Frame& frame, double cell_size,
                            std::size_t most_bytes, const Executor& executor);

    static constexpr std::size_t k_bytes = 48;
    static constexpr std::size_t k_least_bytes = 65536;

    [[nodiscard]] std::size_t bytes() const { return listed_.bytes() + starts_.bytes() + references_.bytes(); }
    [[nodiscard]] double cell_size() const { return cells_.size; }
    [[nodiscard]] std::size_t cell_count() const { return starts_.empty() ? 0 : starts_.size() - 1; }
    [[nodiscard]] std::size_t reference_count() const { return references_.size(); }

    /// Calls `visit(ClusterRef, double limit)`, which returns the new limit, once for each cluster whose box comes
    /// within `noise`, in each coordinate, of a point origin + t * direction, 0 <= t <= limit <= 1, relative to
    /// Frame::low; and at most once for some others, in cells near by. Roughly the nearest first; ends when the limit
    /// is below 0. A limit that is NaN, or above the one before (1 at first), changes nothing.
    template <class Visit>
    void visit(const double origin[3], const double direction[3], double noise, double limit, std::uint64_t& cells,
               Visit&& visit) const {
        if (starts_.empty() || limit < 0) return;
        if (!(limit <= 1)) limit = 1;
        GridWalk walk(cells_, origin, direction, noise, limit);
        const std::size_t strides[3] = {
            1, static_cast<std::size_t>(cells_.count[0]),
            static_cast<std::size_t>(cells_.count[0]) * static_cast<std::size_t>(cells_.count[1])};
        const std::size_t a = walk.along;
        const std::size_t b = walk.across[0];
        const std::size_t c = walk.across[1];
        CellRectangle before = k_no_cells;
        CellRectangle now;
        for (; walk.next(now); before = now) {
            const int slab = walk.slab;
            const int slab_before = slab - walk.step();
            const auto met_before = [&](const Listed& x) {
                return x.low[a] <= slab_before && x.high[a] >= slab_before && before.low[0] <= x.high[b] &&
                       before.high[0] >= x.low[b] && before.low[1] <= x.high[c] && before.high[1] >= x.low[c];
            };
            for (int j = now.low[1]; j <= now.high[1]; ++j) {
                for (int i = now.low[0]; i <= now.high[0]; ++i) {
                    const std::size_t cell = strides[a] * static_cast<std::size_t>(slab) +
                                             strides[b] * static_cast<std::size_t>(i) +
                                             strides[c] * static_cast<std::size_t>(j);
                    ++cells;
                    for (std::uint32_t k = starts_[cell]; k < starts_[cell + 1]; ++k) {
                        const Listed& x = listed_[references_[k]];
                        const bool least = (i == now.low[0] || i == x.low[b]) && (j == now.low[1] || j == x.low[c]);
                        if (!least || met_before(x)) continue;
                        const double less = visit(x.ref, limit);
                        if (!(less < limit)) continue;
                        if (less < 0) return;
                        limit = less;
                        walk.shorten(limit);
                    }
                }
            }
        }
    }

  private:
    /// A cluster, and the cells that its box touches.
    struct Listed {
        ClusterRef ref;
        std::uint16_t low[3];
        std::uint16_t high[3];
    };

    /// Calls `visit` with the start of each cell of a cluster.
    template <class Visit>
    void each_cell(const Listed& x, Visit&& visit);
    void fill(const Executor& executor);

    GridCells cells_;
    RawArray<Listed> listed_;
    RawArray<std::uint32_t> starts_;      ///< of each cell's references, and where the last one's end
    RawArray<std::uint32_t> references_;  ///< places in `listed_`, in each cell in their order
};

}  // namespace pierce::detail
