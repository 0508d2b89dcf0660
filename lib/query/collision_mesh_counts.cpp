// The façade of batches of counts and places, and of all hits as compressed rows.
#include <memory>

#include <chunks.h>
#include <cluster/sort_entries.h>
#include <environment.h>
#include <query/batch_sizes.h>
#include <query/collision_mesh_impl.h>
#include <query/count_batches.h>
#include <query/locate.h>
#include <query/parts.h>
#include <query/rows.h>

namespace pierce {

using namespace detail;

namespace {

/// Fewer points are not worth being sorted; so many are at a time.
constexpr std::size_t k_least_sorted = std::size_t{1} << 12;
constexpr std::size_t k_most_sorted = std::size_t{1} << 20;

/// Returns the number of points whose winding number is not 0.
template <class Impl, class Scalar, class Out>
std::size_t all_winding(const Impl& impl, const PointsView<Scalar>& points, std::span<Out> out, QueryCounters* given,
                        const Executor& executor) {
    const Scene<Scalar>& scene = impl.scene;
    const auto answer = [&](const PointsView<Scalar>& some, const std::uint64_t* entries, Out* answers) {
        return in_parts(
            some.size(), given, executor, [&](std::size_t count) { impl.count_invalid(count); },
            [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
                return detail::winding_numbers(scene, some, entries, first, last, answers, counters, invalid);
            });
    };
    const StandardArithmetic standard;
    if (points.size() < k_least_sorted || are_in_order(scene, points)) return answer(points, nullptr, out.data());
    const std::size_t most = std::min(points.size(), k_most_sorted);
    const auto entries = std::make_unique_for_overwrite<std::uint64_t[]>(2 * most);
    std::size_t hits = 0;
    for (std::size_t begin = 0; begin < points.size(); begin += most) {
        const PointsView<Scalar> some = points.part(begin, std::min(most, points.size() - begin));
        each_chunk(executor, some.size(), [&](std::size_t, std::size_t first, std::size_t last) {
            const StandardArithmetic of_thread;
            key_points(scene, some, first, last, entries.get());
        });
        std::uint64_t* const sorted = entries.get() + most;
        sort_entries(entries.get(), sorted, some.size(), executor);
        hits += answer(some, sorted, out.data() + begin);
    }
    return hits;
}

template <class Impl, class Scalar>
void all_crossings(const Impl& impl, const Ways<Scalar>& ways, std::span<int> out, QueryCounters* given,
                   const Executor& executor) {
    in_parts(
        ways.size(), given, executor, [&](std::size_t count) { impl.count_invalid(count); },
        [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
            return detail::crossings(impl.scene, ways, first, last, out.data(), counters, invalid);
        });
}

}  // namespace

template <class Scalar>
std::size_t CollisionMesh<Scalar>::contains_points(const PointsView<Scalar>& points, std::span<std::uint8_t> out,
                                                   QueryCounters* counters, const Executor& executor) const {
    check_sizes("contains_points", points.size(), "points", out.size(), "places for answers");
    return all_winding(*impl_, points, out, counters, executor);
}

template <class Scalar>
void CollisionMesh<Scalar>::winding_numbers(const PointsView<Scalar>& points, std::span<int> out,
                                            QueryCounters* counters, const Executor& executor) const {
    check_sizes("winding_numbers", points.size(), "points", out.size(), "places for answers");
    all_winding(*impl_, points, out, counters, executor);
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::locate_points(const PointsView<Scalar>& points, std::span<Location> out,
                                                 QueryCounters* given, const Executor& executor) const {
    check_sizes("locate_points", points.size(), "points", out.size(), "places for answers");
    return in_parts(
        out.size(), given, executor, [&](std::size_t count) { impl_->count_invalid(count); },
        [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
            return detail::locate(impl_->scene, points.part(first, last - first), out.data() + first, counters,
                                  invalid);
        });
}

template <class Scalar>
void CollisionMesh<Scalar>::crossings(const Segments<Scalar>& segments, std::span<int> out, QueryCounters* counters,
                                      const Executor& executor) const {
    check_sizes("crossings", segments, out.size());
    all_crossings<Impl, Scalar>(*impl_, segments, out, counters, executor);
}

template <class Scalar>
void CollisionMesh<Scalar>::crossings_of_rays(const Rays<Scalar>& rays, std::span<int> out, QueryCounters* counters,
                                              const Executor& executor) const {
    check_sizes("crossings", rays, out.size());
    all_crossings<Impl, Scalar>(*impl_, rays, out, counters, executor);
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::all_hits(const Segments<Scalar>& segments, std::span<std::size_t> offsets,
                                            std::span<Hit<Scalar>> hits, const QueryOptions& options,
                                            const Executor& executor) const {
    check_rows(segments, offsets);
    return all_rows<Impl, Scalar, Hit<Scalar>>(*impl_, segments, offsets, hits, options, executor);
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::all_hits_of_rays(const Rays<Scalar>& rays, std::span<std::size_t> offsets,
                                                    std::span<Hit<Scalar>> hits, const QueryOptions& options,
                                                    const Executor& executor) const {
    check_rows(rays, offsets);
    return all_rows<Impl, Scalar, Hit<Scalar>>(*impl_, rays, offsets, hits, options, executor);
}

#define PIERCE_COUNTS(Scalar)                                                                                          \
    template std::size_t CollisionMesh<Scalar>::contains_points(const PointsView<Scalar>&, std::span<std::uint8_t>,    \
                                                                QueryCounters*, const Executor&) const;                \
    template void CollisionMesh<Scalar>::winding_numbers(const PointsView<Scalar>&, std::span<int>, QueryCounters*,    \
                                                         const Executor&) const;                                       \
    template std::size_t CollisionMesh<Scalar>::locate_points(const PointsView<Scalar>&, std::span<Location>,          \
                                                              QueryCounters*, const Executor&) const;                  \
    template void CollisionMesh<Scalar>::crossings(const Segments<Scalar>&, std::span<int>, QueryCounters*,            \
                                                   const Executor&) const;                                             \
    template void CollisionMesh<Scalar>::crossings_of_rays(const Rays<Scalar>&, std::span<int>, QueryCounters*,        \
                                                           const Executor&) const;                                     \
    template std::size_t CollisionMesh<Scalar>::all_hits(const Segments<Scalar>&, std::span<std::size_t>,              \
                                                         std::span<Hit<Scalar>>, const QueryOptions&, const Executor&) \
        const;                                                                                                         \
    template std::size_t CollisionMesh<Scalar>::all_hits_of_rays(                                                      \
        const Rays<Scalar>&, std::span<std::size_t>, std::span<Hit<Scalar>>, const QueryOptions&, const Executor&)     \
        const
PIERCE_COUNTS(float);
PIERCE_COUNTS(double);
#undef PIERCE_COUNTS

}  // namespace pierce
