// The nearest point of a triangle, in plain doubles: near enough to begin with, and nothing is decided by it.
#pragma once

#include <bit>
#include <cstdint>

#include <pierce/sides.h>
#include <sphere/vector.h>

namespace pierce::detail {

/// `point` is the corner 0 moved by `second` times the edge to corner 1 and `third` times that to corner 2, both at
/// least 0 and their sum at most 1, but for its rounding.
struct Nearest {
    Feature feature = Feature::face;
    unsigned index = 0;
    double second = 0;
    double third = 0;
    Point point{};
};

/// Ericson 2005, "Real-Time Collision Detection", 5.1.5. Where a triangle is so thin that its area is lost, a corner.
[[nodiscard]] inline Nearest nearest_of(const Corners& corners, const Point& x) {
    const auto& [a, b, c] = corners;
    const Point ab = minus(b, a);
    const Point ac = minus(c, a);
    const auto part_of = [](double p, double q) { return p > 0 ? std::min(p / (p + q), 1.0) : 0.0; };
    const Point from_a = minus(x, a);
    const double a_b = dot(ab, from_a);
    const double a_c = dot(ac, from_a);
    if (a_b <= 0 && a_c <= 0) return {Feature::vertex, 0, 0, 0, a};
    const Point from_b = minus(x, b);
    const double b_b = dot(ab, from_b);
    const double b_c = dot(ac, from_b);
    if (b_b >= 0 && b_c <= b_b) return {Feature::vertex, 1, 1, 0, b};
    const Point from_c = minus(x, c);
    const double c_b = dot(ab, from_c);
    const double c_c = dot(ac, from_c);
    if (c_c >= 0 && c_b <= c_c) return {Feature::vertex, 2, 0, 1, c};
    const double of_c = a_b * b_c - b_b * a_c;
    if (of_c <= 0 && a_b >= 0 && b_b <= 0) {
        const double s = part_of(a_b, -b_b);
        return {Feature::edge, 0, s, 0, plus(a, times(s, ab))};
    }
    const double of_b = c_b * a_c - a_b * c_c;
    if (of_b <= 0 && a_c >= 0 && c_c <= 0) {
        const double s = part_of(a_c, -c_c);
        return {Feature::edge, 2, 0, s, plus(a, times(s, ac))};
    }
    const double of_a = b_b * c_c - c_b * b_c;
    if (of_a <= 0 && b_c >= b_b && c_b >= c_c) {
        const double s = part_of(b_c - b_b, c_b - c_c);
        return {Feature::edge, 1, 1 - s, s, plus(b, times(s, minus(c, b)))};
    }
    const double sum = of_a + of_b + of_c;
    if (!(of_a >= 0 && of_b >= 0 && of_c >= 0 && sum > 0)) return {Feature::vertex, 0, 0, 0, a};
    const double second = of_b / sum;
    const double third = std::min(of_c / sum, 1 - second);
    return {Feature::face, 0, second, third, plus(a, plus(times(second, ab), times(third, ac)))};
}

/// n times a power of two, the largest |component| at least 1 and below 2; 0 where that is not a normal number.
[[nodiscard]] inline Point scaled(const Point& n) {
    const std::uint64_t exponent = std::bit_cast<std::uint64_t>(size_of(n)) >> 52;
    if (exponent == 0 || exponent >= 2046) return Point{};
    return times(std::bit_cast<double>((2046 - exponent) << 52), n);
}

/// About in the direction from the nearest point to x, scaled; 0 where there is none. Across the plane of a face, or an
/// edge, which the difference of two near points need not be.
[[nodiscard]] inline Point direction_from(const Corners& corners, const Nearest& nearest, const Point& x) {
    if (nearest.feature == Feature::face) {
        const Point n = scaled(cross(minus(corners[1], corners[0]), minus(corners[2], corners[0])));
        return dot(n, minus(x, nearest.point)) < 0 ? times(-1, n) : n;
    }
    Point n = scaled(minus(x, nearest.point));
    if (nearest.feature == Feature::edge) {
        // Twice: what is left of the edge's direction is then as small as the rest of n allows.
        const Point e = scaled(minus(corners[(nearest.index + 1) % 3], corners[nearest.index]));
        const double square = dot(e, e);
        for (int i = 0; i < 2 && square > 0; ++i) n = minus(n, times(dot(n, e) / square, e));
        n = scaled(n);
    }
    return n;
}

}  // namespace pierce::detail
