// What a hit of a moving mesh says beside its decision: computed in double from the rounded time.
#include <query/moving_sweep.h>

#include <algorithm>
#include <cmath>

namespace pierce::detail {

namespace {

Point minus(const Point& x, const Point& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
Point mixed(const Point& x, const Point& y, double t) {
    return {x[0] + t * (y[0] - x[0]), x[1] + t * (y[1] - x[1]), x[2] + t * (y[2] - x[2])};
}
double dot(const Point& x, const Point& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
Point cross(const Point& x, const Point& y) {
    return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}
double largest(const Point& x) { return std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])}); }

/// Scaled by a power of two so that products neither overflow nor vanish.
void scale(Point& x, Point& y, Point& z) {
    const double size = std::max({largest(x), largest(y), largest(z)});
    if (!(size > 0)) return;
    const double by = std::ldexp(1.0, -std::clamp(std::ilogb(size), -1000, 1000));
    for (Point* p : {&x, &y, &z})
        for (double& v : *p) v *= by;
}

/// Where s lies between the ends of an edge, in [0, 1].
double along(const Point& edge, const Point& s) {
    const double square = dot(edge, edge);
    return square > 0 ? std::clamp(dot(edge, s) / square, 0.0, 1.0) : 0;
}

/// Weights for what the contact lies on exactly, clamped to the triangle.
Point weights_of(const Impact& impact, const Point& p, const Point& q, const Point& s, const Point& n) {
    const std::size_t i = impact.feature_index;
    Point w{};
    if (impact.feature == Feature::vertex) {
        w[i] = 1;
    } else if (impact.feature == Feature::edge) {
        const std::array<Point, 3> corners{Point{}, p, q};
        const std::size_t j = (i + 1) % 3;
        w[j] = along(minus(corners[j], corners[i]), minus(s, corners[i]));
        w[i] = 1 - w[j];
    } else {
        const double square = dot(n, n);
        const double b = square > 0 ? std::clamp(dot(cross(s, q), n) / square, 0.0, 1.0) : 0;
        const double c = square > 0 ? std::clamp(dot(cross(p, s), n) / square, 0.0, 1 - b) : 0;
        w = {1 - b - c, b, c};
    }
    return w;
}

}  // namespace

MovingValues values_at(const MovingPoint& point, const MovingCandidate& candidate, double time) {
    const Corners& before = candidate.triangle.at[0];
    const Corners& after = candidate.triangle.at[1];
    MovingValues values;
    // Relative to corner a, at both ends: differences of near coordinates lose little.
    const auto relative = [&](const Point& x, const Point& y) {
        return mixed(minus(x, before[0]), minus(y, after[0]), time);
    };
    Point p = relative(before[1], after[1]);
    Point q = relative(before[2], after[2]);
    Point s = relative(point.at[0], point.at[1]);
    scale(p, q, s);
    const Point n = cross(p, q);
    const double length = std::sqrt(dot(n, n));
    if (length > 0) values.normal = {n[0] / length, n[1] / length, n[2] / length};
    values.weights = weights_of(candidate.impact, p, q, s, n);
    const Point& w = values.weights;
    for (std::size_t k = 0; k < 3; ++k) {
        double at = 0;
        double motion = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            at += w[c] * (before[c][k] + time * (after[c][k] - before[c][k]));
            motion += w[c] * (after[c][k] - before[c][k]);
        }
        values.position[k] = at;
        values.motion[k] = motion;
    }
    return values;
}

Point carried(const MovingPoint& point, const MovingCandidate& candidate, const MovingValues& values) {
    const Corners& before = candidate.triangle.at[0];
    const Corners& after = candidate.triangle.at[1];
    Point p = minus(before[1], before[0]), q = minus(before[2], before[0]), s = minus(point.at[0], before[0]);
    const double size = std::max({largest(p), largest(q), largest(s)});
    scale(p, q, s);
    const Point n = cross(p, q);
    const double square = dot(n, n);
    const Point turned = values_at(point, candidate, 1).normal;
    Point to;
    for (std::size_t k = 0; k < 3; ++k) to[k] = point.at[0][k] + values.motion[k];
    if (!(square > 0) || turned == Point{}) return to;
    const double b = dot(cross(s, q), n) / square;
    const double c = dot(cross(p, s), n) / square;
    const double unit = largest(s) > 0 ? largest(minus(point.at[0], before[0])) / largest(s) : size;
    const double off = dot(s, n) / std::sqrt(square) * unit;
    for (std::size_t k = 0; k < 3; ++k)
        to[k] = after[0][k] + b * (after[1][k] - after[0][k]) + c * (after[2][k] - after[0][k]) + off * turned[k];
    return to;
}

MovingValues values_of(const MovingPoint& point, Sides sides, const MovingCandidate& candidate) {
    const Impact sharp = sharpened(point, rule_of(sides), candidate.triangle, candidate.impact);
    MovingValues values = values_at(point, candidate, sharp.earliest + (sharp.latest - sharp.earliest) / 2);
    values.time = sharp.earliest;
    return values;
}

}  // namespace pierce::detail
