// How one level is filled.
#include <grid/level_builder.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include <chunks.h>
#include <grid/sort_by_key.h>

namespace pierce::detail {

namespace {

// Enough for a slab's counters to stay in the second-level cache, and for slabs to share among threads.
constexpr std::size_t k_boxes_a_slab = 2048;
constexpr std::size_t k_most_slabs = 2048;  ///< each chunk of boxes has 12 bytes for each: 3 a box

}  // namespace

LevelBuilder::LevelBuilder(const Raster& raster, std::uint32_t first, std::span<const Steps> boxes, const Executor& executor)
    : raster_(raster), last_cell_{raster.cells()[0] - 1, raster.cells()[1] - 1, raster.cells()[2] - 1, 0}, first_(first), boxes_(boxes),
      executor_(executor) {
    place_roots();
    const auto wanted = static_cast<int>(std::clamp<std::size_t>(boxes.size() / k_boxes_a_slab, 1, k_most_slabs));
    layers_ = std::max(1, roots_[slow_] / wanted);
    slabs_ = static_cast<std::size_t>((roots_[slow_] + layers_ - 1) / layers_);
    for (int root = 0; root < roots_[slow_]; ++root) slab_of_root_.push_back(static_cast<std::uint32_t>(root / layers_));
    count_slabs();
}

// Roots as small as they may be for eight bytes of them a triangle, and a third of that above them: bricks, if the mesh fills its box as evenly as a surface does.
void LevelBuilder::place_roots() {
    for (root_shift_ = 2;; root_shift_ += 2) {
        double roots = 1;
        for (std::size_t k = 0; k < 3; ++k) {
            roots_[k] = ((raster_.cells()[k] - 1) >> root_shift_) + 1;
            roots *= roots_[k];
        }
        if (roots <= static_cast<double>(boxes_.size() / 2 + 64)) break;
    }
    slow_ = static_cast<std::size_t>(std::max_element(roots_.begin(), roots_.end()) - roots_.begin());
    const std::size_t fast = (slow_ + 1) % 3;
    const std::size_t middle = (slow_ + 2) % 3;
    strides_[fast] = 1;
    strides_[middle] = static_cast<std::size_t>(roots_[fast]);
    strides_[slow_] = strides_[middle] * static_cast<std::size_t>(roots_[middle]);
}

// Calls visit(chunk, box's number) for all boxes, chunk by chunk.
template <class Visit>
void LevelBuilder::each_box(Visit&& visit) const {
    each_chunk(executor_, boxes_.size(), [&](std::size_t chunk, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) visit(chunk, i);
    });
}

void LevelBuilder::count_slabs() {
    const std::size_t chunks = chunks_of(boxes_.size());
    chunk_starts_.assign(chunks * slabs_, 0);
    std::vector<std::size_t> references(chunks * slabs_, 0);
    each_box([&](std::size_t chunk, std::size_t i) {
        const Cells cells = cells_of(boxes_[i]);
        std::size_t area = 1;
        for (std::size_t k = 0; k < 3; ++k)
            if (k != slow_) area *= static_cast<std::size_t>(cells.last[k] - cells.first[k] + 1);
        const int last = slab_of(cells.last[slow_]);
        for (int slab = slab_of(cells.first[slow_]); slab <= last; ++slab) {
            const int first_cell = std::max(cells.first[slow_], slab * layers_ << root_shift_);
            const int last_cell = std::min(cells.last[slow_], ((slab + 1) * layers_ << root_shift_) - 1);
            ++chunk_starts_[chunk * slabs_ + static_cast<std::size_t>(slab)];
            references[chunk * slabs_ + static_cast<std::size_t>(slab)] +=
                area * static_cast<std::size_t>(last_cell - first_cell + 1);
        }
    });
    references_ = std::accumulate(references.begin(), references.end(), std::size_t{0});
    if (references_ > 0xffff'fff0U) return;  // the caller has to choose larger cells
    slab_starts_.assign(1, 0);
    reference_starts_.assign(1, 0);
    for (std::size_t slab = 0; slab < slabs_; ++slab) {
        std::uint32_t listed = slab_starts_.back();
        std::size_t sum = 0;
        for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
            std::uint32_t& start = chunk_starts_[chunk * slabs_ + slab];
            listed += std::exchange(start, listed);
            sum += references[chunk * slabs_ + slab];
        }
        slab_starts_.push_back(listed);
        reference_starts_.push_back(reference_starts_.back() + static_cast<std::uint32_t>(sum));
    }
}

void LevelBuilder::sort_by_slab() {
    sorted_ = RawArray<std::uint32_t>(slab_starts_.back());
    each_box([&](std::size_t chunk, std::size_t i) {
        const Cells cells = cells_of(boxes_[i]);
        const int last = slab_of(cells.last[slow_]);
        for (int slab = slab_of(cells.first[slow_]); slab <= last; ++slab)
            sorted_[chunk_starts_[chunk * slabs_ + static_cast<std::size_t>(slab)]++] = static_cast<std::uint32_t>(i);
    });
}

template <class Visit>
void LevelBuilder::each_cell(const Cells& cells, Visit&& visit) const {
    for (int z = cells.first[2]; z <= cells.last[2]; ++z)
        for (int y = cells.first[1]; y <= cells.last[1]; ++y)
            for (int x = cells.first[0]; x <= cells.last[0]; ++x) visit(x, y, z);
}

// Returns where each of its cells starts.
RawArray<std::uint32_t> LevelBuilder::fill_slab(Level& level, std::size_t slab) const {
    const int first_layer = static_cast<int>(slab) * layers_;
    const int last_layer = std::min(first_layer + layers_, roots_[slow_]);
    const std::size_t first_brick = static_cast<std::size_t>(first_layer) * strides_[slow_];
    const std::size_t brick_count = static_cast<std::size_t>(last_layer - first_layer) * strides_[slow_];
    // For each cell of the slab, in the order of bricks and of bits: how many boxes it lists, then where the next one goes.
    std::vector<std::uint32_t> next(brick_count * 64, 0);

    const auto place = [&](std::size_t k, int cell) {
        return static_cast<std::size_t>(cell >> 2) * strides_[k] * 64 + (static_cast<std::size_t>(cell & 3) << (2 * k));
    };
    Ints first_cell = {0, 0, 0, 0};
    Ints last_cell = last_cell_;
    first_cell[slow_] = first_layer * 4;
    last_cell[slow_] = last_layer * 4 - 1;
    const auto cells_in_slab = [&](const Steps& box, auto&& visit) {
        Cells cells = cells_of(box);
        cells.first = cells.first > first_cell ? cells.first : first_cell;
        cells.last = cells.last < last_cell ? cells.last : last_cell;
        each_cell(cells, [&](int x, int y, int z) {
            visit(place(0, x) + place(1, y) + place(2, z) - first_brick * 64, Ints{x, y, z, 0});
        });
    };
    struct Entry {
        PackedBox box;
        std::uint32_t id;
        std::uint32_t cell;
    };
    RawArray<Entry> entries(reference_starts_[slab + 1] - reference_starts_[slab]);
    Entry* entry = entries.data();
    Node* const bricks = &level.nodes_[first_brick];
    for (std::uint32_t s = slab_starts_[slab]; s < slab_starts_[slab + 1]; ++s) {
        const Steps& box = boxes_[sorted_[s]];
        cells_in_slab(box, [&](std::size_t at, const Ints& cell) {
            ++next[at];
            bricks[at / 64].parts |= std::uint64_t{1} << at % 64;
            *entry++ = {pack(box, cell), first_ + sorted_[s], static_cast<std::uint32_t>(at)};
        });
    }

    std::uint32_t cells = 0;
    for (std::size_t b = 0; b < brick_count; ++b) {
        bricks[b].first = cells;
        cells += Level::count_bits(bricks[b].parts);
    }
    RawArray<std::uint32_t> starts(cells);
    std::uint32_t* start = starts.data();
    std::uint32_t sum = reference_starts_[slab];
    for (std::size_t b = 0; b < brick_count; ++b) {
        for (std::uint64_t parts = bricks[b].parts; parts != 0; parts &= parts - 1) {
            *start++ = sum;
            sum += std::exchange(next[b * 64 + static_cast<std::size_t>(std::countr_zero(parts))], sum);
        }
    }
    for (const Entry& some : entries) {
        const std::uint32_t to = next[some.cell]++;
        level.boxes_[to] = some.box;
        level.ids_[to] = some.id;
    }
    return starts;
}

// Each layer of the one below it, from the roots on.
void LevelBuilder::build_tops(Level& level) const {
    struct Layer {
        std::array<int, 3> size;
        std::size_t first;
    };
    std::vector<Layer> layers;
    std::size_t count = 0;
    for (std::array<int, 3> size = roots_; size != std::array<int, 3>{1, 1, 1};) {
        std::size_t places = 1;
        for (int& n : size) {
            n = ((n - 1) >> 2) + 1;
            places *= static_cast<std::size_t>(n);
        }
        layers.push_back({size, count});
        count += places;
    }
    level.top_parts_.assign(count, 0);
    level.tops_.reserve(layers.size());
    const auto mark = [&](const Layer& layer, const Cell& part) {
        const std::size_t place = static_cast<std::size_t>(part[0] >> 2) +
                                  static_cast<std::size_t>(layer.size[0]) * (static_cast<std::size_t>(part[1] >> 2) +
                                  static_cast<std::size_t>(layer.size[1]) * static_cast<std::size_t>(part[2] >> 2));
        level.top_parts_[layer.first + place] |= Level::bit_of(part);
    };
    const auto each = [](const std::array<int, 3>& size, auto&& visit) {
        for (int z = 0; z < size[2]; ++z)
            for (int y = 0; y < size[1]; ++y)
                for (int x = 0; x < size[0]; ++x) visit(Cell{x, y, z});
    };
    for (std::size_t l = 0; l < layers.size(); ++l) {
        if (l == 0) {
            each(roots_, [&](const Cell& at) {
                const std::size_t root = static_cast<std::size_t>(at[0]) * strides_[0] + static_cast<std::size_t>(at[1]) * strides_[1] +
                                         static_cast<std::size_t>(at[2]) * strides_[2];
                if (level.nodes_[root].parts != 0) mark(layers[0], at);
            });
        } else {
            const std::uint64_t* parts = &level.top_parts_[layers[l - 1].first];
            each(layers[l - 1].size, [&](const Cell& at) {
                if (*parts++ != 0) mark(layers[l], at);
            });
        }
        const auto stride = [&](std::size_t n) { return static_cast<std::uint32_t>(n); };  // of fewer places than roots
        const auto wide = static_cast<std::size_t>(layers[l].size[0]);
        level.tops_.push_back({&level.top_parts_[layers[l].first],
                               {stride(1), stride(wide), stride(wide * static_cast<std::size_t>(layers[l].size[1])), 0}});
    }
}

void LevelBuilder::build_dense(Level& level) const {
    std::vector<RawArray<std::uint32_t>> starts(slabs_);
    executor_(slabs_, [&](std::size_t slab) { starts[slab] = fill_slab(level, slab); });
    std::size_t before = 0;
    for (std::size_t slab = 0; slab < slabs_; ++slab) {
        if (before != 0) {
            const std::size_t first = slab * static_cast<std::size_t>(layers_) * strides_[slow_];
            const std::size_t last = std::min(first + static_cast<std::size_t>(layers_) * strides_[slow_], level.nodes_.size());
            for (std::size_t b = first; b < last; ++b) level.nodes_[b].first += static_cast<std::uint32_t>(before);
        }
        before += starts[slab].size();
    }
    level.starts_.reserve(before + 1);
    for (const auto& some : starts) level.starts_.insert(level.starts_.end(), some.begin(), some.end());
    level.starts_.push_back(static_cast<std::uint32_t>(references_));
}

void LevelBuilder::build_sparse(Level& level) const {
    // A cell's path through the tree, from the root: six bits for each layer under it.
    struct Reference {
        std::uint64_t path;
        std::uint32_t box;
        Ints cell;
    };
    std::vector<Reference> references;
    references.reserve(references_);
    for (std::uint32_t i = 0; i < boxes_.size(); ++i)
        each_cell(cells_of(boxes_[i]), [&](int x, int y, int z) {
            const Cell cell = {x, y, z};
            std::uint64_t path = 0;
            for (std::size_t k = 0; k < 3; ++k) path += static_cast<std::uint64_t>(cell[k] >> root_shift_) * strides_[k];
            for (int shift = root_shift_ - 2; shift >= 0; shift -= 2)
                path = path << 6 | static_cast<std::uint64_t>(
                                       std::countr_zero(Level::bit_of({cell[0] >> shift, cell[1] >> shift, cell[2] >> shift})));
            references.push_back({path, i, Ints{x, y, z, 0}});
        });
    // By the lower half of the path, then by the upper one; stably, so that those of a cell stay in the order of the boxes.
    RawArray<std::uint32_t> keys(references.size());
    RawArray<std::uint32_t> order(references.size());
    std::iota(order.begin(), order.end(), 0U);
    for (const int half : {0, 32}) {
        for (std::size_t r = 0; r < keys.size(); ++r) keys[r] = static_cast<std::uint32_t>(references[order[r]].path >> half);
        sort_by_key(keys, order, executor_);
    }
    for (std::uint32_t r = 0; r < references.size(); ++r) {
        const Reference& reference = references[order[r]];
        level.boxes_[r] = pack(boxes_[reference.box], reference.cell);
        level.ids_[r] = first_ + reference.box;
    }

    // From the bricks up: those of a layer by their paths.
    struct Branch {
        std::uint64_t path;
        Node node;
    };
    const auto join = [](std::vector<Branch>& branches, std::uint64_t path, std::size_t child) {
        if (branches.empty() || branches.back().path != path >> 6) branches.push_back({path >> 6, {0, static_cast<std::uint32_t>(child)}});
        branches.back().node.parts |= std::uint64_t{1} << (path & 63);
    };
    std::vector<std::vector<Branch>> layers(1);
    for (std::size_t r = 0; r < references.size(); ++r) {
        const std::uint64_t path = references[order[r]].path;
        if (r > 0 && path == references[order[r - 1]].path) continue;
        join(layers[0], path, level.starts_.size());
        level.starts_.push_back(static_cast<std::uint32_t>(r));
    }
    for (int shift = 2; shift < root_shift_; shift += 2) {
        std::vector<Branch> above;
        for (std::size_t i = 0; i < layers.back().size(); ++i) join(above, layers.back()[i].path, i);
        layers.push_back(std::move(above));
    }
    // The last layer is the roots': its paths are their places, and it does not hold the empty ones.
    for (const Branch& root : layers.back()) level.nodes_[root.path] = root.node;
    for (std::size_t layer = layers.size() - 1; layer-- > 0;) {
        const std::size_t before = level.nodes_.size();
        // The nodes of the layer above were given places from 0 on.
        const std::size_t above = layer + 2 == layers.size() ? 0 : before - layers[layer + 1].size();
        for (std::size_t i = above; i < before; ++i) level.nodes_[i].first += static_cast<std::uint32_t>(before);
        for (const Branch& branch : layers[layer]) level.nodes_.push_back(branch.node);
    }
    level.nodes_.shrink_to_fit();
    level.starts_.push_back(static_cast<std::uint32_t>(references_));
    level.starts_.shrink_to_fit();
}

Level LevelBuilder::build() {
    Level level;
    level.raster_ = raster_;
    level.references_ = references_;
    level.first_id_ = first_;
    level.nodes_.resize(strides_[slow_] * static_cast<std::size_t>(roots_[slow_]));
    level.boxes_ = RawArray<PackedBox>(references_ + Level::k_beyond);
    std::fill_n(level.boxes_.data() + references_, Level::k_beyond, 0);
    level.ids_ = RawArray<std::uint32_t>(references_ + Level::k_beyond);
    std::fill_n(level.ids_.data() + references_, Level::k_beyond, 0);
    if (root_shift_ == 2) {
        sort_by_slab();
        build_dense(level);
    } else {
        build_sparse(level);
    }
    build_tops(level);
    for (std::size_t k = 0; k < 3; ++k) {
        level.packed_.half_low[k] = raster_.half_low(k);
        level.packed_.scale[k] = raster_.scale(k);
        level.packed_.most[k] = raster_.most(k);
        level.packed_.cells[k] = raster_.cells()[k];
        level.packed_.strides[k] = static_cast<std::uint32_t>(strides_[k]);  // of fewer roots than triangles
    }
    level.packed_.nodes = level.nodes_.data();
    level.packed_.starts = level.starts_.data();
    level.packed_.boxes = level.boxes_.data();
    level.packed_.ids = level.ids_.data();
    level.packed_.root_shift = root_shift_;
    level.packed_.tops = level.tops_.data();
    level.packed_.top_count = static_cast<int>(level.tops_.size());
    return level;
}

}  // namespace pierce::detail
