// What those ask who move a sphere from step to step: what stops it, and whether one triangle lets it pass. Behind
// calls that are not inlined (engine.h). All coordinates are finite, radii are finite and larger than 0.
#pragma once

#include <pierce/options.h>
#include <query/scene.h>

namespace pierce::detail {

/// How near to a surface a sphere that starts here may come to rest: at least what place_sphere() takes for it.
template <class Scalar>
[[nodiscard]] double sphere_grain(const Scene<Scalar>& scene, const Point& from, double radius);

struct SphereStop {
    bool in_contact;  ///< so near to the plane that it touches that it is left where it is; else it is at `center`
    Point center;
    double fraction;  ///< of the way, up to `center`: a lower bound
    Point normal;     ///< unit, towards the center
    double height;    ///< of the sphere above the plane through what it touches, across `normal`: not less than 0
    Corners corners;
    int side;  ///< of the triangle's plane that the center is on: 1 in front, -1 behind
    std::uint32_t face;
    std::uint32_t triangle;
};

/// False: nothing stops it. `contact`: up to what height it is in contact.
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] bool step_sphere(const Scene<Scalar>& scene, const Path& path, double radius,
                                                 double contact, const QueryOptions& options, QueryCounters& counters,
                                                 SphereStop& stop);

/// Whether a sphere on the path enters the triangle, by the rule of `SphereHit`, exactly.
[[nodiscard]] bool sphere_is_stopped(const Corners& corners, const Path& path, double radius, QueryCounters& counters);

/// The distance of a point from a triangle, about.
[[nodiscard]] double distance_from(const Corners& corners, const Point& point);

}  // namespace pierce::detail
