// The façade of balls in worlds.
#include <query/ask_spheres.h>
#include <world/spheres.h>
#include <world/world_impl.h>

namespace pierce {

using namespace detail;

template <class Scalar>
std::optional<WorldSphereHit<Scalar>> World<Scalar>::sweep_sphere(const Segment<Scalar>& step, Scalar radius,
                                                                  const WorldOptions& options) const noexcept {
    return ask_sphere<std::optional<WorldSphereHit<Scalar>>>(
        *impl_, step, radius, options,
        [&](QueryCounters& counters) { return detail::sweep_sphere(impl_->scene, step, radius, options, counters); });
}

template <class Scalar>
std::size_t World<Scalar>::sphere_hits(const Segment<Scalar>& step, Scalar radius,
                                       std::span<WorldSphereHit<Scalar>> out,
                                       const WorldOptions& options) const noexcept {
    return ask_sphere<std::size_t>(*impl_, step, radius, options, [&](QueryCounters& counters) {
        return detail::sphere_hits(impl_->scene, step, radius, out, options, counters);
    });
}

template <class Scalar>
std::size_t World<Scalar>::sphere_contacts(const Vec3<Scalar>& center, Scalar radius,
                                           std::span<WorldSphereHit<Scalar>> out,
                                           const WorldOptions& options) const noexcept {
    return ask_sphere<std::size_t>(*impl_, center, radius, options, [&](QueryCounters& counters) {
        return detail::sphere_contacts(impl_->scene, center, radius, out, options, counters);
    });
}

template <class Scalar>
std::size_t World<Scalar>::sweep_spheres(const Segments<Scalar>& steps, Scalar radius,
                                         std::span<std::optional<WorldSphereHit<Scalar>>> out,
                                         const WorldOptions& options, const Executor& executor) const {
    return sweep_spheres_of(*impl_, steps, radius, out, options, executor);
}
template <class Scalar>
std::size_t World<Scalar>::sweep_spheres(const Segments<Scalar>& steps, std::span<const Scalar> radii,
                                         std::span<std::optional<WorldSphereHit<Scalar>>> out,
                                         const WorldOptions& options, const Executor& executor) const {
    return sweep_spheres_of(*impl_, steps, radii, out, options, executor);
}

#define PIERCE_SPHERES(Scalar)                                                                                         \
    template std::optional<WorldSphereHit<Scalar>> World<Scalar>::sweep_sphere(const Segment<Scalar>&, Scalar,         \
                                                                               const WorldOptions&) const noexcept;    \
    template std::size_t World<Scalar>::sphere_hits(const Segment<Scalar>&, Scalar, std::span<WorldSphereHit<Scalar>>, \
                                                    const WorldOptions&) const noexcept;                               \
    template std::size_t World<Scalar>::sphere_contacts(                                                               \
        const Vec3<Scalar>&, Scalar, std::span<WorldSphereHit<Scalar>>, const WorldOptions&) const noexcept;           \
    template std::size_t World<Scalar>::sweep_spheres(const Segments<Scalar>&, Scalar,                                 \
                                                      std::span<std::optional<WorldSphereHit<Scalar>>>,                \
                                                      const WorldOptions&, const Executor&) const;                     \
    template std::size_t World<Scalar>::sweep_spheres(const Segments<Scalar>&, std::span<const Scalar>,                \
                                                      std::span<std::optional<WorldSphereHit<Scalar>>>,                \
                                                      const WorldOptions&, const Executor&) const
PIERCE_SPHERES(float);
PIERCE_SPHERES(double);
#undef PIERCE_SPHERES

}  // namespace pierce
