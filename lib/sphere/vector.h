// What this room computes with points: in plain doubles, in one order.
#pragma once

#include <algorithm>
#include <cmath>

#include <path.h>

namespace pierce::detail {

[[nodiscard]] inline Point minus(const Point& x, const Point& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
[[nodiscard]] inline Point plus(const Point& x, const Point& y) { return {x[0] + y[0], x[1] + y[1], x[2] + y[2]}; }
[[nodiscard]] inline Point times(double s, const Point& x) { return {s * x[0], s * x[1], s * x[2]}; }
[[nodiscard]] inline double dot(const Point& x, const Point& y) { return (x[0] * y[0] + x[1] * y[1]) + x[2] * y[2]; }
[[nodiscard]] inline Point cross(const Point& x, const Point& y) {
    return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}
/// The largest |component|; NaN if one of them is.
[[nodiscard]] inline double size_of(const Point& x) {
    const double nan = (x[0] - x[0]) + (x[1] - x[1]) + (x[2] - x[2]);
    return std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])}) + nan;
}

}  // namespace pierce::detail
