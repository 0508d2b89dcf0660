// Balls in a world, behind calls that are not inlined: as query/spheres.h, whose conditions hold.
#pragma once

#include <optional>
#include <span>

#include <pierce/world_answers.h>
#include <world/instances.h>

namespace pierce::detail {

template <class Scalar>
[[gnu::noinline]] std::optional<WorldSphereHit<Scalar>> sweep_sphere(const WorldScene<Scalar>& world,
                                                                     const Segment<Scalar>& step, Scalar radius,
                                                                     const WorldOptions& options,
                                                                     QueryCounters& counters);

template <class Scalar>
[[gnu::noinline]] std::size_t sphere_hits(const WorldScene<Scalar>& world, const Segment<Scalar>& step, Scalar radius,
                                          std::span<WorldSphereHit<Scalar>> out, const WorldOptions& options,
                                          QueryCounters& counters);

template <class Scalar>
[[gnu::noinline]] std::size_t sphere_contacts(const WorldScene<Scalar>& world, const Vec3<Scalar>& center,
                                              Scalar radius, std::span<WorldSphereHit<Scalar>> out,
                                              const WorldOptions& options, QueryCounters& counters);

}  // namespace pierce::detail
