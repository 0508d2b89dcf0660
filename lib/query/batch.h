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
    Range range;
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
                place->search.probe.unit = Kernel::unit;
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
                ++counters.cells;
                if (query.cells.all()) {
                    ++i;
                    continue;
                }
                __builtin_prefetch(query.cells.stop().level->start(query.cells.stop().number));
                ++i;
                continue;
            }
            done(query.number, &query);
            auto& place = *std::find_if(places.begin(), places.end(), [&](const auto& p) { return p && &*p == &query; });
            if (!depart(place)) active[i] = active[--under_way];
        }
        for (std::size_t i = 0; i < under_way; ++i) {
            Query& query = *active[i];
            if (query.cells.all()) continue;
            const Stop& stop = query.cells.stop();
            query.range = stop.level->range(stop.number);
            const std::size_t some = std::min(query.range.end - query.range.begin, k_most_ids);
            prefetch(stop.level->boxes(query.range.begin), some * sizeof(PackedBox));
            prefetch(stop.level->ids(query.range.begin), some * sizeof(std::uint32_t));
        }
        const auto cull = [&](Query& query) {
            const Stop& stop = query.cells.stop();
            const unsigned some = std::min(query.range.end - query.range.begin, k_most_ids);
            query.count = backend.cull(stop.level->boxes(query.range.begin), stop.level->ids(query.range.begin), some,
                                       stop.cull.above, stop.cull.seen, query.ids.data());
            query.range.begin += some;
            query.shortlist.add(query.ids.data(), query.count, query.cells.covered());
        };
        for (std::size_t i = 0; i < under_way; ++i) {
            Query& query = *active[i];
            if (query.cells.all()) continue;
            cull(query);
            for (unsigned k = 0; k < query.count; ++k)
                prefetch(&scene.coordinates[9 * std::size_t{query.ids[k]}], 9 * sizeof(Scalar));
        }
        for (std::size_t i = 0; i < under_way; ++i) {
            Query& query = *active[i];
            if (query.cells.all()) {
                each_triangle(scene, [&](const std::uint32_t* ids, unsigned some) {
                    query.shortlist.add(ids, some, true);
                    test_triangles<Kernel>(query.search, ids, some, options, counters, query.collector);
                });
                continue;
            }
            for (;;) {
                test_triangles<Kernel>(query.search, query.ids.data(), query.count, options, counters, query.collector);
                if (query.range.begin == query.range.end) break;
                cull(query);  // of a crowded cell
            }
        }
    }
}

}  // namespace pierce::detail
