// Where a point may lie near a hit, as half-spaces around the true point, in units of the search: which of their common
// points is nearest, and the half-spaces that lead out from behind a triangle. Nothing here is certain: whether a place
// is clear is asked of the mesh.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <exact/decide.h>

namespace pierce::detail {

[[nodiscard]] inline double dot_product(const Point& p, const Point& q) {
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}
[[nodiscard]] inline Point cross_product(const Point& p, const Point& q) {
    return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}
[[nodiscard]] inline Point difference_of(const Point& p, const Point& q) {
    return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

/// `vector` made one of length 1, by way of one whose largest component is 1, which no exponent troubles; false for 0,
/// NaN and what is infinite.
[[nodiscard]] inline bool normalise(Point& vector) {
    const double most = std::max({std::abs(vector[0]), std::abs(vector[1]), std::abs(vector[2])});
    if (!(most > 0) || !std::isfinite(most)) return false;
    for (double& x : vector) x /= most;
    const double length = std::sqrt(dot_product(vector, vector));
    for (double& x : vector) x /= length;
    return std::isfinite(length);
}

/// The points x with normal . x >= least. The normal has length 1.
struct HalfSpace {
    Point normal;
    double least;
};

class HalfSpaces {
  public:
    static constexpr std::size_t k_most = 8;

    [[nodiscard]] bool full() const { return count_ == k_most; }
    void push(const HalfSpace& half_space) { all_[count_++] = half_space; }
    void pop() { --count_; }

    /// The point of all of them that is nearest to 0, within a hundredth or so; false where it is further than `reach`,
    /// or two planes meet at less than a twentieth of a degree.
    ///
    /// Hildreth's method (1957): x = sum of l_i normal_i, and one l_i after the other is set to what its own half-space
    /// asks for, but not below 0. It climbs the dual function sum l_i least_i - x . x / 2, which is nowhere above half
    /// the square that is looked for. Two that meet at an angle a come nearer by (cos a)^2 a sweep: at 15 degrees or
    /// more 64 sweeps will do. Where they don't, the corners are gone through.
    [[nodiscard]] bool nearest(double reach, Point& x) const {
        std::array<double, k_most> share{};
        x = {};
        for (int sweep = 0; sweep < 64; ++sweep) {
            double most = 0;
            for (std::size_t i = 0; i < count_; ++i) {
                const double by = std::max(all_[i].least - dot_product(all_[i].normal, x), -share[i]);
                share[i] += by;
                for (std::size_t k = 0; k < 3; ++k) x[k] += by * all_[i].normal[k];
                most = std::max(most, std::abs(by));
            }
            double dual = -dot_product(x, x) / 2;
            for (std::size_t i = 0; i < count_; ++i) dual += share[i] * all_[i].least;
            if (!(dual <= reach * reach / 2)) return false;
            if (most < 0.01) return true;
        }
        return nearest_corner(reach, x);
    }

  private:
    /// The same by all places that one to three planes have in common and that are nearest to 0: it is one of these.
    [[nodiscard]] bool nearest_corner(double reach, Point& x) const {
        double least = reach * reach;
        bool found = false;
        const auto try_corner = [&](const Point& corner) {
            const double square = dot_product(corner, corner);
            if (!(square <= least)) return;
            for (std::size_t i = 0; i < count_; ++i)
                if (!(dot_product(all_[i].normal, corner) >= all_[i].least - 0.01)) return;
            least = square;
            x = corner;
            found = true;
        };
        const auto sum = [](const Point& p, double by_p, const Point& q, double by_q) {
            return Point{by_p * p[0] + by_q * q[0], by_p * p[1] + by_q * q[1], by_p * p[2] + by_q * q[2]};
        };
        for (std::size_t i = 0; i < count_; ++i) {
            const auto& [n, n_least] = all_[i];
            try_corner(sum(n, n_least, n, 0));
            for (std::size_t j = i + 1; j < count_; ++j) {
                const auto& [m, m_least] = all_[j];
                const Point line = cross_product(n, m);
                const double sine2 = dot_product(line, line);
                if (sine2 < k_least_sine * k_least_sine) continue;
                const Point on_line =
                    sum(cross_product(m, line), n_least / sine2, cross_product(line, n), m_least / sine2);
                try_corner(on_line);
                for (std::size_t k = j + 1; k < count_; ++k) {
                    const auto& [o, o_least] = all_[k];
                    const double along = dot_product(line, o);
                    if (std::abs(along) < k_least_sine) continue;
                    try_corner(sum(on_line, 1, line, (o_least - dot_product(o, on_line)) / along));
                }
            }
        }
        return found;
    }
    static constexpr double k_least_sine = 1e-3;

    std::array<HalfSpace, k_most> all_{};
    std::size_t count_ = 0;
};

/// Places around a point, `high + low + unit x`, each rounded: which moves it by `rounding[k]` of a unit at most.
struct Around {
    Point high;
    Point low;
    double unit;
    Point rounding;

    /// The half-space of the x beyond the plane through `on` (one of its points, near), whatever rounding does to them.
    [[nodiscard]] HalfSpace beyond(const Point& normal, const Point& on) const {
        const double at = (dot_product(normal, difference_of(high, on)) + dot_product(normal, low)) / unit;
        return {normal, slack(normal) - at};
    }
    [[nodiscard]] double slack(const Point& normal) const {
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) sum += std::abs(normal[k]) * rounding[k];
        return sum;
    }
};

/// The ways out for a way from `from` to about `around` that a triangle stops: back to the start's side of its plane,
/// or past an edge, that is, out of the pyramid that the triangle and `from` span. What is clear of it lies in one of
/// them.
struct WaysOut {
    std::array<HalfSpace, 4> all;
    std::size_t count = 0;

    /// `decision`: of the hit on that triangle. Seen from its front the corners are counter-clockwise; what starts on
    /// its plane sees it edge-on, and only its plane leads out.
    WaysOut(const Corners& corners, const Decision& decision, const Point& from, const Around& around) {
        const double side = decision.side == Sides::front ? 1 : -1;
        const auto nearer = [&](const Point& p, const Point& q) {
            const Point to_p = difference_of(p, around.high);
            const Point to_q = difference_of(q, around.high);
            return dot_product(to_p, to_p) < dot_product(to_q, to_q) ? p : q;
        };
        Point normal = cross_product(difference_of(corners[1], corners[0]), difference_of(corners[2], corners[0]));
        for (double& x : normal) x *= side;
        if (normalise(normal)) all[count++] = around.beyond(normal, nearer(corners[0], nearer(corners[1], corners[2])));
        if (decision.at_start) return;
        std::array<Point, 3> seen{};
        for (std::size_t k = 0; k < 3; ++k) {
            seen[k] = difference_of(corners[k], from);
            if (!normalise(seen[k])) return;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = (k + 1) % 3;
            const std::size_t j = (k + 2) % 3;
            normal = cross_product(seen[i], seen[j]);
            for (double& x : normal) x *= side;
            if (!normalise(normal)) continue;
            all[count++] = around.beyond(normal, nearer(from, nearer(corners[i], corners[j])));
        }
    }
};

}  // namespace pierce::detail
