// The façade of batches: parts for the executor, each in standard arithmetic.
#include <algorithm>

#include <environment.h>
#include <query/batch_sizes.h>
#include <query/collision_mesh_impl.h>
#include <query/engine.h>
#include <query/parts.h>
#include <query/sinks.h>

namespace pierce {

using namespace detail;

namespace {

/// What single calls count before they find that nothing is asked. Returns how many queries are not valid.
template <class Scalar>
std::size_t count_only(const Ways<Scalar>& ways, const QueryOptions& options) {
    const StandardArithmetic standard;
    std::size_t invalid = 0;
    for (std::size_t i = 0; i < ways.size(); ++i)
        if (!ways.is_valid(i)) ++invalid;
    if (options.counters != nullptr) add(*options.counters, {.queries = ways.size()});
    return invalid;
}

template <class Impl, class Scalar>
std::size_t all_first(const Impl& impl, const Ways<Scalar>& ways, const HitsOut<Scalar>& out,
                      const QueryOptions& options, const Executor& executor) {
    const auto count_invalid = [&](std::size_t count) { impl.count_invalid(count); };
    if (asks_nothing(options)) {
        with_sink(out, [&](const auto& sink) {
            for (std::size_t i = 0; i < ways.size(); ++i) sink.clear(i);
        });
        count_invalid(count_only(ways, options));
        return 0;
    }
    return in_parts(ways.size(), options.counters, executor, count_invalid,
                    [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
                        return detail::first_hits(impl.scene, ways, first, last, out, options, counters, invalid);
                    });
}

template <class Impl, class Scalar>
std::size_t all_any(const Impl& impl, const Ways<Scalar>& ways, std::span<std::uint8_t> out,
                    const QueryOptions& options, const Executor& executor) {
    const auto count_invalid = [&](std::size_t count) { impl.count_invalid(count); };
    if (asks_nothing(options)) {
        std::fill(out.begin(), out.end(), std::uint8_t{0});
        count_invalid(count_only(ways, options));
        return 0;
    }
    return in_parts(ways.size(), options.counters, executor, count_invalid,
                    [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
                        return detail::any_hits(impl.scene, ways, first, last, out.data(), options, counters, invalid);
                    });
}

}  // namespace

template <class Scalar>
std::size_t CollisionMesh<Scalar>::first_hits(const Segments<Scalar>& segments, const HitsOut<Scalar>& out,
                                              const QueryOptions& options, const Executor& executor) const {
    check_sizes("first_hits", segments, size_of(out));
    return all_first<Impl, Scalar>(*impl_, segments, out, options, executor);
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::sweeps(const Segments<Scalar>& steps, const HitsOut<Scalar>& out,
                                          const QueryOptions& options, const Executor& executor) const {
    check_sizes("sweeps", steps, size_of(out));
    return all_first<Impl, Scalar>(*impl_, steps, out, options, executor);
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::any_hits(const Segments<Scalar>& segments, std::span<std::uint8_t> out,
                                            const QueryOptions& options, const Executor& executor) const {
    check_sizes("any_hits", segments, out.size());
    return all_any<Impl, Scalar>(*impl_, segments, out, options, executor);
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::first_hits_of_rays(const Rays<Scalar>& rays, const HitsOut<Scalar>& out,
                                                      const QueryOptions& options, const Executor& executor) const {
    check_sizes("first_hits", rays, size_of(out));
    return all_first<Impl, Scalar>(*impl_, rays, out, options, executor);
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::any_hits_of_rays(const Rays<Scalar>& rays, std::span<std::uint8_t> out,
                                                    const QueryOptions& options, const Executor& executor) const {
    check_sizes("any_hits", rays, out.size());
    return all_any<Impl, Scalar>(*impl_, rays, out, options, executor);
}

#define PIERCE_BATCHES(Scalar)                                                                                  \
    template std::size_t CollisionMesh<Scalar>::first_hits(const Segments<Scalar>&, const HitsOut<Scalar>&,     \
                                                           const QueryOptions&, const Executor&) const;         \
    template std::size_t CollisionMesh<Scalar>::sweeps(const Segments<Scalar>&, const HitsOut<Scalar>&,         \
                                                       const QueryOptions&, const Executor&) const;             \
    template std::size_t CollisionMesh<Scalar>::any_hits(const Segments<Scalar>&, std::span<std::uint8_t>,      \
                                                         const QueryOptions&, const Executor&) const;           \
    template std::size_t CollisionMesh<Scalar>::first_hits_of_rays(const Rays<Scalar>&, const HitsOut<Scalar>&, \
                                                                   const QueryOptions&, const Executor&) const; \
    template std::size_t CollisionMesh<Scalar>::any_hits_of_rays(const Rays<Scalar>&, std::span<std::uint8_t>,  \
                                                                 const QueryOptions&, const Executor&) const
PIERCE_BATCHES(float);
PIERCE_BATCHES(double);
#undef PIERCE_BATCHES

}  // namespace pierce
