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

/// Whether ends on these sides pass the plane from its front: on the plane counts as in front.
[[nodiscard]] constexpr bool passes_front(int from, int to) { return from >= 0 && to < 0; }

/// Whether they pass it from its back. On the plane counts as behind for `back`, which is `front` mirrored; for `both` as in
/// front, so that a hit is a change of side: a point on the plane can leave it to the front.
[[nodiscard]] constexpr bool passes_back(int from, int to, Sides sides) {
    return sides == Sides::both ? from < 0 && to >= 0 : from <= 0 && to > 0;
}

/// The closed rule: the ends pass the plane from a side that counts, and the segment meets the closed triangle. So a segment in
/// the plane, of length zero, or on a triangle of area zero (whose sides are all 0) never hits.
[[nodiscard]] Decision decide(const Path& path, const Corners& corners, Sides sides);

/// The sign of orient3d: +1 in front of the triangle, 0 on its plane, -1 behind it; 0 for a triangle of area zero.
[[nodiscard]] int side_of(const Corners& corners, const Point& point);

[[nodiscard]] bool has_zero_area(const Corners& corners);

}  // namespace pierce::detail
