// A judge for spheres in rational numbers, written from the definition: squared distances of points, segments and
// triangles, each as the least over what may be nearest, and nothing of the library. Where numbers of 113 bits leave no
// doubt by far it takes their word: so that it can judge millions.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <gmpxx.h>

#include <path.h>

namespace pierce::test {

__extension__ typedef __float128 Quad;

/// Squared distances, in any numbers.
template <class Number>
struct Distances {
    using Vector = std::array<Number, 3>;
    using Triangle = std::array<Vector, 3>;

    static Vector exact(const detail::Point& p) { return {Number(p[0]), Number(p[1]), Number(p[2])}; }
    static Triangle exact(const detail::Corners& c) { return {exact(c[0]), exact(c[1]), exact(c[2])}; }
    static Vector minus(const Vector& x, const Vector& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
    static Vector plus(const Vector& x, const Vector& y, const Number& s) {
        return {x[0] + s * y[0], x[1] + s * y[1], x[2] + s * y[2]};
    }
    static Number dot(const Vector& x, const Vector& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
    static Vector cross(const Vector& x, const Vector& y) {
        return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
    }
    static Number clamped(const Number& x) { return x < Number(0) ? Number(0) : x > Number(1) ? Number(1) : x; }

    static Vector nearest_on_segment(const Vector& x, const Vector& a, const Vector& b) {
        const Vector u = minus(b, a);
        const Number square = dot(u, u);
        return square == Number(0) ? a : plus(a, u, clamped(Number(dot(minus(x, a), u) / square)));
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
        const Vector foot = plus(x, n, Number(-dot(minus(x, t[0]), n) / square_of(n)));
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
        const Vector x = plus(p, minus(q, p), Number(from / (from - to)));
        for (std::size_t k = 0; k < 3; ++k)
            if (dot(cross(minus(t[(k + 1) % 3], t[k]), minus(x, t[k])), n) < 0) return least;
        return 0;
    }
};

class SphereOracle {
  public:
    using Number = mpq_class;

    SphereOracle(const detail::Path& path, double radius)
        : path_(path), radius_(radius), square_(Number(radius) * Number(radius)) {}

    /// Whether the sphere hits the triangle on the first `part` of its way.
    [[nodiscard]] bool hits(const detail::Corners& corners, const Number& part = 1) const {
        if (certainly_apart(corners)) return false;
        const double about = part.get_d();
        const Quad fine_part = Quad(about) + Quad(Number(part - about).get_d());
        if (const int sure = surely<Quad>(corners, fine_part); sure != 0) return sure > 0;
        using Exact = Distances<Number>;
        const auto from = Exact::exact(path_.from);
        const auto way = Exact::minus(Exact::exact(path_.to), from);
        const auto t = Exact::exact(corners);
        Exact::Vector nearest;
        if (Exact::point_triangle(from, t, &nearest) <= square_)
            return Exact::dot(Exact::minus(from, nearest), way) < 0;
        return Exact::segment_triangle(from, Exact::plus(from, way, part), t) < square_;
    }
    /// The sign of the distance at the start, less the radius.
    [[nodiscard]] int gap(const detail::Corners& corners) const {
        using Rough = Distances<Quad>;
        if (const double tolerance = tolerance_for(corners); tolerance >= 0) {
            const Quad rough = Rough::point_triangle(Rough::exact(path_.from), Rough::exact(corners), nullptr) -
                               Quad(radius_) * Quad(radius_);
            if (rough > tolerance || rough < -tolerance) return rough < 0 ? -1 : 1;
        }
        using Exact = Distances<Number>;
        const Number d = Exact::point_triangle(Exact::exact(path_.from), Exact::exact(corners), nullptr);
        return d < square_ ? -1 : d > square_ ? 1 : 0;
    }

  private:
    // 1: hit, -1: not hit, 0: too near to say, or in contact at the start.
    template <class Rough_>
    [[nodiscard]] int surely(const detail::Corners& corners, Rough_ part) const {
        using Rough = Distances<Rough_>;
        const double tolerance = tolerance_for(corners);
        if (tolerance < 0) return 0;
        const auto from = Rough::exact(path_.from);
        const auto way = Rough::minus(Rough::exact(path_.to), from);
        const auto t = Rough::exact(corners);
        const Rough_ square = Rough_(radius_) * Rough_(radius_);
        if (Rough::point_triangle(from, t, nullptr) - square < tolerance) return 0;
        const Rough_ gap = Rough::segment_triangle(from, Rough::plus(from, way, part), t) - square;
        return gap > tolerance ? -1 : gap < -tolerance ? 1 : 0;
    }

    // 2^-113 times the square of what is in play, times 2^53 for the shape of a triangle that is not too thin: its sine
    // enters twice. Less than 0: it is too thin.
    [[nodiscard]] double tolerance_for(const detail::Corners& corners) const {
        using Plain = Distances<double>;
        const Plain::Vector u = Plain::minus(corners[1], corners[0]);
        const Plain::Vector v = Plain::minus(corners[2], corners[0]);
        const Plain::Vector w = Plain::minus(corners[2], corners[1]);
        const double longest = std::max({Plain::square_of(u), Plain::square_of(v), Plain::square_of(w)});
        if (Plain::square_of(Plain::cross(u, v)) < 1e-6 * longest * longest) return -1;
        double largest = radius_;
        for (const detail::Point& p : {path_.from, path_.to, corners[0], corners[1], corners[2]})
            for (const double x : p) largest = std::max(largest, std::abs(x));
        return largest * largest * 0x1p-60;
    }

    // Boxes that are further apart than the radius along an axis, by more than doubles could be wrong about.
    [[nodiscard]] bool certainly_apart(const detail::Corners& corners) const {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax({corners[0][k], corners[1][k], corners[2][k]});
            const auto [first, last] = std::minmax(path_.from[k], path_.to[k]);
            const double scale = std::abs(low) + std::abs(high) + std::abs(first) + std::abs(last) + radius_;
            if (std::max(first - high, low - last) > radius_ + 1e-12 * scale) return true;
        }
        return false;
    }

    detail::Path path_;
    double radius_;
    Number square_;
};

}  // namespace pierce::test
