// Where a sphere is against a triangle, on its way along a path: exactly, on the coordinates and the radius given.
#pragma once

#include <point.h>

namespace pierce::detail {

/// At the path's start, of a radius > 0 and a triangle with area.
struct SphereStart {
    int gap;       ///< the sign of the distance from the start to the triangle, less the radius
    int approach;  ///< the sign in which that distance changes at first: < 0 where the path comes nearer
};
[[nodiscard]] SphereStart sphere_start(const Path& path, double radius, const Corners& corners);

/// Whether the sphere comes nearer to the triangle than its radius on the first `fraction`, in (0, 1], of the path; at
/// whose start it is no nearer.
[[nodiscard]] bool sphere_enters(const Path& path, double fraction, double radius, const Corners& corners);

}  // namespace pierce::detail
