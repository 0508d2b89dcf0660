// The façade of worlds' batches: parts for the executor, each in standard arithmetic, one query after the other.
#include <query/batch_sizes.h>
#include <query/parts.h>
#include <query/rows.h>
#include <world/batches.h>
#include <world/world_impl.h>

namespace pierce {

using namespace detail;

namespace {

template <class Scalar>
std::size_t size_of(const WorldHitsOut<Scalar>& out) {
    if (const auto* arrays = std::get_if<WorldHitArrays<Scalar>>(&out)) return arrays->hits.count;
    if (const auto* plain = std::get_if<std::span<WorldHit<Scalar>>>(&out)) return plain->size();
    return std::get_if<std::span<std::optional<WorldHit<Scalar>>>>(&out)->size();
}

template <class Impl, class Scalar, class Part>
std::size_t in_world_parts(const Impl& impl, std::size_t count, QueryCounters* counters, const Executor& executor,
                           Part&& part) {
    return in_parts(
        count, counters, executor, [&](std::size_t invalid) { impl.count_invalid(invalid); }, std::forward<Part>(part));
}

template <class Impl, class Scalar>
std::size_t all_first(const Impl& impl, const Ways<Scalar>& ways, const WorldHitsOut<Scalar>& out,
                      const WorldOptions& options, const Executor& executor) {
    return in_world_parts<Impl, Scalar>(
        impl, ways.size(), options.counters, executor,
        [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
            return detail::first_hits(impl.scene, ways, first, last, out, options, counters, invalid);
        });
}

template <class Impl, class Scalar>
std::size_t all_any(const Impl& impl, const Ways<Scalar>& ways, std::span<std::uint8_t> out,
                    const WorldOptions& options, const Executor& executor) {
    return in_world_parts<Impl, Scalar>(
        impl, ways.size(), options.counters, executor,
        [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
            return detail::any_hits(impl.scene, ways, first, last, out.data(), options, counters, invalid);
        });
}

template <class Impl, class Scalar>
void all_crossings(const Impl& impl, const Ways<Scalar>& ways, std::span<int> out, const WorldCountOptions& options,
                   const Executor& executor) {
    in_world_parts<Impl, Scalar>(
        impl, ways.size(), options.counters, executor,
        [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
            detail::all_crossings(impl.scene, ways, first, last, out.data(), options.mask, counters, invalid);
            return std::size_t{0};
        });
}

}  // namespace

template <class Scalar>
std::size_t World<Scalar>::first_hits(const Segments<Scalar>& segments, const WorldHitsOut<Scalar>& out,
                                      const WorldOptions& options, const Executor& executor) const {
    check_sizes("first_hits", segments, size_of<Scalar>(out));
    return all_first<Impl, Scalar>(*impl_, segments, out, options, executor);
}
template <class Scalar>
std::size_t World<Scalar>::sweeps(const Segments<Scalar>& steps, const WorldHitsOut<Scalar>& out,
                                  const WorldOptions& options, const Executor& executor) const {
    check_sizes("sweeps", steps, size_of<Scalar>(out));
    return all_first<Impl, Scalar>(*impl_, steps, out, options, executor);
}
template <class Scalar>
std::size_t World<Scalar>::all_hits(const Segments<Scalar>& segments, std::span<std::size_t> offsets,
                                    std::span<WorldHit<Scalar>> hits, const WorldOptions& options,
                                    const Executor& executor) const {
    check_rows(segments, offsets);
    return all_rows<Impl, Scalar, WorldHit<Scalar>>(*impl_, segments, offsets, hits, options, executor);
}
template <class Scalar>
std::size_t World<Scalar>::all_hits_of_rays(const Rays<Scalar>& rays, std::span<std::size_t> offsets,
                                            std::span<WorldHit<Scalar>> hits, const WorldOptions& options,
                                            const Executor& executor) const {
    check_rows(rays, offsets);
    return all_rows<Impl, Scalar, WorldHit<Scalar>>(*impl_, rays, offsets, hits, options, executor);
}
template <class Scalar>
std::size_t World<Scalar>::any_hits(const Segments<Scalar>& segments, std::span<std::uint8_t> out,
                                    const WorldOptions& options, const Executor& executor) const {
    check_sizes("any_hits", segments, out.size());
    return all_any<Impl, Scalar>(*impl_, segments, out, options, executor);
}
template <class Scalar>
void World<Scalar>::crossings(const Segments<Scalar>& segments, std::span<int> out, const WorldCountOptions& options,
                              const Executor& executor) const {
    check_sizes("crossings", segments, out.size());
    all_crossings<Impl, Scalar>(*impl_, segments, out, options, executor);
}
template <class Scalar>
std::size_t World<Scalar>::first_hits_of_rays(const Rays<Scalar>& rays, const WorldHitsOut<Scalar>& out,
                                              const WorldOptions& options, const Executor& executor) const {
    check_sizes("first_hits", rays, size_of<Scalar>(out));
    return all_first<Impl, Scalar>(*impl_, rays, out, options, executor);
}
template <class Scalar>
std::size_t World<Scalar>::any_hits_of_rays(const Rays<Scalar>& rays, std::span<std::uint8_t> out,
                                            const WorldOptions& options, const Executor& executor) const {
    check_sizes("any_hits", rays, out.size());
    return all_any<Impl, Scalar>(*impl_, rays, out, options, executor);
}
template <class Scalar>
void World<Scalar>::crossings_of_rays(const Rays<Scalar>& rays, std::span<int> out, const WorldCountOptions& options,
                                      const Executor& executor) const {
    check_sizes("crossings", rays, out.size());
    all_crossings<Impl, Scalar>(*impl_, rays, out, options, executor);
}

template <class Scalar>
void World<Scalar>::winding_numbers(const PointsView<Scalar>& points, std::span<int> out,
                                    const WorldCountOptions& options, const Executor& executor) const {
    check_sizes("winding_numbers", points.size(), "points", out.size(), "places for answers");
    in_world_parts<Impl, Scalar>(
        *impl_, points.size(), options.counters, executor,
        [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
            const auto put = [&](std::size_t i, int number) { out[i] = number; };
            all_winding_numbers(impl_->scene, points, first, last, options.mask, counters, invalid, put);
            return std::size_t{0};
        });
}

template <class Scalar>
std::size_t World<Scalar>::contains_points(const PointsView<Scalar>& points, std::span<std::uint8_t> out,
                                           const WorldCountOptions& options, const Executor& executor) const {
    check_sizes("contains_points", points.size(), "points", out.size(), "places for answers");
    return in_world_parts<Impl, Scalar>(
        *impl_, points.size(), options.counters, executor,
        [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
            std::size_t inside = 0;
            const auto put = [&](std::size_t i, int number) { inside += out[i] = number != 0 ? 1 : 0; };
            all_winding_numbers(impl_->scene, points, first, last, options.mask, counters, invalid, put);
            return inside;
        });
}

template <class Scalar>
std::size_t World<Scalar>::locate_points(const PointsView<Scalar>& points, std::span<Location> out,
                                         const WorldCountOptions& options, const Executor& executor) const {
    check_sizes("locate_points", points.size(), "points", out.size(), "places for answers");
    return in_world_parts<Impl, Scalar>(
        *impl_, points.size(), options.counters, executor,
        [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
            std::size_t count = 0;
            for (std::size_t i = first; i < last; ++i) {
                const Vec3<Scalar> point = points[i];
                const bool valid = is_valid(point);
                invalid += valid ? 0 : 1;
                out[i] = valid ? detail::locate<Scalar>(impl_->scene, point, {}, options.mask, counters) : Location{};
                if (out[i].place == Place::on_surface) ++count;
            }
            return count;
        });
}

#define PIERCE_BATCHES(Scalar)                                                                                        \
    template std::size_t World<Scalar>::first_hits(const Segments<Scalar>&, const WorldHitsOut<Scalar>&,              \
                                                   const WorldOptions&, const Executor&) const;                       \
    template std::size_t World<Scalar>::any_hits(const Segments<Scalar>&, std::span<std::uint8_t>,                    \
                                                 const WorldOptions&, const Executor&) const;                         \
    template void World<Scalar>::crossings(const Segments<Scalar>&, std::span<int>, const WorldCountOptions&,         \
                                           const Executor&) const;                                                    \
    template std::size_t World<Scalar>::first_hits_of_rays(const Rays<Scalar>&, const WorldHitsOut<Scalar>&,          \
                                                           const WorldOptions&, const Executor&) const;               \
    template std::size_t World<Scalar>::any_hits_of_rays(const Rays<Scalar>&, std::span<std::uint8_t>,                \
                                                         const WorldOptions&, const Executor&) const;                 \
    template void World<Scalar>::crossings_of_rays(const Rays<Scalar>&, std::span<int>, const WorldCountOptions&,     \
                                                   const Executor&) const;                                            \
    template void World<Scalar>::winding_numbers(const PointsView<Scalar>&, std::span<int>, const WorldCountOptions&, \
                                                 const Executor&) const;                                              \
    template std::size_t World<Scalar>::sweeps(const Segments<Scalar>&, const WorldHitsOut<Scalar>&,                  \
                                               const WorldOptions&, const Executor&) const;                           \
    template std::size_t World<Scalar>::all_hits(const Segments<Scalar>&, std::span<std::size_t>,                     \
                                                 std::span<WorldHit<Scalar>>, const WorldOptions&, const Executor&)   \
        const;                                                                                                        \
    template std::size_t World<Scalar>::all_hits_of_rays(const Rays<Scalar>&, std::span<std::size_t>,                 \
                                                         std::span<WorldHit<Scalar>>, const WorldOptions&,            \
                                                         const Executor&) const;                                      \
    template std::size_t World<Scalar>::locate_points(const PointsView<Scalar>&, std::span<Location>,                 \
                                                      const WorldCountOptions&, const Executor&) const;               \
    template std::size_t World<Scalar>::contains_points(const PointsView<Scalar>&, std::span<std::uint8_t>,           \
                                                        const WorldCountOptions&, const Executor&) const
PIERCE_BATCHES(float);
PIERCE_BATCHES(double);
#undef PIERCE_BATCHES

}  // namespace pierce
