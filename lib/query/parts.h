// Batches in parts for the executor, each in standard arithmetic.
#pragma once

#include <algorithm>
#include <atomic>

#include <environment.h>
#include <pierce/executor.h>
#include <pierce/options.h>

namespace pierce::detail {

// Large enough for the queries under way to be many at almost all times, small enough to be shared evenly.
constexpr std::size_t k_part = 1024;

inline void add(QueryCounters& to, const QueryCounters& from) {
    const auto atomic_add = [](std::uint64_t& x, std::uint64_t y) {
        std::atomic_ref(x).fetch_add(y, std::memory_order_relaxed);
    };
    atomic_add(to.queries, from.queries);
    atomic_add(to.nodes, from.nodes);
    atomic_add(to.clusters, from.clusters);
    atomic_add(to.triangles, from.triangles);
    atomic_add(to.exact_decisions, from.exact_decisions);
    atomic_add(to.exact_orders, from.exact_orders);
    atomic_add(to.exact_values, from.exact_values);
    atomic_add(to.exact_sides, from.exact_sides);
    atomic_add(to.retreats, from.retreats);
}

/// Calls `part(first, last, counters, invalid)`, which returns its number of hits, for all parts of `count` queries.
/// `count_invalid(number)` counts queries that are not finite. `given` may be null.
template <class CountInvalid, class Part>
std::size_t in_parts(std::size_t count, QueryCounters* given, const Executor& executor, CountInvalid&& count_invalid,
                     Part&& part) {
    std::atomic<std::size_t> hits = 0;
    executor((count + k_part - 1) / k_part, [&](std::size_t i) {
        const std::size_t first = i * k_part;
        const std::size_t last = std::min(count, first + k_part);
        QueryCounters counters;
        counters.queries = last - first;
        std::size_t invalid = 0;
        const StandardArithmetic standard;
        hits.fetch_add(part(first, last, counters, invalid), std::memory_order_relaxed);
        count_invalid(invalid);
        if (given != nullptr) add(*given, counters);
    });
    return hits;
}

// Not inlined: the compiler would move the comparison to where the caller's arithmetic is back (environment.h).
[[gnu::noinline]] inline bool is_limit(const double& max_fraction) { return max_fraction >= 0; }

/// Whether a limit leaves no hit to any query.
template <class Options>
[[nodiscard]] bool asks_nothing(const Options& options) {
    const StandardArithmetic standard;  // NaN is no reason to trap
    return !is_limit(options.max_fraction);
}

}  // namespace pierce::detail
