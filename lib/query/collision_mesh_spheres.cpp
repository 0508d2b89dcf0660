// The façade of swept spheres.
#include <environment.h>
#include <query/along.h>
#include <query/batch_sizes.h>
#include <query/collision_mesh_impl.h>
#include <query/parts.h>
#include <query/spheres.h>

namespace pierce {

using namespace detail;

namespace {

/// A query with a radius: what has no meaning is counted.
template <class Impl, class Asked, class Scalar>
bool is_valid_sphere(const Impl& impl, const Asked& asked, const Scalar& radius) {
    if (is_valid(asked) && is_radius(radius)) return true;
    impl.count_invalid(1);
    return false;
}

template <class Answer, class Impl, class Asked, class Scalar, class Ask>
Answer ask(const Impl& impl, const Asked& asked, const Scalar& radius, const QueryOptions& options, Ask&& ask) {
    const StandardArithmetic standard;
    Counters counters(options.counters);
    if (!is_valid_sphere(impl, asked, radius) || !is_limit(options.max_fraction)) return {};
    return ask(counters);
}

/// `radius_of(i)`: of query i.
template <class Impl, class Scalar, class RadiusOf>
std::size_t sweep_all(const Impl& impl, const Segments<Scalar>& steps, std::span<std::optional<SphereHit<Scalar>>> out,
                      const QueryOptions& options, const Executor& executor, RadiusOf&& radius_of) {
    const auto count_invalid = [&](std::size_t count) { impl.count_invalid(count); };
    return in_parts(steps.size(), options.counters, executor, count_invalid,
                    [&](std::size_t first, std::size_t last, QueryCounters& counters, std::size_t& invalid) {
                        std::size_t hits = 0;
                        for (std::size_t i = first; i < last; ++i) {
                            out[i].reset();
                            const Segment<Scalar> step = steps[i];
                            const Scalar radius = radius_of(i);
                            if (!is_valid(step) || !is_radius(radius)) {
                                ++invalid;
                                continue;
                            }
                            if (is_limit(options.max_fraction))
                                out[i] = detail::sweep_sphere(impl.scene, step, radius, options, counters);
                            hits += std::size_t{out[i].has_value()};
                        }
                        return hits;
                    });
}

}  // namespace

template <class Scalar>
std::optional<SphereHit<Scalar>> CollisionMesh<Scalar>::sweep_sphere(const Segment<Scalar>& step, Scalar radius,
                                                                     const QueryOptions& options) const noexcept {
    return ask<std::optional<SphereHit<Scalar>>>(*impl_, step, radius, options, [&](QueryCounters& counters) {
        return detail::sweep_sphere(impl_->scene, step, radius, options, counters);
    });
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::sphere_hits(const Segment<Scalar>& step, Scalar radius,
                                               std::span<SphereHit<Scalar>> out,
                                               const QueryOptions& options) const noexcept {
    return ask<std::size_t>(*impl_, step, radius, options, [&](QueryCounters& counters) {
        return detail::sphere_hits(impl_->scene, step, radius, out, options, counters);
    });
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::sphere_contacts(const Vec3<Scalar>& center, Scalar radius,
                                                   std::span<SphereHit<Scalar>> out,
                                                   const QueryOptions& options) const noexcept {
    return ask<std::size_t>(*impl_, center, radius, options, [&](QueryCounters& counters) {
        return detail::sphere_contacts(impl_->scene, center, radius, out, options, counters);
    });
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::sweep_spheres(const Segments<Scalar>& steps, Scalar radius,
                                                 std::span<std::optional<SphereHit<Scalar>>> out,
                                                 const QueryOptions& options, const Executor& executor) const {
    check_sizes("sweep_spheres", steps, out.size());
    return sweep_all(*impl_, steps, out, options, executor, [radius](std::size_t) { return radius; });
}

template <class Scalar>
std::size_t CollisionMesh<Scalar>::sweep_spheres(const Segments<Scalar>& steps, std::span<const Scalar> radii,
                                                 std::span<std::optional<SphereHit<Scalar>>> out,
                                                 const QueryOptions& options, const Executor& executor) const {
    check_sizes("sweep_spheres", steps, out.size());
    check_sizes("sweep_spheres", steps.size(), "segments", radii.size(), "radii");
    return sweep_all(*impl_, steps, out, options, executor, [radii](std::size_t i) { return radii[i]; });
}

#define PIERCE_SPHERES(Scalar)                                                                                         \
    template std::optional<SphereHit<Scalar>> CollisionMesh<Scalar>::sweep_sphere(const Segment<Scalar>&, Scalar,      \
                                                                                  const QueryOptions&) const noexcept; \
    template std::size_t CollisionMesh<Scalar>::sphere_hits(                                                           \
        const Segment<Scalar>&, Scalar, std::span<SphereHit<Scalar>>, const QueryOptions&) const noexcept;             \
    template std::size_t CollisionMesh<Scalar>::sphere_contacts(                                                       \
        const Vec3<Scalar>&, Scalar, std::span<SphereHit<Scalar>>, const QueryOptions&) const noexcept;                \
    template std::size_t CollisionMesh<Scalar>::sweep_spheres(const Segments<Scalar>&, Scalar,                         \
                                                              std::span<std::optional<SphereHit<Scalar>>>,             \
                                                              const QueryOptions&, const Executor&) const;             \
    template std::size_t CollisionMesh<Scalar>::sweep_spheres(const Segments<Scalar>&, std::span<const Scalar>,        \
                                                              std::span<std::optional<SphereHit<Scalar>>>,             \
                                                              const QueryOptions&, const Executor&) const
PIERCE_SPHERES(float);
PIERCE_SPHERES(double);
#undef PIERCE_SPHERES

}  // namespace pierce
