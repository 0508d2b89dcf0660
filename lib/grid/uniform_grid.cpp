// Cells of a size that the memory allows, and the clusters counted and sorted into them.
#include <grid/uniform_grid.h>

#include <atomic>
#include <vector>

#include <chunks.h>

namespace pierce::detail {

namespace {

// A cell is this many times as wide as the median cluster.
constexpr double k_cell = 1.5;
constexpr double k_enlarge = 1.25;
constexpr std::size_t k_some = 4096;  ///< clusters that are looked at for the median
/// Cells along the longest axis: rounding keeps them below GridCells::k_most_along.
constexpr double k_finest = 65000;
/// A scene no wider than this is one cell: sizes stay 2^-47 or more (grid_walk.h).
constexpr double k_flat = 0x1p-30;
constexpr std::uint64_t k_most_bytes = std::uint64_t{1} << 33;  ///< so that places of references fit 32 bits

using Place = std::atomic_ref<std::uint32_t>;

struct Extent {
    double low[3] = {};
    double high[3] = {};
};

template <class Scalar>
double relative(Scalar x, const Frame& frame, std::size_t k) {
    return static_cast<double>(x) - frame.low[k];
}

template <class Scalar>
Extent extent_of(std::span<const ClusterBox<Scalar>> boxes, const Frame& frame, const Executor& executor) {
    std::vector<Extent> parts(chunks_of(boxes.size()));
    each_chunk(executor, boxes.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                const double low = relative(boxes[i].low[k], frame, k);
                const double high = relative(boxes[i].high[k], frame, k);
                parts[part].low[k] = i == begin ? low : std::min(parts[part].low[k], low);
                parts[part].high[k] = i == begin ? high : std::max(parts[part].high[k], high);
            }
        }
    });
    Extent all = parts[0];
    for (const Extent& part : parts) {
        for (std::size_t k = 0; k < 3; ++k) {
            all.low[k] = std::min(all.low[k], part.low[k]);
            all.high[k] = std::max(all.high[k], part.high[k]);
        }
    }
    return all;
}

template <class Scalar>
double median_extent(std::span<const ClusterBox<Scalar>> boxes) {
    std::vector<double> some;
    const std::size_t stride = std::max<std::size_t>(1, boxes.size() / k_some);
    for (std::size_t i = 0; i < boxes.size(); i += stride) {
        double most = 0;
        for (std::size_t k = 0; k < 3; ++k)
            most = std::max(most, static_cast<double>(boxes[i].high[k]) - static_cast<double>(boxes[i].low[k]));
        some.push_back(most);
    }
    const auto middle = some.begin() + static_cast<std::ptrdiff_t>(some.size() / 2);
    std::nth_element(some.begin(), middle, some.end());
    return *middle;
}

/// Cells of this size for all of `extent`.
GridCells cells_of(const Extent& extent, double size) {
    GridCells cells;
    cells.size = size;
    cells.inverse = 1 / size;
    for (std::size_t k = 0; k < 3; ++k) {
        cells.low[k] = extent.low[k];
        cells.reach = std::max({cells.reach, std::abs(extent.low[k]), std::abs(extent.high[k])});
        cells.count[k] = static_cast<int>(cells.place(k, extent.high[k])) + 1;
    }
    return cells;
}

double count_of(const GridCells& cells) {
    double count = 1;
    for (const int along : cells.count) count *= along;
    return count;
}

}  // namespace

template <class Scalar>
UniformGrid UniformGrid::make(std::span<const ClusterBox<Scalar>> boxes, const Frame& frame, double cell_size,
                              std::size_t most_bytes, const Executor& executor) {
    UniformGrid grid;
    if (boxes.empty()) return grid;
    if (most_bytes == 0) most_bytes = std::max(k_least_bytes, k_bytes * boxes.size());
    const double fixed = static_cast<double>(sizeof(Listed) * boxes.size() + sizeof(std::uint32_t));
    const double most =
        (static_cast<double>(std::min<std::uint64_t>(most_bytes, k_most_bytes)) - fixed) / sizeof(std::uint32_t);

    const Extent extent = extent_of(boxes, frame, executor);
    double width = 0;
    for (std::size_t k = 0; k < 3; ++k) width = std::max(width, extent.high[k] - extent.low[k]);
    // Written so that a NaN or negative size is chosen, and an infinite one is one cell.
    double size = cell_size > 0 ? cell_size : k_cell * median_extent(boxes);
    size = width > k_flat ? std::clamp(size, width / k_finest, 2 * width) : 1;
    grid.cells_ = cells_of(extent, size);
    const auto enlarge = [&] {
        size *= k_enlarge;
        grid.cells_ = cells_of(extent, size);
    };
    const auto n = static_cast<double>(boxes.size());
    while (count_of(grid.cells_) > 1 && count_of(grid.cells_) + n > most) enlarge();

    grid.listed_ = RawArray<Listed>(boxes.size());
    std::vector<double> parts(chunks_of(boxes.size()));
    for (;;) {
        each_chunk(executor, boxes.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
            double sum = 0;  // of whole numbers below 2^53, or far too many
            for (std::size_t i = begin; i < end; ++i) {
                Listed& x = grid.listed_[i];
                x.ref = boxes[i].ref;
                double cells = 1;
                for (std::size_t k = 0; k < 3; ++k) {
                    const int low = grid.cells_.cell_from(k, relative(boxes[i].low[k], frame, k));
                    const int high = grid.cells_.cell_to(k, relative(boxes[i].high[k], frame, k));
                    x.low[k] = static_cast<std::uint16_t>(low);
                    x.high[k] = static_cast<std::uint16_t>(high);
                    cells *= high - low + 1;
                }
                sum += cells;
            }
            parts[part] = sum;
        });
        double references = 0;
        for (const double part : parts) references += part;
        const double cells = count_of(grid.cells_);
        if (cells == 1 || cells + references <= most) {
            grid.starts_ = RawArray<std::uint32_t>(static_cast<std::size_t>(cells) + 1);
            grid.references_ = RawArray<std::uint32_t>(static_cast<std::size_t>(references));
            break;
        }
        enlarge();
    }
    grid.fill(executor);
    return grid;
}

template <class Visit>
void UniformGrid::each_cell(const Listed& x, Visit&& visit) {
    const auto columns = static_cast<std::size_t>(cells_.count[0]);
    const auto rows = static_cast<std::size_t>(cells_.count[1]);
    for (std::size_t z = x.low[2]; z <= x.high[2]; ++z)
        for (std::size_t y = x.low[1]; y <= x.high[1]; ++y)
            for (std::size_t i = x.low[0]; i <= x.high[0]; ++i) visit(starts_[(z * rows + y) * columns + i]);
}

// Counts, then ends of each cell's references, then places given out from the end: what is left are the starts. Threads
// find their places in any order, so each cell is sorted.
void UniformGrid::fill(const Executor& executor) {
    std::fill(starts_.begin(), starts_.end(), 0U);
    each_chunk(executor, listed_.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            each_cell(listed_[i], [](std::uint32_t& count) { Place(count).fetch_add(1, std::memory_order_relaxed); });
    });
    std::uint32_t sum = 0;
    for (std::uint32_t& start : starts_) start = sum += start;
    each_chunk(executor, listed_.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            each_cell(listed_[i], [&](std::uint32_t& place) {
                references_[Place(place).fetch_sub(1, std::memory_order_relaxed) - 1] = static_cast<std::uint32_t>(i);
            });
    });
    each_chunk(executor, cell_count(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t cell = begin; cell < end; ++cell) {
            std::uint32_t* const first = references_.data() + starts_[cell];
            std::uint32_t* const last = references_.data() + starts_[cell + 1];
            std::reverse(first, last);  // without threads that is all
            if (!std::is_sorted(first, last)) std::sort(first, last);
        }
    });
}

template UniformGrid UniformGrid::make(std::span<const ClusterBox<float>>, const Frame&, double, std::size_t,
                                       const Executor&);
template UniformGrid UniformGrid::make(std::span<const ClusterBox<double>>, const Frame&, double, std::size_t,
                                       const Executor&);

}  // namespace pierce::detail
