// Vectors of doubles or of double-doubles, for formulas that are written once.
#pragma once

#include <algorithm>
#include <cmath>

#include <kernel/double_double.h>
#include <point.h>

namespace pierce::detail {

template <class Number>
struct Triple {
    Number x, y, z;
};

template <class Number>
[[nodiscard]] Triple<Number> difference(const Point& p, const Point& q) {
    using A = Arithmetic<Number>;
    return {A::difference(p[0], q[0]), A::difference(p[1], q[1]), A::difference(p[2], q[2])};
}
template <class Number>
[[nodiscard]] Triple<Number> cross(const Triple<Number>& p, const Triple<Number>& q) {
    return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}
template <class Number>
[[nodiscard]] Number dot(const Triple<Number>& p, const Triple<Number>& q) {
    return p.x * q.x + p.y * q.y + p.z * q.z;
}
template <class Number>
[[nodiscard]] Triple<double> rounded(const Triple<Number>& p) {
    using A = Arithmetic<Number>;
    return {A::rounded(p.x), A::rounded(p.y), A::rounded(p.z)};
}
template <class Number>
[[nodiscard]] double largest(const Triple<Number>& p) {
    const Triple<double> near = rounded(p);
    return std::max({std::abs(near.x), std::abs(near.y), std::abs(near.z)});
}
/// False for NaN.
[[nodiscard]] inline bool is_tame(double x) { return x >= 0x1p-300 && x <= 0x1p300; }

}  // namespace pierce::detail
