// The façade of batches: parts for the executor, each in standard arithmetic.
#include <stdexcept>

#include <environment.h>
#include <query/collision_mesh_impl.h>
#include <query/engine.h>
#include <query/parts.h>

namespace pierce {

using namespace detail;

namespace {

/// What single calls count before they find that nothing is asked.
template <class Scalar>
void count_only(const Ends<Scalar>& ends, std::size_t count, const BatchOptions& options,
                std::atomic<std::uint64_t>& invalid_queries) {
    const StandardArithmetic standard;
    std::uint64_t invalid = 0;
    for (std::size_t i = 0; i < count; ++i)
        if (!is_finite(ends, i)) ++invalid;
    invalid_queries.fetch_add(invalid, std::memory_order_relaxed);
    if (options.counters != nullptr) add(*options.counters, {.queries = count});
}

void check_sizes(std::size_t from, std::size_t to, std::size_t out) {
    if (from != to || from != out)
        throw std::invalid_argument("a batch of " + std::to_string(from) + " starts, " + std::to_string(to) +
                                    " ends and " + std::to_string(out) + " answers: they must be as many");
}

template <class Scalar, class Answer>
std::size_t all_first(const Scene<Scalar>& scene, const Ends<Scalar>& ends, std::span<std::optional<Answer>> out,
                      const BatchOptions& options, std::atomic<std::uint64_t>& invalid_queries) {
    if (asks_nothing(options)) {
        std::fill(out.begin(), out.end(), std::nullopt);
        count_only(ends, out.size(), options, invalid_queries);
        return 0;
    }
    return in_parts(out.size(), options, invalid_queries,
                    [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
                        return detail::first_hits(scene, ends, first, last, out.data(), options, counters, invalid);
                    });
}

template <class Scalar>
std::size_t all_any(const Scene<Scalar>& scene, const Ends<Scalar>& ends, std::span<std::uint8_t> out,
                    const BatchOptions& options, std::atomic<std::uint64_t>& invalid_queries) {
    if (asks_nothing(options)) {
        std::fill(out.begin(), out.end(), std::uint8_t{0});
        count_only(ends, out.size(), options, invalid_queries);
        return 0;
    }
    return in_parts(out.size(), options, invalid_queries,
                    [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
                        return detail::any_hits(scene, ends, first, last, out.data(), options, counters, invalid);
                    });
}

template <class Scalar>
Ends<Scalar> ends_of(std::span<const Segment<Scalar>> segments) {
    static_assert(sizeof(Segment<Scalar>) == 6 * sizeof(Scalar));
    if (segments.empty()) return {};
    return {segments[0].from.data(), segments[0].to.data(), 6, 6};
}

template <class Scalar>
Ends<Scalar> ends_of(const Points<Scalar>& from, const Points<Scalar>& to) {
    return {from.data(), to.data(), from.outerStride(), to.outerStride()};
}

std::size_t columns(const auto& points) { return static_cast<std::size_t>(points.cols()); }

}  // namespace

template <class Scalar>
std::size_t CollisionMesh<Scalar>::first_hits(std::span<const Segment<Scalar>> segments,
                                              std::span<std::optional<Hit<Scalar>>> out,
                                              const BatchOptions& options) const {
    check_sizes(segments.size(), segments.size(), out.size());
    return all_first(impl_->scene, ends_of(segments), out, options, impl_->invalid_queries);
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::any_hits(std::span<const Segment<Scalar>> segments, std::span<std::uint8_t> out,
                                            const BatchOptions& options) const {
    check_sizes(segments.size(), segments.size(), out.size());
    return all_any(impl_->scene, ends_of(segments), out, options, impl_->invalid_queries);
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::sweep_points(std::span<const Vec3<Scalar>> from, std::span<const Vec3<Scalar>> to,
                                                std::span<std::optional<SweepHit<Scalar>>> out,
                                                const BatchOptions& options) const {
    check_sizes(from.size(), to.size(), out.size());
    static_assert(sizeof(Vec3<Scalar>) == 3 * sizeof(Scalar));
    if (out.empty()) return 0;
    return all_first(impl_->scene, Ends<Scalar>{from[0].data(), to[0].data(), 3, 3}, out, options,
                     impl_->invalid_queries);
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::first_hits(const Points<Scalar>& from, const Points<Scalar>& to,
                                              std::span<std::optional<Hit<Scalar>>> out,
                                              const BatchOptions& options) const {
    check_sizes(columns(from), columns(to), out.size());
    return all_first(impl_->scene, ends_of<Scalar>(from, to), out, options, impl_->invalid_queries);
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::any_hits(const Points<Scalar>& from, const Points<Scalar>& to,
                                            std::span<std::uint8_t> out, const BatchOptions& options) const {
    check_sizes(columns(from), columns(to), out.size());
    return all_any(impl_->scene, ends_of<Scalar>(from, to), out, options, impl_->invalid_queries);
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::sweep_points(const Points<Scalar>& from, const Points<Scalar>& to,
                                                std::span<std::optional<SweepHit<Scalar>>> out,
                                                const BatchOptions& options) const {
    check_sizes(columns(from), columns(to), out.size());
    return all_first(impl_->scene, ends_of<Scalar>(from, to), out, options, impl_->invalid_queries);
}

template std::size_t CollisionMesh<float>::first_hits(std::span<const Segment<float>>,
                                                      std::span<std::optional<Hit<float>>>, const BatchOptions&) const;
template std::size_t CollisionMesh<float>::any_hits(std::span<const Segment<float>>, std::span<std::uint8_t>,
                                                    const BatchOptions&) const;
template std::size_t CollisionMesh<float>::sweep_points(std::span<const Vec3<float>>, std::span<const Vec3<float>>,
                                                        std::span<std::optional<SweepHit<float>>>,
                                                        const BatchOptions&) const;
template std::size_t CollisionMesh<float>::first_hits(const Points<float>&, const Points<float>&,
                                                      std::span<std::optional<Hit<float>>>, const BatchOptions&) const;
template std::size_t CollisionMesh<float>::any_hits(const Points<float>&, const Points<float>&, std::span<std::uint8_t>,
                                                    const BatchOptions&) const;
template std::size_t CollisionMesh<float>::sweep_points(const Points<float>&, const Points<float>&,
                                                        std::span<std::optional<SweepHit<float>>>,
                                                        const BatchOptions&) const;

template std::size_t CollisionMesh<double>::first_hits(std::span<const Segment<double>>,
                                                       std::span<std::optional<Hit<double>>>,
                                                       const BatchOptions&) const;
template std::size_t CollisionMesh<double>::any_hits(std::span<const Segment<double>>, std::span<std::uint8_t>,
                                                     const BatchOptions&) const;
template std::size_t CollisionMesh<double>::sweep_points(std::span<const Vec3<double>>, std::span<const Vec3<double>>,
                                                         std::span<std::optional<SweepHit<double>>>,
                                                         const BatchOptions&) const;
template std::size_t CollisionMesh<double>::first_hits(const Points<double>&, const Points<double>&,
                                                       std::span<std::optional<Hit<double>>>,
                                                       const BatchOptions&) const;
template std::size_t CollisionMesh<double>::any_hits(const Points<double>&, const Points<double>&,
                                                     std::span<std::uint8_t>, const BatchOptions&) const;
template std::size_t CollisionMesh<double>::sweep_points(const Points<double>&, const Points<double>&,
                                                         std::span<std::optional<SweepHit<double>>>,
                                                         const BatchOptions&) const;

}  // namespace pierce
