// What a triangle hides from the start of a way: what lies behind its plane and inside the pyramid that start and
// triangle span. A way to there hits the triangle, a way to anywhere else misses it. Four half-spaces tell which, as
// those of WaysOut in half_spaces.h; but here the answer is certain, or there is none.
//
// Near: all is relative to an origin close to the places that are asked about, in units of the search, so that what is
// a part of a unit away is told apart whatever the coordinates are.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <query/half_spaces.h>

namespace pierce::detail {

/// What a triangle is to a place, seen from the start of the ways: certainly beside the way to it (or behind it), or
/// certainly in the way, or neither is certain.
enum class Seen : std::uint8_t { beside, hidden, unsure };

class Shadow {
  public:
    /// A place may be so far from the origin, in each coordinate, in units.
    static constexpr double k_most = 25;

    Shadow() = default;  ///< nothing is set: many are kept where few are needed

    /// `unit`: a power of two.
    ///
    /// The normals are U x W, not normalised, of differences of corners and start. With u = 2^-53 and m(U) the largest
    /// |component|, each difference is off by u of itself, and so each component of U x W by 4.2 u M, where
    /// M = 2 m(U) m(W), which no component exceeds by more than 5 u of it. Place and origin relative to a point of the
    /// plane are y and g: differences as well, each off by u of itself. So of normal . (y + g) the products and sums
    /// lose 4.1 u M sum(|y| + |g|), the normal's own error 4.2 u M as much, and the sum with the bound below 1.1 u M of
    /// it: 9.4 in all. Twice as much, less what is kept for the roundings here and for underflow, is 16 u M.
    Shadow(const Corners& corners, const Point& from, const Point& origin, double unit) : start_side_(0) {
        const Point u = difference_of(corners[1], corners[0]);
        const Point w = difference_of(corners[2], corners[0]);
        std::array<Point, 3> seen{};
        std::array<Point, 3> at{};  // from each corner to the origin
        std::array<double, 3> near{};
        for (std::size_t k = 0; k < 3; ++k) {
            seen[k] = difference_of(corners[k], from);
            at[k] = difference_of(origin, corners[k]);
            for (double& x : at[k]) x /= unit;
            near[k] = sum(at[k]);
        }
        const auto nearer = [&](std::size_t i, std::size_t j) { return near[i] < near[j] ? i : j; };

        // On which side the start is.
        const Point normal = cross_product(u, w);
        const double scale = 2 * largest(u) * largest(w);
        const double distance = -dot_product(normal, seen[0]);
        const double error = k_error * scale * sum(seen[0]);
        if (!(scale > k_least && error < k_largest && std::abs(distance) > error + k_least)) {
            planes_.fill(Plane::none());
            return;
        }
        const double sign = std::copysign(1.0, distance);
        start_side_ = distance > 0 ? 1 : -1;

        // The edges first: of many faces around a corner all but one or two are told by these.
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = (k + 1) % 3;
            const std::size_t j = (k + 2) % 3;
            planes_[k] = Plane::through(cross_product(seen[i], seen[j]), 2 * largest(seen[i]) * largest(seen[j]), sign,
                                        at[nearer(i, j)]);
        }
        planes_[3] = Plane::through(normal, scale, sign, at[nearer(0, nearer(1, 2))]);
    }

    /// Of the start: 1 in front of the triangle, -1 behind it, 0 where that is not certain.
    [[nodiscard]] int start_side() const { return start_side_; }

    /// `place`: relative to the origin, in units, each coordinate rounded once.
    ///
    /// Strictly on the start's side of the plane no way hits, nor strictly beyond an edge: from the start on all of the
    /// way is there. Strictly inside of all four the way passes through the triangle's inside, to the other side.
    [[nodiscard]] Seen seen(const Point& place) const {
        bool hidden = true;
        for (const Plane& plane : planes_) {
            const double by = dot_product(plane.normal, place);
            if (by > plane.beside) return Seen::beside;
            hidden &= by < plane.hidden;
        }
        return hidden ? Seen::hidden : Seen::unsure;
    }
    [[nodiscard]] bool hides(const Point& place) const {
        return dot_product(planes_[0].normal, place) < planes_[0].hidden &&
               dot_product(planes_[1].normal, place) < planes_[1].hidden &&
               dot_product(planes_[2].normal, place) < planes_[2].hidden &&
               dot_product(planes_[3].normal, place) < planes_[3].hidden;
    }

  private:
    static constexpr double k_error = 0x1p-49;  ///< 16 u
    /// Between these nothing overflows; and what underflows, 2^-1075 in a product, does not matter beside the error.
    static constexpr double k_least = 0x1p-900;
    static constexpr double k_largest = 0x1p900;

    [[nodiscard]] static double sum(const Point& p) { return std::abs(p[0]) + std::abs(p[1]) + std::abs(p[2]); }
    [[nodiscard]] static double largest(const Point& p) {
        return std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
    }

    /// Its normal leads out of what is hidden.
    struct Plane {
        Point normal;
        double hidden;  ///< below this a place is certainly inside
        double beside;  ///< above this certainly outside

        static Plane none() {
            constexpr double infinity = std::numeric_limits<double>::infinity();
            return {{0, 0, 0}, -infinity, infinity};
        }
        static Plane through(const Point& vector, double scale, double sign, const Point& to_origin) {
            const double error = k_error * scale * (sum(to_origin) + 3 * k_most);
            if (!(scale > k_least && error < k_largest)) return none();
            const double at = sign * dot_product(vector, to_origin);
            return {{sign * vector[0], sign * vector[1], sign * vector[2]}, -at - error, -at + error};
        }
    };
    std::array<Plane, 4> planes_;
    int start_side_;
};

}  // namespace pierce::detail
