// Steps of a sphere that is moved on from step to step.
#include <query/sphere_step.h>

#include <query/sphere_sweep.h>

namespace pierce::detail {

namespace {

// Of the sphere above the plane across the normal through the nearest point, in the caller's units. A sphere that
// overlaps is taken to lie on it: it is not pushed out.
double height_above(const Sphere& sphere, const SphereCandidate& entry, const Point& moved) {
    const double above = dot(entry.normal, moved) - dot(entry.normal, entry.nearest.point) / sphere.unit;
    return std::max(above - sphere.radius, 0.0);
}

}  // namespace

template <class Scalar>
double sphere_grain(const Scene<Scalar>& scene, const Point& from, double radius) {
    const double units = sphere_margin(scene, radius) / k_sphere_margin_units * k_grain_units;
    return std::max({units, 0x1p-50 * size_of(from), 0x1p-45 * sphere_reach(scene, from, radius)});
}

template <class Scalar>
bool step_sphere(const Scene<Scalar>& scene, const Path& path, double radius, double contact,
                 const QueryOptions& options, QueryCounters& counters, SphereStop& stop) {
    if (scene.empty() || path.from == path.to) return false;
    const SphereSweep<Scalar> sweep(scene, path, radius, 1, options, counters);
    if (!sweep.found()) return false;
    const SphereCandidate& entry = sweep.first();
    stop.corners = scene.corners(entry.triangle);
    stop.side = side_of(stop.corners, entry) == Sides::front ? 1 : -1;
    stop.face = entry.face;
    stop.triangle = entry.number;
    stop.normal = entry.normal;
    stop.center = path.from;
    stop.fraction = 0;
    stop.height = height_above(sweep.sphere(), entry, {});
    stop.in_contact = stop.height <= contact;
    if (stop.in_contact) return true;
    stop.center = sweep.place();
    stop.fraction = entry.time;
    stop.height = height_above(sweep.sphere(), entry, minus(stop.center, path.from));
    return true;
}

bool sphere_is_stopped(const Corners& corners, const Path& path, double radius, QueryCounters& counters) {
    double reach = radius;
    for (const Point& corner : corners) reach = std::max(reach, size_of(minus(corner, path.from)) + radius);
    SphereCounts exact;
    Entry entry;
    const bool stopped = enters(Sphere(path, radius, reach * (1 + 0x1p-50)), corners, 1, exact, entry);
    counters.exact_decisions += exact.exact;
    return stopped;
}

double distance_from(const Corners& corners, const Point& point) {
    const Point way = minus(point, nearest_of(corners, point).point);
    const double size = size_of(way);
    if (!(size > 0)) return 0;
    const Point unit = times(1 / size, way);
    return size * std::sqrt(dot(unit, unit));
}

#define PIERCE_SPHERE_STEPS(Scalar)                                                                                   \
    template double sphere_grain(const Scene<Scalar>&, const Point&, double);                                         \
    template bool step_sphere(const Scene<Scalar>&, const Path&, double, double, const QueryOptions&, QueryCounters&, \
                              SphereStop&)
PIERCE_SPHERE_STEPS(float);
PIERCE_SPHERE_STEPS(double);
#undef PIERCE_SPHERE_STEPS

}  // namespace pierce::detail
