// The broadphase: which level a box goes to, and how large its cells are.
#include <grid/grid.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <chunks.h>
#include <grid/level_builder.h>
#include <grid/sort_by_key.h>
#include <raw_array.h>

namespace pierce::detail {

namespace {

// A cell is this many times as wide as the median box. Surfaces fill cells by area: at 3.5 a cell lists some 40 boxes, of which a wide
// kernel reads eight at once, and a triangle is in less than two cells. Measured (tests/bench/run): queries take the same time from 2.5 to
// 4.5, and less takes memory.
constexpr double k_cell = 3.5;
// The next level's cells are this many times as wide; a box goes to the first level whose cells are not much smaller than it. Every query asks every
// level, so there are few.
constexpr int k_next_level_bits = 3;
constexpr double k_next_level = 1 << k_next_level_bits;
constexpr double k_largest_box = 1.3;
constexpr std::size_t k_most_levels = 24;
constexpr double k_finest = 0x1p24;       ///< cells at the usual size are this many times as wide as those of the finest level
constexpr double k_crowded = 1000;        ///< see crowded()
constexpr double k_most_extra = 3;        ///< entries for each triangle that is there already, rather than a level more

constexpr std::size_t k_some = 4096;      ///< boxes that are looked at where it is the usual one that counts

template <class Scalar>
double extent(const PlainBox<Scalar>& box) {
    double most = 0;
    for (std::size_t k = 0; k < 3; ++k) most = std::max(most, static_cast<double>(box.high[k]) - static_cast<double>(box.low[k]));
    return most;
}

template <class Scalar>
double usual_extent(std::span<const PlainBox<Scalar>> boxes) {
    std::vector<double> some;
    const std::size_t stride = std::max<std::size_t>(1, boxes.size() / k_some);
    for (std::size_t i = 0; i < boxes.size(); i += stride)
        if (boxes[i].listed()) some.push_back(extent(boxes[i]));
    if (some.empty()) return 0;
    const auto place = some.begin() + static_cast<std::ptrdiff_t>(some.size() / 2);
    std::nth_element(some.begin(), place, some.end());
    return *place;
}

void extend(Box& box, const Box& other) {
    for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] = std::min(box.low[k], other.low[k]);
        box.high[k] = std::max(box.high[k], other.high[k]);
    }
}

/// The boxes of one level.
struct Share {
    Box box{{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
             std::numeric_limits<double>::infinity()},
            {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
             -std::numeric_limits<double>::infinity()}};
    RawArray<std::uint32_t> ids;

    void take(Share& other) {
        RawArray<std::uint32_t> both(ids.size() + other.ids.size());
        std::merge(ids.begin(), ids.end(), other.ids.begin(), other.ids.end(), both.begin());
        ids = std::move(both);
        other.ids = {};
        extend(box, other.box);
    }
};

using Shares = std::array<Share, k_most_levels>;

/// Which level each box is for, by its size.
template <class Scalar>
Shares share_out(std::span<const PlainBox<Scalar>> boxes, double finest, const Executor& executor) {
    std::array<double, k_most_levels> largest{};  // of a level's boxes
    for (std::size_t level = 0; level < k_most_levels; ++level)
        largest[level] = level + 1 == k_most_levels ? std::numeric_limits<double>::infinity()
                                                    : (level == 0 ? k_largest_box * finest : largest[level - 1] * k_next_level);
    constexpr std::size_t k_usual = std::countr_zero(static_cast<std::uint64_t>(k_finest)) / k_next_level_bits;
    struct Chunk {
        std::array<std::uint32_t, k_most_levels> count{};
        std::array<PlainBox<Scalar>, k_most_levels> box;
    };
    std::vector<Chunk> chunks(chunks_of(boxes.size()));
    RawArray<std::uint8_t> levels(boxes.size());
    constexpr std::uint8_t k_none = 0xff;
    each_chunk(executor, boxes.size(), [&](std::size_t c, std::size_t begin, std::size_t end) {
        Chunk& chunk = chunks[c];
        for (std::size_t i = begin; i < end; ++i) {
            if (!boxes[i].listed()) {
                levels[i] = k_none;
                continue;
            }
            const double reach = extent(boxes[i]);
            std::size_t level = k_usual;
            while (reach > largest[level]) ++level;
            while (level > 0 && reach <= largest[level - 1]) --level;
            levels[i] = static_cast<std::uint8_t>(level);
            PlainBox<Scalar>& box = chunk.box[level];
            if (chunk.count[level]++ == 0) box = boxes[i];
            for (std::size_t k = 0; k < 3; ++k) {
                box.low[k] = std::min(box.low[k], boxes[i].low[k]);
                box.high[k] = std::max(box.high[k], boxes[i].high[k]);
            }
        }
    });
    Shares shares;
    for (std::size_t level = 0; level < k_most_levels; ++level) {
        std::uint32_t before = 0;
        for (Chunk& chunk : chunks) {
            const std::uint32_t count = std::exchange(chunk.count[level], before);
            before += count;
            if (count == 0) continue;
            const PlainBox<Scalar>& box = chunk.box[level];
            const auto point = [](const std::array<Scalar, 3>& p) {
                return Point{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
            };
            extend(shares[level].box, {point(box.low), point(box.high)});
        }
        shares[level].ids = RawArray<std::uint32_t>(before);
    }
    each_chunk(executor, boxes.size(), [&](std::size_t c, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (levels[i] != k_none) shares[levels[i]].ids[chunks[c].count[levels[i]]++] = static_cast<std::uint32_t>(i);
    });
    return shares;
}

/// Whether many of the boxes share a cell of a size with the average one of them: of some of them, by their lower corners.
template <class Scalar>
bool crowded(const Share& share, std::span<const PlainBox<Scalar>> boxes, double cell) {
    if (static_cast<double>(share.ids.size()) < k_crowded) return false;
    const std::size_t stride = (share.ids.size() - 1) / k_some + 1;
    const std::size_t some = (share.ids.size() - 1) / stride + 1;
    struct Place {
        std::uint64_t key = 0;
        std::uint32_t count = 0;
    };
    const auto bits = static_cast<int>(std::bit_width(2 * some));
    std::vector<Place> places(std::size_t{1} << bits);
    const Raster raster(share.box, cell);
    double pairs = 0;
    for (std::size_t i = 0; i < share.ids.size(); i += stride) {
        const std::uint32_t id = share.ids[i];
        const std::array<int, 3> at = raster.cell_of(raster.steps(boxes[id].low, boxes[id].high).low);
        const std::uint64_t key = static_cast<std::uint64_t>(at[0]) << 42 | static_cast<std::uint64_t>(at[1]) << 21 |
                                  static_cast<std::uint64_t>(at[2]);
        // Fibonacci hashing (Knuth, volume 3, 6.4): the upper bits, on which all of the key has an effect.
        std::size_t place = key * 0x9e3779b97f4a7c15 >> (64 - bits);
        while (places[place].count != 0 && places[place].key != key) place = (place + 1) & (places.size() - 1);
        places[place].key = key;
        pairs += places[place].count++;
    }
    // Each box is in two lists of pairs, and shares its cell with as many times more as there are more boxes.
    return 2 * pairs / static_cast<double>(some) * static_cast<double>(stride) >= k_crowded;
}

/// About how many cells of a size the boxes of a level would be listed in.
template <class Scalar>
double cells_for(const Share& share, std::span<const PlainBox<Scalar>> boxes, double cell) {
    double sum = 0;
    for (const std::uint32_t id : share.ids) {
        double cells = 1;
        for (std::size_t k = 0; k < 3; ++k)
            cells *= (static_cast<double>(boxes[id].high[k]) - static_cast<double>(boxes[id].low[k])) / cell + 1;
        sum += cells;
    }
    return sum;
}

/// The triangles of a level in the order of their cells.
template <class Scalar>
void sort_by_cell(const Raster& raster, std::span<const PlainBox<Scalar>> boxes, RawArray<std::uint32_t>& ids,
                  const Executor& executor) {
    RawArray<std::uint32_t> keys(ids.size());
    each_chunk(executor, ids.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const PlainBox<Scalar>& box = boxes[ids[i]];
            // Half a cell at a time along each axis, ten bits of it: which place of memory a triangle gets is nobody's promise.
            std::uint32_t key = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const double middle = 0.25 * static_cast<double>(box.low[k]) + 0.25 * static_cast<double>(box.high[k]);
                const double place = std::clamp(raster.place(k, middle), 0.0, raster.most(k));
                std::uint32_t x = static_cast<std::uint32_t>(place) / (k_steps / 2) & 0x3ff;
                // Every third bit (Morton 1966).
                x = (x | x << 16) & 0x030000ff;
                x = (x | x << 8) & 0x0300f00f;
                x = (x | x << 4) & 0x030c30c3;
                x = (x | x << 2) & 0x09249249;
                key |= x << k;
            }
            keys[i] = key;
        }
    });
    sort_by_key(keys, ids, executor);
}

/// A level of the triangles `ids`, which it sorts; they get the numbers from `first` on.
template <class Scalar>
Level build_level(const Box& box, RawArray<std::uint32_t>& ids, std::uint32_t first, double size,
                  std::span<const PlainBox<Scalar>> boxes, std::size_t max_bytes, const Executor& executor) {
    sort_by_cell(Raster(box, size), boxes, ids, executor);
    RawArray<Steps> steps(ids.size());
    for (;;) {
        const Raster raster(box, size);
        // Beyond the range of a double no cells are larger.
        const bool largest = raster.cells() == std::array<int, 3>{1, 1, 1} || !(size < 0x1p1023);
        each_chunk(executor, steps.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                __builtin_prefetch(&boxes[ids[std::min(i + k_ahead, end - 1)]]);
                steps[i] = raster.steps(boxes[ids[i]].low, boxes[ids[i]].high);
            }
        });
        LevelBuilder builder(raster, first, std::span<const Steps>(steps.data(), steps.size()), executor);
        // 16 bytes a reference: a start for each cell that lists something, and there are at most as many of these. For roots and what is
        // above them, see the builder. Further nodes are few, but where boxes are scattered: that is known when they are built.
        const double bytes = 16.0 * static_cast<double>(builder.reference_count()) + 11.0 * static_cast<double>(ids.size()) + 1024;
        const bool countable = builder.reference_count() <= 0xffff'fff0U;
        double larger = 1.25;
        if (countable && (largest || bytes <= static_cast<double>(max_bytes))) {
            Level level = builder.build();
            if (largest || level.bytes() <= max_bytes) return level;
            larger = 2;
        }
        if (largest) throw std::length_error("the grid of a mesh with so many triangles of this size can't be numbered");
        // Larger ones; and no size for which the raster, which has only so many cells, would be the same.
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < 3; ++k)
            if (raster.cells()[k] > 1) least = std::min(least, raster.size(k));
        size = std::max(larger * size, least);
    }
}

}  // namespace

template <class Scalar>
Grid::Grid(std::span<const PlainBox<Scalar>> boxes, const GridOptions& options, const Executor& executor) {
    const double size = options.cell_size > 0 ? options.cell_size : std::max(k_cell * usual_extent(boxes), 0x1p-1000);
    const double finest = options.cell_size > 0 ? size : size / k_finest;
    Shares shares = share_out(boxes, finest, executor);
    std::size_t listed = 0;
    for (const Share& share : shares) listed += share.ids.size();
    // Those that are smaller than the rest need cells of their own only where they are crowded; a few that are larger are not
    // worth a level, which every query has to ask.
    double cell = finest;
    for (std::size_t level = 0; level < k_most_levels; ++level, cell *= k_next_level) {
        if (shares[level].ids.empty()) continue;
        std::size_t coarser = level + 1;
        double coarser_cell = cell * k_next_level;
        for (; coarser < k_most_levels && shares[coarser].ids.empty(); ++coarser) coarser_cell *= k_next_level;
        if (coarser == k_most_levels || options.cell_size > 0) break;
        if (!crowded(shares[level], boxes, coarser_cell)) shares[coarser].take(shares[level]);
    }
    cell = finest;
    std::size_t finer = k_most_levels;
    double finer_cell = 0;
    for (std::size_t level = 0; level < k_most_levels; ++level, cell *= k_next_level) {
        Share& share = shares[level];
        if (share.ids.empty()) continue;
        if (finer < k_most_levels && cells_for(share, boxes, finer_cell) < k_most_extra * static_cast<double>(shares[finer].ids.size())) {
            shares[finer].take(share);
            continue;
        }
        finer = level;
        finer_cell = cell;
    }
    order_.reserve(listed);
    cell = finest;
    for (Share& share : shares) {
        if (!share.ids.empty()) {
            const double part = static_cast<double>(share.ids.size()) / static_cast<double>(listed);
            levels_.push_back(build_level(share.box, share.ids, static_cast<std::uint32_t>(order_.size()), cell, boxes,
                                          static_cast<std::size_t>(part * static_cast<double>(options.max_bytes)), executor));
            order_.insert(order_.end(), share.ids.begin(), share.ids.end());
            if (levels_.size() == 1) bounds_ = share.box;
            extend(bounds_, share.box);
        }
        cell *= k_next_level;
    }
}

template Grid::Grid(std::span<const PlainBox<float>>, const GridOptions&, const Executor&);
template Grid::Grid(std::span<const PlainBox<double>>, const GridOptions&, const Executor&);

std::size_t Grid::bytes() const {
    std::size_t sum = levels_.capacity() * sizeof(Level);
    for (const Level& level : levels_) sum += level.bytes();
    return sum;
}

}  // namespace pierce::detail
