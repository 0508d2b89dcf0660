// A ray as a path of finite length: beyond the mesh nothing is hit, so that what is left of it has an end that exact
// arithmetic can name.
#pragma once

#include <pierce/ray.h>
#include <query/scene.h>

namespace pierce::detail {

/// Sets the path of a ray from a point: its way is the direction times a power of two, exactly. Hits count that lie
/// before `limit` by the rule of a segment's end, at parameters of at most `most`. False: there are none. All numbers
/// must be finite, but for `limit` and `most`, which may be infinite.
///
/// Where the far side of the mesh is 2^1022 away or more along an axis, the way ends at the last number.
[[nodiscard]] bool set_ray_path(const Box& bounds, const Point& origin, const Point& direction, double limit,
                                double most, bool floats, Path& path);

/// The path of a query. False: there are no hits.
template <class Scalar>
[[nodiscard]] bool set_path(const Scene<Scalar>&, const Segment<Scalar>& segment, double most, Path& path) {
    path = to_path(segment, most);
    return true;
}
template <class Scalar>
[[nodiscard]] bool set_path(const Scene<Scalar>& scene, const Ray<Scalar>& ray, double most, Path& path) {
    return set_ray_path(scene.bounds, to_point(ray.origin), to_point(ray.direction), static_cast<double>(ray.limit),
                        most, sizeof(Scalar) == sizeof(float), path);
}

/// Where a query starts.
template <class Scalar>
[[nodiscard]] Point start_of(const Segment<Scalar>& segment) {
    return to_point(segment.from);
}
template <class Scalar>
[[nodiscard]] Point start_of(const Ray<Scalar>& ray) {
    return to_point(ray.origin);
}

}  // namespace pierce::detail
