// Queries about spheres, behind calls that are not inlined (engine.h). All coordinates are finite, radii are finite and
// larger than 0, `max_fraction` is not NaN.
#pragma once

#include <optional>
#include <span>

#include <pierce/options.h>
#include <pierce/sphere.h>
#include <query/scene.h>

namespace pierce::detail {

template <class Scalar>
[[gnu::noinline]] std::optional<SphereHit<Scalar>> sweep_sphere(const Scene<Scalar>& scene, const Segment<Scalar>& step,
                                                                Scalar radius, const QueryOptions& options,
                                                                QueryCounters& counters);

template <class Scalar>
[[gnu::noinline]] std::size_t sphere_hits(const Scene<Scalar>& scene, const Segment<Scalar>& step, Scalar radius,
                                          std::span<SphereHit<Scalar>> out, const QueryOptions& options,
                                          QueryCounters& counters);

template <class Scalar>
[[gnu::noinline]] std::size_t sphere_contacts(const Scene<Scalar>& scene, const Vec3<Scalar>& center, Scalar radius,
                                              std::span<SphereHit<Scalar>> out, const QueryOptions& options,
                                              QueryCounters& counters);

/// Whether what is asked has a meaning. (Not inlined: a comparison of denormal numbers depends on the environment.)
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] bool is_radius(const Scalar& radius) {
    return radius > 0 && radius - radius == 0;
}

}  // namespace pierce::detail
