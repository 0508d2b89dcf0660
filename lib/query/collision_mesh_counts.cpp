// The façade of batches of counts and places, and of all hits as compressed rows.
#include <memory>
#include <stdexcept>
#include <string>

#include <chunks.h>
#include <cluster/sort_entries.h>
#include <environment.h>
#include <query/collision_mesh_impl.h>
#include <query/count_batches.h>
#include <query/locate.h>
#include <query/parts.h>

namespace pierce {

using namespace detail;

namespace {

void check_size(const char* call, const char* what, std::size_t asked, std::size_t answers) {
    if (asked == answers) return;
    throw std::invalid_argument(std::string(call) + ": " + std::to_string(answers) + " places for " +
                                std::to_string(asked) + " " + what + ": they must be as many");
}

template <class Scalar>
PointRows<Scalar> rows_of(std::span<const Vec3<Scalar>> points) {
    static_assert(sizeof(Vec3<Scalar>) == 3 * sizeof(Scalar));
    return {points.empty() ? nullptr : points[0].data(), 3};
}

/// Fewer points are not worth being sorted; so many are at a time.
constexpr std::size_t k_least_sorted = std::size_t{1} << 12;
constexpr std::size_t k_most_sorted = std::size_t{1} << 20;

/// Returns the number of points whose winding number is not 0.
template <class Scalar, class Out>
std::size_t all_winding(const Scene<Scalar>& scene, std::span<const Vec3<Scalar>> points, std::span<Out> out,
                        const PlainBatchOptions& options, std::atomic<std::uint64_t>& invalid_queries) {
    const auto answer = [&](std::span<const Vec3<Scalar>> some, const std::uint64_t* entries, Out* answers) {
        return in_parts(some.size(), options, invalid_queries,
                        [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
                            return detail::winding_numbers(scene, rows_of(some), entries, first, last, answers,
                                                           counters, invalid);
                        });
    };
    const StandardArithmetic standard;
    if (points.size() < k_least_sorted || are_in_order(scene, rows_of(points), points.size()))
        return answer(points, nullptr, out.data());
    const std::size_t most = std::min(points.size(), k_most_sorted);
    const auto entries = std::make_unique_for_overwrite<std::uint64_t[]>(2 * most);
    std::size_t hits = 0;
    for (std::size_t begin = 0; begin < points.size(); begin += most) {
        const std::span<const Vec3<Scalar>> some = points.subspan(begin, std::min(most, points.size() - begin));
        each_chunk(options.executor, some.size(), [&](std::size_t, std::size_t first, std::size_t last) {
            const StandardArithmetic of_thread;
            key_points(scene, rows_of(some), first, last, entries.get());
        });
        std::uint64_t* const sorted = entries.get() + most;
        sort_entries(entries.get(), sorted, some.size(), options.executor);
        hits += answer(some, sorted, out.data() + begin);
    }
    return hits;
}

}  // namespace

template <class Scalar>
std::size_t CollisionMesh<Scalar>::contains_points(std::span<const Vec3<Scalar>> points, std::span<std::uint8_t> out,
                                                   const PlainBatchOptions& options) const {
    check_size("contains_points", "points", points.size(), out.size());
    return all_winding(impl_->scene, points, out, options, impl_->invalid_queries);
}

template <class Scalar>
void CollisionMesh<Scalar>::winding_numbers(std::span<const Vec3<Scalar>> points, std::span<int> out,
                                            const PlainBatchOptions& options) const {
    check_size("winding_numbers", "points", points.size(), out.size());
    all_winding(impl_->scene, points, out, options, impl_->invalid_queries);
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::locate_points(std::span<const Vec3<Scalar>> points, std::span<Location> out,
                                                 const PlainBatchOptions& options) const {
    check_size("locate_points", "points", points.size(), out.size());
    return in_parts(out.size(), options, impl_->invalid_queries,
                    [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
                        return detail::locate(impl_->scene, points.subspan(first, last - first), out.data() + first,
                                              counters, invalid);
                    });
}

template <class Scalar>
void CollisionMesh<Scalar>::crossings(std::span<const Segment<Scalar>> segments, std::span<int> out,
                                      const PlainBatchOptions& options) const {
    check_size("crossings", "segments", segments.size(), out.size());
    if (segments.empty()) return;
    const Ends<Scalar> ends{segments[0].from.data(), segments[0].to.data(), 6, 6};
    in_parts(out.size(), options, impl_->invalid_queries,
             [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
                 return detail::crossings(impl_->scene, ends, first, last, out.data(), counters, invalid);
             });
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::all_hits(std::span<const Segment<Scalar>> segments, std::span<std::size_t> offsets,
                                            std::span<Hit<Scalar>> hits, const BatchOptions& options) const {
    check_size("all_hits", "segments and the end of the last", segments.size() + 1, offsets.size());
    offsets[0] = 0;
    const bool nothing = asks_nothing(options);
    const auto is_asked = [](const Segment<Scalar>& s) { return s.from.allFinite() && s.to.allFinite(); };
    // Each row's length is put where the row ends.
    in_parts(segments.size(), options, impl_->invalid_queries,
             [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
                 for (std::size_t i = first; i < last; ++i) {
                     const bool asked = is_asked(segments[i]);
                     invalid += asked ? 0 : 1;
                     offsets[i + 1] =
                         asked && !nothing ? detail::all_hits(impl_->scene, segments[i], {}, options, counters) : 0;
                 }
                 return std::size_t{0};
             });
    for (std::size_t i = 0; i < segments.size(); ++i) offsets[i + 1] += offsets[i];
    if (hits.empty() || offsets.back() == 0) return offsets.back();
    std::atomic<std::uint64_t> counted_before = 0;
    in_parts(segments.size(), options, counted_before,
             [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t&) {
                 counters.queries = 0;  // counted before
                 for (std::size_t i = first; i < last && offsets[i + 1] <= hits.size(); ++i) {
                     const std::span row = hits.subspan(offsets[i], offsets[i + 1] - offsets[i]);
                     if (!row.empty()) detail::all_hits(impl_->scene, segments[i], row, options, counters);
                 }
                 return std::size_t{0};
             });
    return offsets.back();
}

#define PIERCE_COUNTS(Scalar)                                                                                      \
    template std::size_t CollisionMesh<Scalar>::contains_points(                                                   \
        std::span<const Vec3<Scalar>>, std::span<std::uint8_t>, const PlainBatchOptions&) const;                   \
    template void CollisionMesh<Scalar>::winding_numbers(std::span<const Vec3<Scalar>>, std::span<int>,            \
                                                         const PlainBatchOptions&) const;                          \
    template std::size_t CollisionMesh<Scalar>::locate_points(std::span<const Vec3<Scalar>>, std::span<Location>,  \
                                                              const PlainBatchOptions&) const;                     \
    template void CollisionMesh<Scalar>::crossings(std::span<const Segment<Scalar>>, std::span<int>,               \
                                                   const PlainBatchOptions&) const;                                \
    template std::size_t CollisionMesh<Scalar>::all_hits(std::span<const Segment<Scalar>>, std::span<std::size_t>, \
                                                         std::span<Hit<Scalar>>, const BatchOptions&) const
PIERCE_COUNTS(float);
PIERCE_COUNTS(double);
#undef PIERCE_COUNTS

}  // namespace pierce
