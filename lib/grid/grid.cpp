// The broad phase: choosing a resolution and filling the cells.
#include <grid/grid.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pierce::detail {

namespace {

// Cells for each box: with 4 a surface's cells hold some ten triangles each, and a finer grid costs more in cells walked
// than it saves in tests (`examples/cast`, bunny and dragon: 2 and 8 are both slower).
constexpr double k_cells_per_box = 4;

// Keeps the walk's padding below 2^-27 cells (walk.h), and an index of all cells well inside 64 bits.
constexpr double k_most_cells_on_an_axis = 1 << 20;

Box bounds_of(std::span<const Box> boxes) {
    Box bounds = boxes.front();
    for (const Box& box : boxes) {
        for (std::size_t k = 0; k < 3; ++k) {
            bounds.low[k] = std::min(bounds.low[k], box.low[k]);
            bounds.high[k] = std::max(bounds.high[k], box.high[k]);
        }
    }
    return bounds;
}

// Cubes of one size, as many as asked for: an axis along which the box is thinner than a cube gets one cell and takes no
// part, so a flat mesh is divided in two dimensions and a straight one in one. The shape is scaled to its longest side first, so
// that no product of sides can overflow.
std::array<int, 3> resolution(const Box& bounds, double wanted) {
    Point side{};
    for (std::size_t k = 0; k < 3; ++k) side[k] = bounds.high[k] / 2 - bounds.low[k] / 2;
    const double longest = std::max({side[0], side[1], side[2]});
    if (!(longest > 0)) return {1, 1, 1};
    for (double& s : side) s /= longest;
    Point sorted = side;
    std::sort(sorted.begin(), sorted.end());
    double size = std::cbrt(sorted[0] * sorted[1] * sorted[2] / wanted);
    if (!(sorted[0] > size)) size = std::sqrt(sorted[1] * sorted[2] / wanted);
    if (!(sorted[1] > size)) size = sorted[2] / wanted;
    std::array<int, 3> cells{};
    for (std::size_t k = 0; k < 3; ++k)
        cells[k] = static_cast<int>(std::clamp(std::round(side[k] / size), 1.0, k_most_cells_on_an_axis));
    return cells;
}

GridShape shape_for(const Box& bounds, const std::array<int, 3>& cells) {
    GridShape shape;
    shape.low = bounds.low;
    for (std::size_t k = 0; k < 3; ++k) {
        const double scale = cells[k] / (bounds.high[k] - bounds.low[k]);
        // Sides of zero, or so short or long that the scale is not a normal number, are not divided.
        if (cells[k] > 1 && std::isnormal(scale)) {
            shape.cells[k] = cells[k];
            shape.scale[k] = scale;
        }
    }
    return shape;
}

std::array<int, 3> halved(const std::array<int, 3>& cells) {
    return {(cells[0] + 1) / 2, (cells[1] + 1) / 2, (cells[2] + 1) / 2};
}

// Only as far as `most`, so that a hopelessly fine grid costs no more than a good one.
std::size_t count_entries(const GridShape& shape, std::span<const Box> boxes, std::size_t most) {
    std::size_t count = 0;
    for (const Box& box : boxes) {
        const CellRange r = shape.range(box);
        std::size_t cells = 1;
        for (std::size_t k = 0; k < 3; ++k) cells *= static_cast<std::size_t>(r.last[k] - r.first[k] + 1);
        count += cells;
        if (count > most) break;
    }
    return count;
}

template <class F>
void for_each_cell(const GridShape& shape, const CellRange& r, F&& f) {
    for (int z = r.first[2]; z <= r.last[2]; ++z)
        for (int y = r.first[1]; y <= r.last[1]; ++y) {
            const std::size_t row = shape.index(0, y, z);
            for (int x = r.first[0]; x <= r.last[0]; ++x) f(row + static_cast<std::size_t>(x));
        }
}

}  // namespace

CellRange GridShape::range(const Box& box) const {
    CellRange r{};
    for (std::size_t k = 0; k < 3; ++k) {
        r.first[k] = cell(k, box.low[k]);
        r.last[k] = cell(k, box.high[k]);
    }
    return r;
}

std::size_t GridShape::cell_count() const {
    return static_cast<std::size_t>(cells[0]) * static_cast<std::size_t>(cells[1]) * static_cast<std::size_t>(cells[2]);
}

Grid::Grid(std::span<const Box> boxes, std::span<const std::uint32_t> numbers, const GridOptions& options) {
    if (boxes.empty()) {
        start_.assign(2, 0);
        return;
    }
    bounds_ = bounds_of(boxes);
    std::array<int, 3> cells{};
    const auto& given = options.cells;
    if (given[0] != 0 && given[1] != 0 && given[2] != 0) {
        for (std::size_t k = 0; k < 3; ++k)
            cells[k] = static_cast<int>(std::min<double>(given[k], k_most_cells_on_an_axis));
    } else {
        cells = resolution(bounds_, k_cells_per_box * static_cast<double>(boxes.size()));
    }

    // 4 bytes for each cell and each entry; both must also be countable in 32 bits. One cell is always allowed.
    const std::size_t most = std::min<std::size_t>(options.max_bytes / 4, std::numeric_limits<std::uint32_t>::max());
    for (;; cells = halved(cells)) {
        shape_ = shape_for(bounds_, cells);
        if (shape_.cell_count() == 1) break;
        if (shape_.cell_count() + 1 <= most &&
            count_entries(shape_, boxes, most) <= most - shape_.cell_count() - 1)
            break;
    }

    // Counts are kept one place further on, so that after the running sum `start_[c + 1]` is where cell c begins, and after the
    // filling, which advances it, where it ends: which is where cell c + 1 begins.
    start_.assign(shape_.cell_count() + 2, 0);
    for (const Box& box : boxes)
        for_each_cell(shape_, shape_.range(box), [&](std::size_t c) { ++start_[c + 2]; });
    for (std::size_t c = 2; c < start_.size(); ++c) start_[c] += start_[c - 1];
    entries_.resize(start_.back());
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for_each_cell(shape_, shape_.range(boxes[i]), [&](std::size_t c) { entries_[start_[c + 1]++] = numbers[i]; });
    start_.pop_back();
}

}  // namespace pierce::detail
