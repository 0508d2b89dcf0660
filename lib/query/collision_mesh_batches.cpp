// The façade of batches: parts for the executor, each in standard arithmetic.
#include <algorithm>
#include <stdexcept>
#include <string>

#include <environment.h>
#include <query/collision_mesh_impl.h>
#include <query/engine.h>
#include <query/sinks.h>

namespace pierce {

using namespace detail;

namespace {

// Large enough for the queries under way to be many at almost all times, small enough to be shared evenly.
constexpr std::size_t k_part = 1024;

void add(QueryCounters& to, const QueryCounters& from) {
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
/// `count_invalid(number)` counts queries that are not finite.
template <class CountInvalid, class Part>
std::size_t in_parts(std::size_t count, const QueryOptions& options, const Executor& executor,
                     CountInvalid&& count_invalid, Part&& part) {
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
        if (options.counters != nullptr) add(*options.counters, counters);
    });
    return hits;
}

// Not inlined: the compiler would move the comparison to where the caller's arithmetic is back (environment.h).
[[gnu::noinline]] bool is_limit(const double& max_fraction) { return max_fraction >= 0; }

bool asks_nothing(const QueryOptions& options) {
    const StandardArithmetic standard;  // NaN is no reason to trap
    return !is_limit(options.max_fraction);
}

/// What single calls count before they find that nothing is asked. Returns how many queries are not finite.
template <class Scalar>
std::size_t count_only(const Segments<Scalar>& segments, const QueryOptions& options) {
    const StandardArithmetic standard;
    std::size_t invalid = 0;
    for (std::size_t i = 0; i < segments.size(); ++i)
        if (!is_finite(segments, i)) ++invalid;
    if (options.counters != nullptr) add(*options.counters, {.queries = segments.size()});
    return invalid;
}

template <class Scalar>
void check_sizes(const char* call, const Segments<Scalar>& segments, std::size_t out) {
    const std::size_t starts = segments.starts().size();
    const std::size_t ends = segments.ends().size();
    if (starts != ends)
        throw std::invalid_argument(std::string(call) + ": " + std::to_string(starts) + " starts and " +
                                    std::to_string(ends) + " ends");
    if (starts != out)
        throw std::invalid_argument(std::string(call) + ": " + std::to_string(starts) + " segments and " +
                                    std::to_string(out) + " places for answers");
}

template <class Impl, class Scalar>
std::size_t all_first(const char* call, const Impl& impl, const Segments<Scalar>& segments, const HitsOut<Scalar>& out,
                      const QueryOptions& options, const Executor& executor) {
    check_sizes(call, segments, size_of(out));
    const auto count_invalid = [&](std::size_t count) { impl.count_invalid(count); };
    if (asks_nothing(options)) {
        with_sink(out, [&](const auto& sink) {
            for (std::size_t i = 0; i < segments.size(); ++i) sink.clear(i);
        });
        count_invalid(count_only(segments, options));
        return 0;
    }
    return in_parts(segments.size(), options, executor, count_invalid,
                    [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
                        return detail::first_hits(impl.scene, segments, first, last, out, options, counters, invalid);
                    });
}

}  // namespace

template <class Scalar>
std::size_t CollisionMesh<Scalar>::first_hits(const Segments<Scalar>& segments, const HitsOut<Scalar>& out,
                                              const QueryOptions& options, const Executor& executor) const {
    return all_first("first_hits", *impl_, segments, out, options, executor);
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::sweeps(const Segments<Scalar>& steps, const HitsOut<Scalar>& out,
                                          const QueryOptions& options, const Executor& executor) const {
    return all_first("sweeps", *impl_, steps, out, options, executor);
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::any_hits(const Segments<Scalar>& segments, std::span<std::uint8_t> out,
                                            const QueryOptions& options, const Executor& executor) const {
    check_sizes("any_hits", segments, out.size());
    const auto count_invalid = [&](std::size_t count) { impl_->count_invalid(count); };
    if (asks_nothing(options)) {
        std::fill(out.begin(), out.end(), std::uint8_t{0});
        count_invalid(count_only(segments, options));
        return 0;
    }
    return in_parts(segments.size(), options, executor, count_invalid,
                    [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
                        return detail::any_hits(impl_->scene, segments, first, last, out.data(), options, counters,
                                                invalid);
                    });
}

template std::size_t CollisionMesh<float>::first_hits(const Segments<float>&, const HitsOut<float>&,
                                                      const QueryOptions&, const Executor&) const;
template std::size_t CollisionMesh<float>::sweeps(const Segments<float>&, const HitsOut<float>&, const QueryOptions&,
                                                  const Executor&) const;
template std::size_t CollisionMesh<float>::any_hits(const Segments<float>&, std::span<std::uint8_t>,
                                                    const QueryOptions&, const Executor&) const;
template std::size_t CollisionMesh<double>::first_hits(const Segments<double>&, const HitsOut<double>&,
                                                       const QueryOptions&, const Executor&) const;
template std::size_t CollisionMesh<double>::sweeps(const Segments<double>&, const HitsOut<double>&, const QueryOptions&,
                                                   const Executor&) const;
template std::size_t CollisionMesh<double>::any_hits(const Segments<double>&, std::span<std::uint8_t>,
                                                     const QueryOptions&, const Executor&) const;

}  // namespace pierce
