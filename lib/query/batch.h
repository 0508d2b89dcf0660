// Many queries at once: a few are kept under way, each waiting for its next piece of memory while the others work.
//
// What a query needs comes in steps, each at an address that only the step before knows: the cell's place, its boxes, the triangles that
// they leave. A single query waits for memory at each. Here all queries under way take a step, ask for what the next one reads, and let
// the others go on: as in asynchronous memory access chaining (Kocberber, Falsafi and Grot 2015), but with all of them at the same step,
// so that the branches are those of loops. The steps are those of `traverse`, so the answers are the same bits.
#pragma once

#include <query/answer.h>

namespace pierce::detail {

/// A query under way.
template <class Scalar, class Collector>
struct Flight {
    std::size_t number;
    Search<Scalar> search;
    Cells<Scalar> cells;
    Collector collector;
    Shortlist shortlist;
    std::array<Range, k_most_block> ranges;
    Ids ids;
    unsigned count = 0;

    template <class MakeCollector>
    Flight(const Scene<Scalar>& scene, std::size_t number_, const Path& path, Sides sides, MakeCollector&& make)
        : number(number_), search(scene, path, sides), cells(search, Collector::once), collector(make(search.path)) {}
    Flight(const Flight&) = delete;
    Flight& operator=(const Flight&) = delete;
};

inline void prefetch(const void* from, std::size_t bytes) {
    constexpr std::size_t k_line = 64;
    const auto* address = static_cast<const char*>(from);
    for (std::size_t at = 0; at < bytes; at += k_line) __builtin_prefetch(address + at);
    __builtin_prefetch(address + bytes - 1);
}

/// Enough to cover the latency of main memory by the work of the others (measured: 8 are too few, beyond 16 nothing is won).
constexpr std::size_t k_flights = 16;

/// Takes all queries through the rooms. `start(i, path)` gives the path of query i, or says that it has no meaning and is not to be asked;
/// `make(path)` its collector; `done(i, query or null)` gets what came of it.
template <class Kernel, class Collector, class Scalar, class Start, class Make, class Done>
void fly(const Scene<Scalar>& scene, std::size_t count, const QueryOptions& options, QueryCounters& counters, Start&& start,
         Make&& make, Done&& done) {
    using Query = Flight<Scalar, Collector>;
    const Backend& backend = *scene.backend;
    std::array<std::optional<Query>, k_flights> places;
    std::array<Query*, k_flights> active{};
    std::size_t under_way = 0;
    std::size_t next = 0;
    const auto depart = [&](std::optional<Query>& place) {
        for (Path path; next < count; ++next) {
            if (start(next, path)) {
                place.emplace(scene, next++, path, options.sides, make);
                return true;
            }
            done(next, static_cast<Query*>(nullptr));
        }
        return false;
    };
    for (auto& place : places)
        if (depart(place)) active[under_way++] = &*place;
    while (under_way > 0) {
        for (std::size_t i = 0; i < under_way;) {
            Query& query = *active[i];
            if (query.cells.next(std::min(query.collector.limit(), options.max_fraction))) {
                ++i;
                if (query.cells.all()) continue;
                counters.cells += query.cells.stops().size();
                for (const Stop& stop : query.cells.stops()) __builtin_prefetch(query.cells.level().start(stop.number));
                continue;
            }
            done(query.number, &query);
            auto& place = *std::find_if(places.begin(), places.end(), [&](const auto& p) { return p && &*p == &query; });
            if (!depart(place)) active[i] = active[--under_way];
        }
        for (std::size_t i = 0; i < under_way; ++i) {
            Query& query = *active[i];
            if (query.cells.all()) continue;
            const Level& level = query.cells.level();
            for (std::size_t c = 0; c < query.cells.stops().size(); ++c) {
                const Range range = query.ranges[c] = level.range(query.cells.stops()[c].number);
                const std::size_t some = std::min(range.end - range.begin, k_most_ids);
                prefetch(level.boxes(range.begin), some * sizeof(PackedBox));
                prefetch(level.ids(range.begin), some * sizeof(std::uint32_t));
            }
        }
        const auto test = [&](Query& query) {
            query.shortlist.add(query.ids.data(), query.count, query.cells.covered());
            test_triangles<Kernel>(query.search, query.ids.data(), query.count, options, counters, query.collector);
            query.count = 0;
        };
        for (std::size_t i = 0; i < under_way; ++i) {
            Query& query = *active[i];
            if (query.cells.all()) continue;
            const Level& level = query.cells.level();
            for (std::size_t c = 0; c < query.cells.stops().size(); ++c) {
                const Cull& cull = query.cells.stops()[c].cull;
                for (std::uint32_t begin = query.ranges[c].begin; begin < query.ranges[c].end;) {
                    const unsigned some = std::min(query.ranges[c].end - begin, k_most_ids);
                    if (query.count + some > k_most_ids) test(query);
                    query.count += backend.cull(level.boxes(begin), level.ids(begin), some, cull.above, cull.seen,
                                                query.ids.data() + query.count);
                    begin += some;
                }
            }
            for (unsigned k = 0; k < query.count; ++k) prefetch(&scene.coordinates[9 * std::size_t{query.ids[k]}], 9 * sizeof(Scalar));
        }
        for (std::size_t i = 0; i < under_way; ++i) {
            Query& query = *active[i];
            if (!query.cells.all()) {
                test(query);
                continue;
            }
            each_triangle(scene, query.cells.level().first_id(), [&](std::uint32_t* ids, unsigned some) {
                query.shortlist.add(ids, some, true);
                test_triangles<Kernel>(query.search, ids, some, options, counters, query.collector);
            });
        }
    }
}

}  // namespace pierce::detail
