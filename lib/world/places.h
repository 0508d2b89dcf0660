// Where points are in a world, what a segment passes through, and why: behind calls that are not inlined (engine.h).
#pragma once

#include <span>
#include <vector>

#include <pierce/world_answers.h>
#include <world/instances.h>

namespace pierce::detail {

template <class Scalar>
[[nodiscard]] [[gnu::noinline]] int winding_number(const WorldScene<Scalar>& world, const Vec3<Scalar>& point,
                                                   std::uint32_t mask, QueryCounters& counters);

/// Writes the first `out.size()` of the meshes whose winding number is not 0, by index; returns how many there are.
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] std::size_t containing(const WorldScene<Scalar>& world, const Vec3<Scalar>& point,
                                                       std::span<MeshId> out, std::uint32_t mask,
                                                       QueryCounters& counters);

template <class Scalar>
[[nodiscard]] [[gnu::noinline]] Location locate(const WorldScene<Scalar>& world, const Vec3<Scalar>& point,
                                                std::span<WorldTouch> out, std::uint32_t mask, QueryCounters& counters);

/// `max_fraction` is at least 0.
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] std::size_t passages(const WorldScene<Scalar>& world, const Segment<Scalar>& segment,
                                                     std::span<WorldPassage<Scalar>> out, std::span<FaceTouch> faces,
                                                     const WorldPassageOptions& options, QueryCounters& counters);

template <class Scalar>
[[nodiscard]] [[gnu::noinline]] std::vector<WorldFaceVerdict> explain(const WorldScene<Scalar>& world,
                                                                      const Segment<Scalar>& segment,
                                                                      const WorldOptions& options,
                                                                      QueryCounters& counters);

}  // namespace pierce::detail
