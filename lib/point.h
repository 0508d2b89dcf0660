// The core's own points: plain doubles, into which float and double coordinates both go without change.
#pragma once

#include <array>

#include <pierce/types.h>

namespace pierce::detail {

using Point = std::array<double, 3>;

/// The corners of a triangle, counter-clockwise seen from its front.
using Corners = std::array<Point, 3>;

/// A segment in the core: the same numbers as the caller's, as doubles.
struct Path {
    Point from;
    Point to;
};

template <class Scalar>
[[nodiscard]] Point to_point(const Vec3<Scalar>& v) {
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

template <class Scalar>
[[nodiscard]] Path to_path(const Segment<Scalar>& segment) {
    return {to_point(segment.from), to_point(segment.to)};
}

}  // namespace pierce::detail
