// From coordinates to cells.
#include <grid/raster.h>

#include <cmath>

namespace pierce::detail {

Raster::Raster(const Box& box, double size) {
    for (std::size_t k = 0; k < 3; ++k) {
        half_low_[k] = 0.5 * box.low[k];
        const double half_extent = 0.5 * box.high[k] - half_low_[k];
        // Finite and normal, whatever the box: the least cell is 2^-1000, the largest holds everything.
        double half_cell = std::clamp(0.5 * size, half_extent / k_most_cells, 0x1p1022);
        half_cell = std::max({half_cell, half_extent / (k_most_cells - 1), 0x1p-1000});
        // Nor finer than the coordinates themselves: 2^-50 is four units of the largest one's last place. So what the margin is rounded to,
        // one unit, is less than a cell, and the loops below end after a few turns.
        half_cell = std::max(half_cell, 0x1p-50 * std::max(std::abs(half_low_[k]), std::abs(0.5 * box.high[k])));
        cells_[k] = std::min(static_cast<int>(half_extent / half_cell) + 1, k_most_cells);
        scale_[k] = k_steps / half_cell;
        // As computed, the box must lie a margin inside of the cells, whatever is absorbed.
        const double half_low = half_low_[k];
        for (double back = k_margin / scale_[k]; place(k, half_low) < k_margin; back *= 2) half_low_[k] = half_low - back;
        while (place(k, 0.5 * box.high[k]) >= cells_[k] * k_steps - k_margin) ++cells_[k];
        most_[k] = cells_[k] * k_steps;
    }
}

}  // namespace pierce::detail
