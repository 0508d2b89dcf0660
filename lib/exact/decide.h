// The decision contract for one segment and one triangle, in exact arithmetic: total over all finite input.
#pragma once

#include <cstdint>

#include <point.h>

namespace pierce::detail {

struct Decision {
    bool hit = false;
    Sides side = Sides::front;           ///< front or back: where the segment comes from
    Feature feature = Feature::face;
    std::uint8_t feature_index = 0;
    bool at_start = false;
};

/// The closed rule. From the front: side(from) >= 0, side(to) < 0 and the segment meets the closed triangle; from the back:
/// side(from) <= 0, side(to) > 0 and the same. So a segment in the plane, of length zero, or on a triangle of area
/// zero (whose sides are all 0) never hits.
[[nodiscard]] Decision decide(const Path& path, const Corners& corners, Sides sides);

/// The sign of orient3d: +1 in front of the triangle, 0 on its plane, -1 behind it; 0 for a triangle of area zero.
[[nodiscard]] int side_of(const Corners& corners, const Point& point);

[[nodiscard]] bool has_zero_area(const Corners& corners);

}  // namespace pierce::detail
