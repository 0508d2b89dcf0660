// Turns cut into halves, and the curves that they make of straight ways.
#include <rigid/turn.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pierce::detail {

namespace {

using Rows = std::array<Point, 3>;

/// x^T y.
Rows relative(const Rows& x, const Rows& y) {
    Rows out{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) out[i][j] = (x[0][i] * y[0][j] + x[1][i] * y[1][j]) + x[2][i] * y[2][j];
    return out;
}

/// By the largest of the four squares (Shepperd 1978, "Quaternion from rotation matrix"), with w >= 0.
Quaternion quaternion_of(const Rows& m) {
    const double trace = (m[0][0] + m[1][1]) + m[2][2];
    Quaternion q;
    std::size_t i = 0;
    if (m[1][1] > m[i][i]) i = 1;
    if (m[2][2] > m[i][i]) i = 2;
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    if (trace >= m[i][i]) {
        q = {1 + trace, {m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]}};
    } else {
        q.w = m[k][j] - m[j][k];
        q.v[i] = 1 + m[i][i] - m[j][j] - m[k][k];
        q.v[j] = m[i][j] + m[j][i];
        q.v[k] = m[i][k] + m[k][i];
    }
    q = normalised(q);
    if (q.w < 0) q = {-q.w, {-q.v[0], -q.v[1], -q.v[2]}};
    return q;
}

double length_of(const Point& x) { return std::sqrt((x[0] * x[0] + x[1] * x[1]) + x[2] * x[2]); }

/// An upper bound of the length that does not overflow where the length does not.
double most_of(const Point& x) {
    return 1.75 * std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});  // sqrt(3) < 1.75
}

}  // namespace

void set_parts(Turn& turn) {
    // The same rotation twice is no turn, not one by what was rounded.
    if (turn.before.rotation != turn.after.rotation)
        turn.part[0] = quaternion_of(relative(turn.before.rotation, turn.after.rotation));
    for (std::size_t k = 0; k < k_levels; ++k) turn.part[k + 1] = half_of(turn.part[k]);
    // sin(a / 16) from the third half, a / 16 <= pi / 16: there x < 1.0066 sin x.
    turn.angle = 16 * 1.0067 * length_of(turn.part[3].v);
}

Quaternion part_at(const Turn& turn, double time) {
    Quaternion q;
    constexpr std::size_t k_exactly = 12;
    double left = time;
    for (std::size_t k = 0; k <= k_exactly; ++k, left *= 2) {
        if (left < 1) continue;
        q = product(q, turn.part[k]);
        left -= 1;
    }
    // Of a rotation by pi 2^-12 a part is that of the chord, normalised, but for its cube.
    const Quaternion& last = turn.part[k_exactly];
    const double part = left / 2;
    const Quaternion rest{1 - part + part * last.w, {part * last.v[0], part * last.v[1], part * last.v[2]}};
    return normalised(product(q, rest));
}

Point turned_at(const Turn& turn, const Point& x, double time) {
    return turned(turn.before, turned(part_at(turn, time), x));
}

Point out_at(const Turn& turn, const Point& x, double time) {
    const Point start = out_of(turn.before, turn.pivot);
    const Point end = out_of(turn.after, turn.pivot);
    Point off{};
    for (std::size_t k = 0; k < 3; ++k) off[k] = x[k] - turn.pivot[k];
    Point out = turned_at(turn, off, time);
    for (std::size_t k = 0; k < 3; ++k) out[k] += start[k] + time * (end[k] - start[k]);
    return out;
}

template <class Scalar>
Curve Curve::between(const Turn& turn, const Point& start, const Point& end) {
    Curve curve;
    curve.end = {start, end};
    for (std::size_t k = 0; k < 3; ++k) {
        curve.from[0][k] = start[k] - turn.pivot[k];
        curve.from[1][k] = end[k] - turn.pivot[k];
    }
    curve.from[1] = turned(turn.part[0], curve.from[1]);
    const double size = std::max(most_of(curve.from[0]), most_of(curve.from[1])) + most_of(turn.pivot);
    constexpr bool k_floats = sizeof(Scalar) == sizeof(float);
    curve.rounding =
        size * (k_floats ? 0x1p-21 : 0x1p-42) + 4 * static_cast<double>(std::numeric_limits<Scalar>::denorm_min());
    if (!(turn.angle > 0) || !(size > 0)) return curve;
    const double sine = length_of(turn.part[0].v);
    // The length of what is across the axis, in parts of `size`: no square overflows.
    const auto across = [&](const Point& x) {
        const Point c = cross_product(turn.part[0].v, {x[0] / size, x[1] / size, x[2] / size});
        return size * (length_of(c) / sine + 0x1p-48);
    };
    Point way{};
    for (std::size_t k = 0; k < 3; ++k) way[k] = curve.from[1][k] - curve.from[0][k];
    const double radius = std::max(across(curve.from[0]), across(curve.from[1]));
    curve.bend = turn.angle * (turn.angle * radius + 2 * across(way)) / 8;
    if (!std::isfinite(curve.bend)) {
        curve.rounding = std::numeric_limits<double>::infinity();
        return curve;
    }
    const double allowed = std::max(turn.tolerance - curve.rounding, curve.rounding);
    double off = curve.bend;
    while (curve.level < k_levels && off > allowed) {
        off /= 4;
        ++curve.level;
    }
    return curve;
}

template Curve Curve::between<float>(const Turn&, const Point&, const Point&);
template Curve Curve::between<double>(const Turn&, const Point&, const Point&);

}  // namespace pierce::detail
