// The core's own points: plain doubles, into which float and double coordinates both go without change.
#pragma once

#include <array>

namespace pierce::detail {

using Point = std::array<double, 3>;

/// The corners of a triangle, counter-clockwise seen from its front.
using Corners = std::array<Point, 3>;

/// A segment in the core: the same numbers as the caller's, as doubles.
struct Path {
    Point from;
    Point to;
};

}  // namespace pierce::detail
