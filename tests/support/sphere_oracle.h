// A judge for spheres in rational numbers, written from the definition: squared distances of points, segments and
// triangles, each as the least over what may be nearest, and nothing else of the library.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <gmpxx.h>

#include <path.h>

namespace pierce::test {

class SphereOracle {
  public:
    using Number = mpq_class;
    using Vector = std::array<Number, 3>;

    SphereOracle(const detail::Path& path, double radius)
        : from_(exact(path.from)),
          way_(minus(exact(path.to), from_)),
          radius_(radius),
          path_(path),
          square_(radius_ * radius_) {}

    /// Whether the sphere hits the triangle on the first `part` of its way.
    [[nodiscard]] bool hits(const detail::Corners& corners, const Number& part = 1) const {
        if (certainly_apart(corners)) return false;
        const Triangle t = {exact(corners[0]), exact(corners[1]), exact(corners[2])};
        Vector nearest;
        if (point_triangle(from_, t, &nearest) <= square_) return dot(minus(from_, nearest), way_) < 0;
        return segment_triangle(from_, plus(from_, way_, part), t) < square_;
    }
    /// Whether it hits or overlaps the triangle at the start.
    [[nodiscard]] bool overlaps(const detail::Corners& corners) const { return distance_at_start(corners) < square_; }
    /// The squared distance at the start, less the squared radius: its sign.
    [[nodiscard]] int gap(const detail::Corners& corners) const {
        const Number d = distance_at_start(corners);
        return d < square_ ? -1 : d > square_ ? 1 : 0;
    }

  private:
    using Triangle = std::array<Vector, 3>;

    [[nodiscard]] Number distance_at_start(const detail::Corners& corners) const {
        return point_triangle(from_, {exact(corners[0]), exact(corners[1]), exact(corners[2])}, nullptr);
    }

    // Boxes that are further apart than the radius along an axis, by more than doubles could be wrong about.
    [[nodiscard]] bool certainly_apart(const detail::Corners& corners) const {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax({corners[0][k], corners[1][k], corners[2][k]});
            const auto [first, last] = std::minmax(path_.from[k], path_.to[k]);
            const double scale = std::abs(low) + std::abs(high) + std::abs(first) + std::abs(last) + radius_.get_d();
            if (std::max(first - high, low - last) > radius_.get_d() + 1e-12 * scale) return true;
        }
        return false;
    }

    static Vector exact(const detail::Point& p) { return {p[0], p[1], p[2]}; }
    static Vector minus(const Vector& x, const Vector& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
    static Vector plus(const Vector& x, const Vector& y, const Number& s) {
        return {x[0] + s * y[0], x[1] + s * y[1], x[2] + s * y[2]};
    }
    static Number dot(const Vector& x, const Vector& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
    static Vector cross(const Vector& x, const Vector& y) {
        return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
    }
    static Number clamped(const Number& x) { return x < 0 ? Number(0) : x > 1 ? Number(1) : x; }

    static Vector nearest_on_segment(const Vector& x, const Vector& a, const Vector& b) {
        const Vector u = minus(b, a);
        const Number square = dot(u, u);
        return square == 0 ? a : plus(a, u, clamped(dot(minus(x, a), u) / square));
    }
    static Number square_of(const Vector& x) { return dot(x, x); }

    // The least of: the foot of the perpendicular, if it lies in the triangle, and the nearest points of the edges.
    static Number point_triangle(const Vector& x, const Triangle& t, Vector* nearest) {
        std::optional<Number> least;
        const auto offer = [&](const Vector& y) {
            const Number d = square_of(minus(x, y));
            if (least && *least <= d) return;
            least = d;
            if (nearest != nullptr) *nearest = y;
        };
        for (std::size_t k = 0; k < 3; ++k) offer(nearest_on_segment(x, t[k], t[(k + 1) % 3]));
        const Vector n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
        const Vector foot = plus(x, n, -dot(minus(x, t[0]), n) / square_of(n));
        bool inside = true;
        for (std::size_t k = 0; k < 3; ++k)
            inside = inside && dot(cross(minus(t[(k + 1) % 3], t[k]), minus(foot, t[k])), n) >= 0;
        if (inside) offer(foot);
        return *least;
    }

    static Number segment_segment(const Vector& p, const Vector& q, const Vector& a, const Vector& b) {
        Number least = square_of(minus(p, nearest_on_segment(p, a, b)));
        least = std::min(least, square_of(minus(q, nearest_on_segment(q, a, b))));
        least = std::min(least, square_of(minus(a, nearest_on_segment(a, p, q))));
        least = std::min(least, square_of(minus(b, nearest_on_segment(b, p, q))));
        // The common perpendicular, by the normal equations of the two parameters.
        const Vector v = minus(q, p);
        const Vector u = minus(b, a);
        const Vector w = minus(p, a);
        const Number vv = dot(v, v), uu = dot(u, u), uv = dot(u, v), vw = dot(v, w), uw = dot(u, w);
        const Number whole = vv * uu - uv * uv;
        if (whole == 0) return least;
        const Number s = (uv * uw - uu * vw) / whole;
        const Number r = (vv * uw - uv * vw) / whole;
        if (s < 0 || s > 1 || r < 0 || r > 1) return least;
        return std::min(least, square_of(minus(plus(p, v, s), plus(a, u, r))));
    }

    static Number segment_triangle(const Vector& p, const Vector& q, const Triangle& t) {
        Number least = std::min(point_triangle(p, t, nullptr), point_triangle(q, t, nullptr));
        for (std::size_t k = 0; k < 3; ++k) least = std::min(least, segment_segment(p, q, t[k], t[(k + 1) % 3]));
        const Vector n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
        const Number from = dot(minus(p, t[0]), n);
        const Number to = dot(minus(q, t[0]), n);
        if ((from < 0) == (to < 0) || from == to) return least;
        const Vector x = plus(p, minus(q, p), from / (from - to));
        for (std::size_t k = 0; k < 3; ++k)
            if (dot(cross(minus(t[(k + 1) % 3], t[k]), minus(x, t[k])), n) < 0) return least;
        return 0;
    }

    Vector from_;
    Vector way_;
    Number radius_;
    detail::Path path_;
    Number square_;
};

}  // namespace pierce::test
