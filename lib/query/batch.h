// Many queries at once: they take each step together, and what one of them needs next is asked of memory while the others take theirs.
//
// What a query needs comes in steps, each at an address that only the step before knows: the cell's place, its boxes, the triangles that
// they leave. A single query waits for memory at each, and its branches are not foreseen. Here a step is a loop over some queries (group
// prefetching: Chen, Ailamaki, Gibbons and Mowry 2004), most of it in a kernel, and the triangles of all are refused side by side. Short
// segments only: others have no such steps in common and are asked singly. The steps are those of `traverse`, so the answers are
// the same bits, and what is counted does not depend on a query's neighbours.
#pragma once

#include <utility>

#include <query/answer.h>
#include <query/engine.h>

namespace pierce::detail {

/// A query that came near triangles, or is asked singly.
template <class Collector>
struct Query {
    const Path path;
    Collector collector;

    template <class MakePath, class Make>
    Query(MakePath&& make_path, Make&& make) : path(make_path()), collector(make(path)) {}
    Query(const Query&) = delete;
    Query& operator=(const Query&) = delete;
};

/// Up to `k_group` queries, step by step.
template <class Kernel, class Collector, class Scalar>
class Group {
  public:
    Group(const Scene<Scalar>& scene, const Ends<Scalar>& ends, const QueryOptions& options, QueryCounters& counters)
        : scene_(scene), kernels_(scene.backend->template of<Scalar>()), ends_(ends), options_(options), counters_(counters),
          probe_(make_probe<Scalar>(scene.scale, options.sides, Kernel::unit)) {}

    /// Takes queries from `first` on; those that are not finite count as `invalid`. `make(path)` gives a query's collector, `hit(i, query,
    /// list)` gets query number i if its collector has found something, and its shortlist. The last steps are left to
    /// the next call or to `finish`: while they are taken, memory brings what the next queries have asked for.
    template <class Make, class Hit>
    void take(std::size_t first, unsigned count, std::size_t& invalid, Make&& make, Hit&& hit) {
        const std::size_t first_before = std::exchange(first_, first);
        count_ = count;
        rays_before_.swap(rays_);
        find_cells(invalid);
        ask_for_boxes();
        finish(first_before, rays_before_, make, hit);
        cull_boxes();
        for (unsigned i = 0; i < count_; ++i) {
            if (looks_[i] != Look::alone) continue;
            Shortlist list;
            Query<Collector> query([&] { return path_of(first_ + i); }, make);
            Search<Scalar> search(scene_, query.path, options_.sides);
            traverse<Kernel>(search, options_, counters_, query.collector, list);
            if (query.collector.found()) hit(first_ + i, query, list);
        }
    }

    template <class Make, class Hit>
    void finish(Make&& make, Hit&& hit) {
        finish(first_, rays_, make, hit);
    }

  private:
    static constexpr unsigned k_most_cells = 2 * k_most_block;       ///< of a query, in all levels
    static constexpr unsigned k_most_pairs = k_group * k_room;
    using Rays = std::array<Ray<Scalar>, k_group>;

    Path path_of(std::size_t number) const {
        const auto at = static_cast<std::ptrdiff_t>(number);
        const auto point = [](const Scalar* x) {
            return Point{static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])};
        };
        return {point(ends_.from + at * ends_.from_stride), point(ends_.to + at * ends_.to_stride)};
    }

    // Level by level, and how many each query has.
    void find_cells(std::size_t& invalid) {
        cell_count_ = 0;
        looks_.fill(Look::seen);
        cells_of_.fill(0);
        std::array<Stop, k_group * k_most_block> stops;
        for (const Level& level : scene_.grid.levels()) {
            const unsigned found = kernels_.find(level.packed(), ends_, first_, count_, scene_.scale, stops.data(), looks_.data(), rays_.data());
            for (unsigned s = 0; s < found; ++s) {
                const Stop& stop = stops[s];
                if (++cells_of_[stop.query] > k_most_cells) looks_[stop.query] = Look::alone;
                else cells_[cell_count_++] = {&level, stop.number, stop.query, stop.cull};
            }
        }
        for (unsigned i = 0; i < count_; ++i) {
            if (scene_.grid.empty() && !is_finite(ends_, first_ + i)) looks_[i] = Look::invalid;
            if (looks_[i] == Look::invalid) ++invalid;
        }
    }

    // In the order of the queries, each one's in that of the levels.
    void ask_for_boxes() {
        std::array<unsigned, k_group> next;
        box_count_ = 0;
        for (unsigned i = 0; i < count_; ++i) {
            next[i] = box_count_;
            if (looks_[i] == Look::seen) box_count_ += cells_of_[i];
        }
        listed_.fill(0);
        for (unsigned c = 0; c < cell_count_; ++c) {
            const CellOfQuery& cell = cells_[c];
            if (looks_[cell.query] != Look::seen) continue;
            const Range range = cell.level->range(cell.number);
            fetch(*cell.level, range);
            listed_[cell.query] += range.end - range.begin;
            boxes_[next[cell.query]++] = {cell.level->boxes(range.begin), cell.level->ids(range.begin), range.end - range.begin, cell.query,
                                          cell.cull};
        }
    }

    // As far as most cells' go.
    static void fetch(const Level& level, const Range& range) {
        const auto* boxes = reinterpret_cast<const char*>(level.boxes(range.begin));
        for (std::size_t at = 0; at < 4; ++at) __builtin_prefetch(boxes + 64 * at);
        const auto* ids = reinterpret_cast<const char*>(level.ids(range.begin));
        for (std::size_t at = 0; at < 2; ++at) __builtin_prefetch(ids + 64 * at);
    }

    // Those of queries with more than there is room for are left out.
    void cull_boxes() {
        unsigned some = 0;
        for (unsigned b = 0; b < box_count_; ++b) {
            if (listed_[boxes_[b].query] > k_room) looks_[boxes_[b].query] = Look::alone;
            else boxes_[some++] = boxes_[b];
        }
        counters_.cells += some;
        pair_count_ = scene_.backend->cull_many(boxes_.data(), some, scene_.coordinates.data(), 9 * sizeof(Scalar), ids_.data(), queries_.data());
    }

    // The triangles that are certainly missed are refused for all queries side by side; the others in order, query by query.
    template <class Make, class Hit>
    void finish(std::size_t first, const Rays& rays, Make&& make, Hit&& hit) {
        const unsigned left =
            kernels_.refine_many(probe_, rays.data(), scene_.coordinates.data(), ids_.data(), queries_.data(), pair_count_, left_.data());
        counters_.triangles += pair_count_;
        for (unsigned k = 0; k < left;) {
            const std::uint32_t i = queries_[left_[k]];
            Query<Collector> query([&] { return path_of(first + i); }, make);
            Shortlist list;
            for (; k < left && queries_[left_[k]] == i; ++k) {
                const std::uint32_t triangle = ids_[left_[k]];
                list.add(&triangle, 1);
                test_triangle<Kernel>(scene_, query.path, triangle, options_, counters_, query.collector);
            }
            if (!query.collector.found()) continue;
            hit(first + i, query, list);
        }
        pair_count_ = 0;
    }

    struct CellOfQuery {
        const Level* level;
        std::uint32_t number;
        std::uint32_t query;
        Cull cull;
    };

    const Scene<Scalar>& scene_;
    const ScalarKernels<Scalar>& kernels_;
    const Ends<Scalar>& ends_;
    const QueryOptions& options_;
    QueryCounters& counters_;
    std::size_t first_ = 0;
    unsigned count_ = 0;
    unsigned cell_count_ = 0;
    unsigned box_count_ = 0;
    unsigned pair_count_ = 0;  ///< of triangles and the queries that came near them, in the queries' order
    std::array<Look, k_group> looks_;
    std::array<unsigned, k_group> cells_of_;
    std::array<std::uint32_t, k_group> listed_;  ///< by each query's cells
    const Probe<Scalar> probe_;
    Rays rays_;         ///< of the queries that have cells
    Rays rays_before_;  ///< those of the queries before them
    std::array<CellOfQuery, k_group * k_most_cells> cells_;
    std::array<Boxes, k_group * k_most_cells> boxes_;
    std::array<std::uint32_t, k_most_pairs + k_beyond_ids> ids_;
    std::array<std::uint32_t, k_most_pairs + k_beyond_ids> queries_;
    std::array<std::uint32_t, k_most_pairs> left_;
};

}  // namespace pierce::detail
