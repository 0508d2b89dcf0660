// A judge for rays: the rules for a half-line or a part of one, in integers of GMP. Nothing of the library is asked but
// the words that an answer is given in.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <gmpxx.h>

#include <pierce/mesh_view.h>
#include <pierce/ray.h>

namespace pierce::test {

/// What a ray does to one triangle.
struct RayMeeting {
    bool hit = false;
    Sides side = Sides::front;
    Feature feature = Feature::face;
    std::uint8_t feature_index = 0;
    bool at_start = false;
    mpq_class parameter;  ///< t, where it is hit
    int crossing = 0;     ///< by the rule for counting
};

template <class Scalar>
class RayOracle {
  public:
    explicit RayOracle(const Ray<Scalar>& ray)
        : origin_(exact(ray.origin)), direction_(exact(ray.direction)), endless_(std::isinf(ray.limit)) {
        if (!endless_) limit_ = static_cast<double>(ray.limit);
    }

    RayMeeting meet(const std::array<Vec3<Scalar>, 3>& corners, Sides sides) const {
        const V a = exact(corners[0]);
        const V b = exact(corners[1]);
        const V c = exact(corners[2]);
        const V n = cross(minus(b, a), minus(c, a));
        RayMeeting out;
        const mpq_class start = dot(n, minus(origin_, a));
        const mpq_class slope = dot(n, direction_);
        const int from = sgn(start);
        const int to = end_sign(start, slope);
        const std::array<V, 3> at = {minus(a, origin_), minus(b, origin_), minus(c, origin_)};
        std::array<int, 3> weight{};
        std::array<int, 3> moved{};
        for (std::size_t k = 0; k < 3; ++k) {
            const V& next = at[(k + 1) % 3];
            const V& last = at[(k + 2) % 3];
            weight[k] = sgn(dot(direction_, cross(last, next)));
            // Moved by (e, e^2, e^3): the first component that is not 0 tells.
            moved[k] = weight[k] != 0 ? weight[k] : first_sign(cross(direction_, minus(next, last)));
        }
        set_hit(sides, from, to, weight, out);
        if (out.hit) out.parameter = -start / slope;
        const int tie = first_sign(n);
        const int here = from != 0 ? from : tie;
        const int there = to != 0 ? to : tie;
        if (tie != 0 && here != there && moved[0] == here && moved[1] == here && moved[2] == here) out.crossing = here;
        return out;
    }

  private:
    using V = std::array<mpq_class, 3>;

    static V exact(const Vec3<Scalar>& p) {
        return {mpq_class(static_cast<double>(p[0])), mpq_class(static_cast<double>(p[1])),
                mpq_class(static_cast<double>(p[2]))};
    }
    static V minus(const V& x, const V& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
    static mpq_class dot(const V& x, const V& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
    static V cross(const V& x, const V& y) {
        return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
    }
    static int first_sign(const V& x) {
        for (const mpq_class& component : x)
            if (sgn(component) != 0) return sgn(component);
        return 0;
    }
    // Of the side on which the ray ends; one without an end goes on to where its slope leads.
    int end_sign(const mpq_class& start, const mpq_class& slope) const {
        if (!endless_) return sgn(mpq_class(start + limit_ * slope));
        return sgn(slope) != 0 ? sgn(slope) : sgn(start);
    }
    static void set_hit(Sides sides, int from, int to, const std::array<int, 3>& weight, RayMeeting& out) {
        const bool front = from >= 0 && to < 0 && sides != Sides::back;
        const bool back = sides == Sides::both ? from < 0 && to >= 0 : sides == Sides::back && from <= 0 && to > 0;
        if (!front && !back) return;
        int zeros = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            if (weight[k] == (front ? -1 : 1)) return;
            zeros += weight[k] == 0 ? 1 : 0;
        }
        out.hit = true;
        out.side = front ? Sides::front : Sides::back;
        out.at_start = from == 0;
        for (std::size_t k = 0; k < 3; ++k) {
            if (zeros == 1 && weight[k] == 0) {
                out.feature = Feature::edge;
                out.feature_index = static_cast<std::uint8_t>((k + 1) % 3);
            }
            if (zeros == 2 && weight[k] != 0) {
                out.feature = Feature::vertex;
                out.feature_index = static_cast<std::uint8_t>(k);
            }
        }
    }

    V origin_;
    V direction_;
    bool endless_;
    mpq_class limit_;
};

}  // namespace pierce::test
