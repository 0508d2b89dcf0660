// How one level is filled.
#include <grid/level_builder.h>

#include <algorithm>
#include <numeric>

namespace pierce::detail {

namespace {

// Enough for a slab's counters to stay in the second-level cache, and for slabs to share among threads.
constexpr std::size_t k_boxes_a_slab = 4096;

}  // namespace

LevelBuilder::LevelBuilder(const Raster& raster, std::uint32_t first, std::span<const Steps> boxes)
    : raster_(raster), first_(first), boxes_(boxes) {
    for (std::size_t k = 0; k < 3; ++k) bricks_[k] = (raster.cells()[k] + 3) / 4;
    slow_ = static_cast<std::size_t>(std::max_element(bricks_.begin(), bricks_.end()) - bricks_.begin());
    const std::size_t fast = (slow_ + 1) % 3;
    const std::size_t middle = (slow_ + 2) % 3;
    strides_[fast] = 1;
    strides_[middle] = static_cast<std::size_t>(bricks_[fast]);
    strides_[slow_] = strides_[middle] * static_cast<std::size_t>(bricks_[middle]);
    const auto wanted = static_cast<int>(std::clamp<std::size_t>(boxes.size() / k_boxes_a_slab, 1, std::size_t{1} << 20));
    layers_ = std::max(1, bricks_[slow_] / wanted);
    slabs_ = static_cast<std::size_t>((bricks_[slow_] + layers_ - 1) / layers_);
    sort_by_slab();
}

double LevelBuilder::directory_bytes(const Raster& raster) {
    double bytes = sizeof(Brick);
    for (const int cells : raster.cells()) bytes *= (cells + 3) / 4;
    return bytes;
}

LevelBuilder::Cells LevelBuilder::cells_of(const Steps& box) const {
    Cells cells{};
    for (std::size_t k = 0; k < 3; ++k) {
        cells.first[k] = std::max(box.low[k] - k_margin, 0) / k_steps;
        cells.last[k] = std::min((box.high[k] + k_margin) / k_steps, raster_.cells()[k] - 1);
    }
    return cells;
}

void LevelBuilder::sort_by_slab() {
    slab_starts_.assign(slabs_ + 1, 0);
    std::vector<std::size_t> references(slabs_ + 1, 0);
    for (const Steps& box : boxes_) {
        const Cells cells = cells_of(box);
        std::size_t area = 1;
        for (std::size_t k = 0; k < 3; ++k)
            if (k != slow_) area *= static_cast<std::size_t>(cells.last[k] - cells.first[k] + 1);
        const int last = slab_of(cells.last[slow_]);
        for (int slab = slab_of(cells.first[slow_]); slab <= last; ++slab) {
            const int first_cell = std::max(cells.first[slow_], slab * layers_ * 4);
            const int last_cell = std::min(cells.last[slow_], (slab + 1) * layers_ * 4 - 1);
            ++slab_starts_[static_cast<std::size_t>(slab) + 1];
            references[static_cast<std::size_t>(slab) + 1] += area * static_cast<std::size_t>(last_cell - first_cell + 1);
        }
    }
    references_ = std::accumulate(references.begin(), references.end(), std::size_t{0});
    if (references_ > 0xffff'fff0U) return;  // the caller has to choose larger cells
    std::partial_sum(slab_starts_.begin(), slab_starts_.end(), slab_starts_.begin());
    reference_starts_.assign(slabs_ + 1, 0);
    for (std::size_t slab = 0; slab < slabs_; ++slab)
        reference_starts_[slab + 1] = reference_starts_[slab] + static_cast<std::uint32_t>(references[slab + 1]);
}

void LevelBuilder::fill_slab(Level& level, std::size_t slab, std::vector<std::uint32_t>& starts) const {
    const int first_layer = static_cast<int>(slab) * layers_;
    const int last_layer = std::min(first_layer + layers_, bricks_[slow_]);
    const std::size_t first_brick = static_cast<std::size_t>(first_layer) * strides_[slow_];
    const std::size_t brick_count = static_cast<std::size_t>(last_layer - first_layer) * strides_[slow_];
    // For each cell of the slab, in the order of bricks and of bits: how many boxes it lists, then where the next one goes.
    std::vector<std::uint32_t> next(brick_count * 64, 0);

    const auto place = [&](std::size_t k, int cell) {
        return static_cast<std::size_t>(cell >> 2) * strides_[k] * 64 + (static_cast<std::size_t>(cell & 3) << (2 * k));
    };
    const auto each_cell = [&](const Steps& box, auto&& visit) {
        Cells cells = cells_of(box);
        cells.first[slow_] = std::max(cells.first[slow_], first_layer * 4);
        cells.last[slow_] = std::min(cells.last[slow_], last_layer * 4 - 1);
        Cell cell{};
        for (cell[2] = cells.first[2]; cell[2] <= cells.last[2]; ++cell[2])
            for (cell[1] = cells.first[1]; cell[1] <= cells.last[1]; ++cell[1]) {
                const std::size_t row = place(1, cell[1]) + place(2, cell[2]) - first_brick * 64;
                for (cell[0] = cells.first[0]; cell[0] <= cells.last[0]; ++cell[0]) visit(row + place(0, cell[0]), cell);
            }
    };
    const std::span<const std::uint32_t> mine(sorted_.data() + slab_starts_[slab], slab_starts_[slab + 1] - slab_starts_[slab]);
    for (const std::uint32_t i : mine) each_cell(boxes_[i], [&](std::size_t cell, const Cell&) { ++next[cell]; });

    std::uint32_t sum = reference_starts_[slab];
    for (std::size_t b = 0; b < brick_count; ++b) {
        Brick& brick = level.bricks_[first_brick + b];
        brick.first = static_cast<std::uint32_t>(starts.size());
        for (std::size_t bit = 0; bit < 64; ++bit) {
            std::uint32_t& cell = next[b * 64 + bit];
            if (cell == 0) continue;
            brick.cells |= std::uint64_t{1} << bit;
            starts.push_back(sum);
            const std::uint32_t count = cell;
            cell = sum;
            sum += count;
        }
    }
    for (const std::uint32_t i : mine)
        each_cell(boxes_[i], [&](std::size_t at, const Cell& cell) {
            const std::uint32_t to = next[at]++;
            level.boxes_[to] = pack(boxes_[i], cell);
            level.ids_[to] = first_ + i;
        });
}

// The distance in the maximum norm to the nearest brick that is not empty (Rosenfeld and Pfaltz 1966: two passes, each from the
// neighbours that the pass has seen).
void LevelBuilder::measure_empty_space(Level& level, const std::array<int, 3>& bricks) {
    constexpr std::uint32_t k_far = 1U << 20;
    for (Brick& brick : level.bricks_) brick.empty = brick.cells != 0 ? 0 : k_far;
    std::array<std::ptrdiff_t, 3> stride{};
    for (std::size_t k = 0; k < 3; ++k) stride[k] = static_cast<std::ptrdiff_t>(level.strides_[k]);
    for (const int way : {1, -1}) {
        Cell b{};
        const auto each = [&](std::size_t k, auto&& body) {
            for (int i = 0; i < bricks[k]; ++i) {
                b[k] = way > 0 ? i : bricks[k] - 1 - i;
                body();
            }
        };
        each(2, [&] { each(1, [&] { each(0, [&] {
            const std::ptrdiff_t at = b[0] * stride[0] + b[1] * stride[1] + b[2] * stride[2];
            std::uint32_t& empty = level.bricks_[static_cast<std::size_t>(at)].empty;
            if (empty == 0) return;
            for (int dz = -1; dz <= 0; ++dz)
                for (int dy = -1; dy <= (dz < 0 ? 1 : 0); ++dy)
                    for (int dx = -1; dx <= (dz < 0 || dy < 0 ? 1 : -1); ++dx) {
                        const Cell n = {b[0] + way * dx, b[1] + way * dy, b[2] + way * dz};
                        bool inside = true;
                        for (std::size_t k = 0; k < 3; ++k) inside = inside && n[k] >= 0 && n[k] < bricks[k];
                        if (!inside) continue;
                        const std::ptrdiff_t near = n[0] * stride[0] + n[1] * stride[1] + n[2] * stride[2];
                        empty = std::min(empty, level.bricks_[static_cast<std::size_t>(near)].empty + 1);
                    }
        }); }); });
    }
}

Level LevelBuilder::build(const Executor& executor) {
    sorted_.resize(slab_starts_.back());
    std::vector<std::uint32_t> next(slab_starts_.begin(), slab_starts_.end() - 1);
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
        const Cells cells = cells_of(boxes_[i]);
        for (int slab = slab_of(cells.first[slow_]); slab <= slab_of(cells.last[slow_]); ++slab)
            sorted_[next[static_cast<std::size_t>(slab)]++] = static_cast<std::uint32_t>(i);
    }

    Level level;
    level.raster_ = raster_;
    level.strides_ = strides_;
    level.references_ = references_;
    level.bricks_.resize(static_cast<std::size_t>(bricks_[0]) * static_cast<std::size_t>(bricks_[1]) *
                         static_cast<std::size_t>(bricks_[2]));
    level.boxes_ = std::make_unique_for_overwrite<PackedBox[]>(references_ + Level::k_beyond);
    std::fill_n(level.boxes_.get() + references_, Level::k_beyond, 0);
    level.ids_ = std::make_unique_for_overwrite<std::uint32_t[]>(references_);
    std::vector<std::vector<std::uint32_t>> starts(slabs_);
    executor(slabs_, [&](std::size_t slab) { fill_slab(level, slab, starts[slab]); });

    std::size_t before = 0;
    for (std::size_t slab = 0; slab < slabs_; ++slab) {
        if (before != 0) {
            const std::size_t first = slab * static_cast<std::size_t>(layers_) * strides_[slow_];
            const std::size_t last = std::min(first + static_cast<std::size_t>(layers_) * strides_[slow_], level.bricks_.size());
            for (std::size_t b = first; b < last; ++b) level.bricks_[b].first += static_cast<std::uint32_t>(before);
        }
        before += starts[slab].size();
    }
    level.starts_.reserve(before + 1);
    for (const auto& some : starts) level.starts_.insert(level.starts_.end(), some.begin(), some.end());
    level.starts_.push_back(static_cast<std::uint32_t>(references_));
    measure_empty_space(level, bricks_);
    return level;
}

}  // namespace pierce::detail
