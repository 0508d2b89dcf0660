// Where points are: behind a call that is not inlined, as all queries (engine.h). The points are finite.
#pragma once

#include <span>

#include <pierce/location.h>
#include <pierce/points_view.h>
#include <pierce/types.h>
#include <query/scene.h>

namespace pierce::detail {

/// Writes the first `out.size()` of the triangles that the point lies on in order of (face, triangle).
template <class Scalar>
[[gnu::noinline]] Location locate(const Scene<Scalar>& scene, const Vec3<Scalar>& at, std::span<FaceTouch> out,
                                  QueryCounters& counters);

/// Many points. Those that are not finite count as `invalid`. Returns the number of those on the
/// surface.
template <class Scalar>
[[gnu::noinline]] std::size_t locate(const Scene<Scalar>& scene, const PointsView<Scalar>& points, Location* out,
                                     QueryCounters& counters, std::size_t& invalid);

}  // namespace pierce::detail
