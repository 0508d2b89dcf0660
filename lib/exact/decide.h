// The decision contract for one segment and one triangle, in exact arithmetic: total over all finite input.
#pragma once

#include <decision.h>
#include <point.h>

namespace pierce::detail {

/// The closed rule: the ends pass the plane from a side that counts, and the segment meets the closed triangle. So a
/// segment in the plane, of length zero, or on a triangle of area zero (whose sides are all 0) never hits.
[[nodiscard]] Decision decide(const Path& path, const Corners& corners, Sides sides);

/// The sign of orient3d: +1 in front of the triangle, 0 on its plane, -1 behind it; 0 for a triangle of area zero.
[[nodiscard]] int side_of(const Corners& corners, const Point& point);

[[nodiscard]] bool has_zero_area(const Corners& corners);

}  // namespace pierce::detail
