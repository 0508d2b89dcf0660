// The place of a hit in exact arithmetic, where rounded one can't tell: total over all finite input.
#pragma once

#include <point.h>

namespace pierce::detail {

/// Where the path of a hit meets the triangle's plane, each coordinate correctly rounded to `Scalar` (to nearest, ties
/// to even). It is looked for from `near` on, in steps that double: any point will do, one that is far off costs time.
template <class Scalar>
[[nodiscard]] Point exact_position(const Path& path, const Corners& corners, const Point& near);

/// Whether a point is strictly on the side of the plane that `from` is strictly on, and as far from it as `from` or at
/// least `grain` away, of which 2^-40 may be missing: a point that lies exactly so far away is far enough.
[[nodiscard]] bool is_far_enough(const Corners& corners, const Point& from, const Point& point, double grain);

}  // namespace pierce::detail
