// Which way half-planes lie around an edge.
#pragma once

#include <point.h>

namespace pierce::detail {

/// Where the half-plane from the edge u v through x lies, turned about v - u by the right hand from the one through
/// `reference`: 0 the same; 1 less than half a turn; 2 opposite; 3 more. Neither point is on the line of the edge.
[[nodiscard]] int turn_of(const Point& u, const Point& v, const Point& reference, const Point& x);

}  // namespace pierce::detail
