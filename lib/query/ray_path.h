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

}  // namespace pierce::detail
