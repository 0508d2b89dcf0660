// The narrow phase: Bloom's segment-triangle test with an error bound, so that it says hit, miss or doubtful and is never wrong
// about the first two.
//
// Source: Bloom 2002, "Fast ray tri (with precomputation)". Departures: the signs of one line of the listing are put right
// and the normal points to the front; planes are evaluated relative to the corner b; the comparisons have bounds.
//
//   F0, F1   normal . (x - b) at the segment's ends                  > 0 in front
//   D        F0 - F1                                                 > 0 for a segment that comes from the front
//   wc, wa   the barycentric planes of c and a times D, at the point where the line meets the plane:
//            F0 w(to) - F1 w(from), for w(x) = weight . (x - b)
//   wb       D - wc - wa
//
// The bound. Let u = 2^-52, so that every operation is exact up to a factor 1 + d, |d| <= u, in whatever rounding mode (2^-53 if
// to nearest); the stored coefficients, rounded once from exact values, have the same. S, Sc, Sa stand for the sums of
// the magnitudes of the three coefficients of a plane; R for the largest magnitude in the computed differences x - b.
//
//   1. F = sum of c_i (x_i - b_i). Each term gathers at most five factors (the coefficient, the difference, the product, two
//      additions), so |err| <= ((1+u)^5 - 1) S R (1+u)^2 < 6u S R =: e. Likewise 6u Sc R and 6u Sa R for the weights.
//      |F| <= S R (1 + 5u) for the computed F, and so on.
//   2. |err D| <= 2e + u |D| <= 12u S R + 2u S R (1 + 6u) < 18u S R = 3e.
//   3. A product F w: |err| <= |F| 6u Sc R + |w| e + e 6u Sc R < 12u (1 + 12u) S Sc R^2. wc is a difference of two of them, each
//      rounded (u S Sc R^2 (1+12u) each) and rounded again (u times at most 2 S Sc R^2 (1+12u)): 24 + 2 + 2 = 28u, and
//      what is of second order is below u: |err wc| < 30u S Sc R^2 =: ec. Likewise ea.
//   4. wb: |err| <= 3e + ec + ea + u (|D| + |wc|) + u (|D| + |wc| + |wa|), where |D| <= 2 S R (1+..) and |wc| <= 2 S Sc R^2 (1+..):
//      3e + ec + ea + 4u S R + 4u S Sc R^2 + 2u S Sa R^2 < 4e + 1.25 (ec + ea).
//   The bounds themselves are computed with a few roundings; the slack above (28 to 30, 14 to 18, 22 to 24) is a thousand
//   million times larger.
//   5. Underflow: with 2^-300 <= R <= 2^300, 2^-300 <= Sc, Sa <= 2^300 (else their bound is infinite) and 1/2 <= S <= 3, e is
//      at least 2^-352, the weights' 6u S_ R at least 2^-650, ec and ea at least 2^-950. A coefficient, product or coordinate that
//      underflows, even when flushed to zero, adds at most 2^-1022 times a factor below 2^301 to them: far below the slack.
//      Outside of that range of R the answer is doubtful. So it is for NaN: each comparison is false for it.
#pragma once

#include <algorithm>
#include <cmath>

#include <mesh/prepared_triangle.h>

namespace pierce::detail {

enum class Verdict : std::uint8_t { miss, doubtful, hit };

struct Filtered {
    Verdict verdict;
    /// For a hit: the side it comes from, and an interval that contains its exact fraction.
    Sides side = Sides::front;
    double earliest = 0;
    double latest = 1;
};

/// The planes of a triangle at the ends of a path, computed, and how far they may be off. What the filter decides from, and where it
/// is precise enough what is reported.
class Evaluated {
  public:
    Evaluated(const PreparedTriangle& triangle, const Path& path) : triangle_(triangle) {
        for (std::size_t k = 0; k < 3; ++k) {
            from_[k] = path.from[k] - triangle.b[k];
            to_[k] = path.to[k] - triangle.b[k];
            reach_ = std::max({reach_, std::abs(from_[k]), std::abs(to_[k])});
        }
        f0 = linear(triangle.normal, from_);
        f1 = linear(triangle.normal, to_);
        e = triangle.plane_error * reach_;
    }

    /// The bounds hold; false for NaN.
    [[nodiscard]] bool in_range() const { return reach_ >= 0x1p-300 && reach_ <= 0x1p300; }
    [[nodiscard]] double weight_c() const { return f0 * linear(triangle_.weight_c, to_) - f1 * linear(triangle_.weight_c, from_); }
    [[nodiscard]] double weight_a() const { return f0 * linear(triangle_.weight_a, to_) - f1 * linear(triangle_.weight_a, from_); }
    [[nodiscard]] double weight_c_error() const { return triangle_.weight_c_error * (reach_ * reach_); }
    [[nodiscard]] double weight_a_error() const { return triangle_.weight_a_error * (reach_ * reach_); }

    double f0;
    double f1;
    double e;

  private:
    static double linear(const Point& plane, const Point& x) {
        return plane[0] * x[0] + plane[1] * x[1] + plane[2] * x[2];
    }

    const PreparedTriangle& triangle_;
    Point from_{};
    Point to_{};
    double reach_ = 0;
};

/// Never wrong when it says hit or miss: strict inequalities between exact values are proved, so neither an edge nor a plane is
/// touched, and the closed rule and every perturbation of it agree.
[[nodiscard]] inline Filtered filter(const PreparedTriangle& triangle, const Path& path, Sides sides) {
    const Evaluated v(triangle, path);
    if (!v.in_range()) return {Verdict::doubtful};
    const bool front = sides != Sides::back && !(v.f0 < -v.e) && !(v.f1 > v.e);
    const bool back = sides != Sides::front && !(v.f0 > v.e) && !(v.f1 < -v.e);
    if (!front && !back) return {Verdict::miss};
    if (front && back) return {Verdict::doubtful};  // both ends may lie in the plane

    const double sign = front ? 1 : -1;
    const double e = v.e;
    const double d = sign * (v.f0 - v.f1);
    if (!(d > 3 * e)) return {Verdict::doubtful};
    const double wc = sign * v.weight_c();
    const double ec = v.weight_c_error();
    if (wc < -ec) return {Verdict::miss};
    const double wa = sign * v.weight_a();
    const double ea = v.weight_a_error();
    if (wa < -ea) return {Verdict::miss};
    const double wb = (d - wc) - wa;
    const double eb = 4 * e + 1.25 * (ec + ea);
    if (wb < -eb) return {Verdict::miss};

    if (!(sign * v.f0 > e && sign * v.f1 < -e && wc > ec && wa > ea && wb > eb)) return {Verdict::doubtful};
    // F0 / D, with F0 wrong by e and D by 3e; three roundings on either side.
    const double earliest = (sign * v.f0 - e) / (d + 3 * e) * (1 - 0x1p-49);
    const double latest = (sign * v.f0 + e) / (d - 3 * e) * (1 + 0x1p-49);
    return {Verdict::hit, front ? Sides::front : Sides::back, earliest, latest};
}

/// The side of its plane that a point is on, if that is certain: +1 or -1; else 0.
[[nodiscard]] inline int certain_side(const PreparedTriangle& triangle, const Point& point) {
    const Evaluated v(triangle, {point, point});
    if (!v.in_range()) return 0;
    return v.f0 > v.e ? 1 : v.f0 < -v.e ? -1 : 0;
}

}  // namespace pierce::detail
