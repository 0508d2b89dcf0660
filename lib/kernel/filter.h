// The narrow phase in double precision, one triangle at a time: the same volumes as the wide kernels', so that it says hit, miss or doubtful
// and is never wrong about the first two.
//
// Bloom's inequalities (2002, "Fast ray tri (with precomputation)", with the signs of one line put right), on volumes in place of
// stored planes, as in Moller and Trumbore 1997: nothing is stored but the corners, so the build has no planes to make exact, and
// half of the memory is left to caches. Measured against Bloom's planes: README.md, "The narrow phase".
//
// With a, b, c relative to the start, d = to - from:
//   w_a = d . (b x c) and so on, s = w_a + w_b + w_c = d . n, v = a . (b x c) = n . a,   n = (b-a) x (c-a)
//   the start's side is that of -v, the end's that of s - v; weights w / s; fraction v / s.
//
// The bounds are those derived in lanes.h, for u = 2^-52 (any rounding mode), M the largest |component| of a, b, c and D that of d:
//   |err w| <= 48u D M^2 =: e     |err v| <= 48u M^3 =: e_v     |err s| <= 170u D M^2 =: e_s     |err (v - s)| < 64u M^2 (M + 3 D) =: e_t
// Underflow: a product loses at most 2^-1074 more. With M and D in [2^-300, 2^300] that is 2^-422 of the u M^2 that one of two factors
// may lose, and 2^-122 of u D M^2: nothing in 48u. Outside of that range the answer is doubtful. So it is for NaN: each comparison is
// false for it.
#pragma once

#include <algorithm>

#include <kernel/triple.h>

namespace pierce::detail {

enum class Verdict : std::uint8_t { miss, doubtful, hit };

struct Filtered {
    Verdict verdict;
    /// For a hit: the side it comes from, and an interval that contains its exact fraction.
    Sides side = Sides::front;
    double earliest = 0;
    double latest = 1;
};

/// The volumes of a triangle and a path, computed, and how far they may be off.
struct Volumes64 {
    Volumes64(const Corners& corners, const Path& path) {
        const Triple<double> a = difference<double>(corners[0], path.from);
        const Triple<double> b = difference<double>(corners[1], path.from);
        const Triple<double> c = difference<double>(corners[2], path.from);
        const Triple<double> d = difference<double>(path.to, path.from);
        const double most = std::max({largest(a), largest(b), largest(c)});
        const double reach = largest(d);
        in_range = is_tame(most) && is_tame(reach);
        const Triple<double> bc = cross(b, c);
        weight = {dot(d, bc), dot(d, cross(c, a)), dot(d, cross(a, b))};
        v = dot(a, bc);
        s = weight[0] + weight[1] + weight[2];
        constexpr double u = Arithmetic<double>::unit;
        const double square = u * (most * most);
        e = 48 * reach * square;
        ev = 48 * most * square;
        es = 170 * reach * square;
        et = 64 * square * (most + 3 * reach);
    }

    Point weight;  ///< of a, b, c, times s
    double v;
    double s;
    double e, ev, es, et;
    bool in_range;  ///< the bounds hold; false for NaN
};

/// Never wrong when it says hit or miss: strict inequalities between exact values are proved, so neither an edge nor a plane is
/// touched, and the closed rule and every perturbation of it agree.
[[nodiscard]] inline Filtered filter(const Corners& corners, const Path& path, Sides sides) {
    const Volumes64 x(corners, path);
    if (!x.in_range) return {Verdict::doubtful};
    const double end = x.v - x.s;
    const bool front = sides != Sides::back && !(x.v > x.ev) && !(end < -x.et);
    const bool back = sides != Sides::front && !(x.v < -x.ev) && !(end > x.et);
    if (!front && !back) return {Verdict::miss};
    const auto [lowest, highest] = std::minmax({x.weight[0], x.weight[1], x.weight[2]});
    if ((!front || highest > x.e) && (!back || lowest < -x.e)) return {Verdict::miss};
    if (front && back) return {Verdict::doubtful};  // both ends may lie in the plane

    const double sign = front ? -1 : 1;
    const double start = sign * x.v;
    if (!((front ? highest < -x.e : lowest > x.e) && start > x.ev && sign * end < -x.et)) return {Verdict::doubtful};
    // start / |s|: |s| = start + |end| is above e_v + e_t, which is above e_s; three roundings on either side.
    const double s = sign * x.s;
    const double earliest = (start - x.ev) / (s + x.es) * (1 - 0x1p-49);
    const double latest = s > x.es ? (start + x.ev) / (s - x.es) * (1 + 0x1p-49) : 1;
    return {Verdict::hit, front ? Sides::front : Sides::back, earliest, latest};
}

}  // namespace pierce::detail
