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

[[nodiscard]] inline double linear(const Point& plane, const Point& x) {
    return plane[0] * x[0] + plane[1] * x[1] + plane[2] * x[2];
}

/// Never wrong when it says hit or miss: strict inequalities between exact values are proved, so neither an edge nor a plane is
/// touched, and the closed rule and every perturbation of it agree.
[[nodiscard]] inline Filtered filter(const PreparedTriangle& triangle, const Path& path, Sides sides) {
    Point from;
    Point to;
    double reach = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        from[k] = path.from[k] - triangle.b[k];
        to[k] = path.to[k] - triangle.b[k];
        reach = std::max({reach, std::abs(from[k]), std::abs(to[k])});
    }
    if (!(reach >= 0x1p-300 && reach <= 0x1p300)) return {Verdict::doubtful};

    const double f0 = linear(triangle.normal, from);
    const double f1 = linear(triangle.normal, to);
    const double e = triangle.plane_error * reach;
    const bool front = sides != Sides::back && !(f0 < -e) && !(f1 > e);
    const bool back = sides != Sides::front && !(f0 > e) && !(f1 < -e);
    if (!front && !back) return {Verdict::miss};
    if (front && back) return {Verdict::doubtful};  // both ends may lie in the plane

    const double sign = front ? 1 : -1;
    const double d = sign * (f0 - f1);
    if (!(d > 3 * e)) return {Verdict::doubtful};
    const double wc = sign * (f0 * linear(triangle.weight_c, to) - f1 * linear(triangle.weight_c, from));
    const double ec = triangle.weight_c_error * (reach * reach);
    if (wc < -ec) return {Verdict::miss};
    const double wa = sign * (f0 * linear(triangle.weight_a, to) - f1 * linear(triangle.weight_a, from));
    const double ea = triangle.weight_a_error * (reach * reach);
    if (wa < -ea) return {Verdict::miss};
    const double wb = (d - wc) - wa;
    const double eb = 4 * e + 1.25 * (ec + ea);
    if (wb < -eb) return {Verdict::miss};

    if (!(sign * f0 > e && sign * f1 < -e && wc > ec && wa > ea && wb > eb)) return {Verdict::doubtful};
    // F0 / D, with F0 wrong by e and D by 3e; three roundings on either side.
    const double earliest = (sign * f0 - e) / (d + 3 * e) * (1 - 0x1p-49);
    const double latest = (sign * f0 + e) / (d - 3 * e) * (1 + 0x1p-49);
    return {Verdict::hit, front ? Sides::front : Sides::back, earliest, latest};
}

}  // namespace pierce::detail
