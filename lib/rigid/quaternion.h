// Rotations as unit quaternions, by operations that round the same everywhere: no sine, no cosine.
#pragma once

#include <cmath>

#include <point.h>

namespace pierce::detail {

/// w + x i + y j + z k.
struct Quaternion {
    double w = 1;
    Point v{};
};

[[nodiscard]] inline Point cross_product(const Point& x, const Point& y) {
    return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

/// First y, then x.
[[nodiscard]] inline Quaternion product(const Quaternion& x, const Quaternion& y) {
    const Point c = cross_product(x.v, y.v);
    Quaternion out;
    out.w = x.w * y.w - ((x.v[0] * y.v[0] + x.v[1] * y.v[1]) + x.v[2] * y.v[2]);
    for (std::size_t k = 0; k < 3; ++k) out.v[k] = (x.w * y.v[k] + y.w * x.v[k]) + c[k];
    return out;
}

[[nodiscard]] inline Quaternion normalised(const Quaternion& x) {
    const double length = std::sqrt(x.w * x.w + ((x.v[0] * x.v[0] + x.v[1] * x.v[1]) + x.v[2] * x.v[2]));
    return {x.w / length, {x.v[0] / length, x.v[1] / length, x.v[2] / length}};
}

/// Half of a rotation by at most half a turn, w >= 0: the sum 1 + x is at least 1 long, so nothing cancels.
[[nodiscard]] inline Quaternion half_of(const Quaternion& x) { return normalised({1 + x.w, x.v}); }

/// p turned by x: p + 2 (w v x p + v x (v x p)).
[[nodiscard]] inline Point turned(const Quaternion& x, const Point& p) {
    const Point c = cross_product(x.v, p);
    const Point cc = cross_product(x.v, c);
    Point out{};
    for (std::size_t k = 0; k < 3; ++k) out[k] = p[k] + 2 * (x.w * c[k] + cc[k]);
    return out;
}
[[nodiscard]] inline Point turned_back(const Quaternion& x, const Point& p) {
    return turned({-x.w, x.v}, p);  // -x is the same rotation as x: w changes its sign, or v does
}

}  // namespace pierce::detail
