// Many queries at once: some are kept under way, and each waits for its next piece of memory while the others work.
//
// What a query needs comes in steps, each at an address that only the step before knows: the cell's place, its boxes, the triangles that
// they leave. A single query waits for memory at each. Here some queries take a step one after the other, each asking for what its next
// one reads (group prefetching: Chen, Ailamaki, Gibbons and Mowry 2004). Short segments only: others have no such steps in common and are asked
// singly. The steps are those of `traverse`, so the answers are the same bits.
#pragma once

#include <query/answer.h>

namespace pierce::detail {

/// Queries of a group: enough to cover the latency of main memory. Measured: tests/bench/run.
constexpr std::size_t k_group = 16;

/// A query of a group.
template <class Scalar, class Collector>
struct Query {
    std::size_t number;
    const Path path;
    Search<Scalar> search;
    Collector collector;
    Shortlist shortlist{nullptr};
    std::uint32_t listed = 0;  ///< by its cells
    bool alone = false;        ///< not short, or with too many cells: asked singly

    template <class Make>
    Query(const Scene<Scalar>& scene, std::size_t number_, const Path& path_, Sides sides, Make&& make)
        : number(number_), path(path_), search(scene, path, sides), collector(make(path)) {}
    Query(const Query&) = delete;
    Query& operator=(const Query&) = delete;
};

/// The queries that are under way, step by step.
template <class Scalar, class Collector>
class Group {
  public:
    explicit Group(const Scene<Scalar>& scene) : scene_(scene) {}

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] Query<Scalar, Collector>& operator[](std::size_t i) { return *queries_[i]; }
    template <class Make>
    void add(std::size_t number, const Path& path, Sides sides, Make&& make) {
        queries_[size_++].emplace(scene_, number, path, sides, make);
    }
    void clear() { size_ = 0; }

    /// And asks memory for their boxes.
    void find_cells() {
        cell_count_ = 0;
        for (std::uint32_t i = 0; i < size_; ++i) {
            Query<Scalar, Collector>& query = *queries_[i];
            const Path& path = query.path;
            const std::size_t before = cell_count_;
            for (const Level& level : scene_.grid.levels()) {
                std::array<Stop, k_most_block> stops;
                const int found = scene_.backend->block(level.packed(), path.from.data(), path.to.data(), stops.data());
                if (found < 0 || cell_count_ - before + static_cast<std::size_t>(found) > k_most_cells) {
                    query.alone = true;
                    cell_count_ = before;
                    break;
                }
                for (int c = 0; c < found; ++c) {
                    const Stop& stop = stops[static_cast<std::size_t>(c)];
                    const Range range = level.range(stop.number);
                    fetch(level, range);
                    query.listed += range.end - range.begin;
                    cells_[cell_count_++] = {&level, stop.cull, range, i};
                }
            }
        }
    }

    void cull_boxes(QueryCounters& counters) {
        std::uint32_t* out = ids_.data();
        for (std::size_t c = 0; c < cell_count_;) {
            const std::uint32_t number = cells_[c].query;
            Query<Scalar, Collector>& query = *queries_[number];
            query.alone = query.listed > Shortlist::k_room;
            query.shortlist = Shortlist(out);
            for (; c < cell_count_ && cells_[c].query == number; ++c) {
                if (query.alone) continue;
                const CellOfQuery& cell = cells_[c];
                const Level& level = *cell.level;
                const unsigned left = scene_.backend->cull(level.boxes(cell.range.begin), level.ids(cell.range.begin),
                                                           cell.range.end - cell.range.begin, cell.cull.above, cell.cull.seen, out);
                for (unsigned k = 0; k < left; ++k) {
                    const Scalar* corners = &scene_.coordinates[9 * std::size_t{out[k]}];
                    __builtin_prefetch(corners);
                    __builtin_prefetch(corners + 8);
                }
                out += left;
                query.shortlist.count += left;
                ++counters.cells;
            }
            out += k_beyond_ids;
        }
    }

  private:
    static constexpr std::size_t k_most_cells = 2 * k_most_block;  ///< of a query, in all levels

    struct CellOfQuery {
        const Level* level;
        Cull cull;
        Range range;
        std::uint32_t query;
    };

    // As far as most cells' go.
    static void fetch(const Level& level, const Range& range) {
        const auto* boxes = reinterpret_cast<const char*>(level.boxes(range.begin));
        for (std::size_t at = 0; at < 4; ++at) __builtin_prefetch(boxes + 64 * at);
        const auto* ids = reinterpret_cast<const char*>(level.ids(range.begin));
        for (std::size_t at = 0; at < 2; ++at) __builtin_prefetch(ids + 64 * at);
    }

    const Scene<Scalar>& scene_;
    std::size_t size_ = 0;
    std::size_t cell_count_ = 0;
    std::array<std::optional<Query<Scalar, Collector>>, k_group> queries_;
    std::array<CellOfQuery, k_most_cells * k_group> cells_;
    std::array<std::uint32_t, k_group * (Shortlist::k_room + k_beyond_ids)> ids_;
};

/// Takes all queries through the rooms. `start(i, path)` gives the path of query i, or says that it has no meaning and is not to be asked;
/// `make(path)` its collector; `done(i, query or null)` gets what came of it.
template <class Kernel, class Collector, class Scalar, class Start, class Make, class Done>
void fly(const Scene<Scalar>& scene, std::size_t count, const QueryOptions& options, QueryCounters& counters, Start&& start,
         Make&& make, Done&& done) {
    Group<Scalar, Collector> group(scene);
    for (std::size_t next = 0; next < count;) {
        group.clear();
        for (Path path; next < count && group.size() < k_group; ++next) {
            if (start(next, path)) group.add(next, path, options.sides, make);
            else done(next, static_cast<Query<Scalar, Collector>*>(nullptr));
        }
        group.find_cells();
        group.cull_boxes(counters);
        for (std::size_t i = 0; i < group.size(); ++i) {
            Query<Scalar, Collector>& query = group[i];
            Ids ids;
            if (query.alone) {
                query.shortlist = Shortlist(ids.data());
                traverse<Kernel>(query.search, query.shortlist, options, counters, query.collector);
            } else if (query.shortlist.count > 0) {
                test_triangles<Kernel>(query.search, query.shortlist.ids, query.shortlist.count, options, counters, query.collector);
            }
            done(query.number, &query);
        }
    }
}

}  // namespace pierce::detail
