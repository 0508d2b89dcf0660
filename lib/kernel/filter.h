// The narrow phase in double precision, one triangle at a time: says hit, miss or doubtful, and is never wrong about
// the first two.
//
// Bloom's inequalities (2002, "Fast ray tri (with precomputation)", with the signs of one line put right), on volumes
// in place of
// stored planes, as in Moller and Trumbore 1997: nothing is stored but the corners, so the build has no planes to make
// exact, and
// half of the memory is left to caches. Measured against Bloom's planes: README.md, "The narrow phase". FilterVolumes
// and bounds: meeting.h.
#pragma once

#include <algorithm>
#include <cmath>

#include <decision.h>
#include <kernel/meeting.h>
#include <point.h>

namespace pierce::detail {

enum class Verdict : std::uint8_t { miss, doubtful, hit };

struct Filtered {
    Verdict verdict;
    /// For a hit.
    Decision decision = {};
    /// An interval that contains the exact fraction of the line, for a hit and for what is doubtful.
    double earliest = 0;
    double latest = 1;
};

/// The volumes of a triangle and a path. `Scalar`: what the coordinates were.
template <class Scalar>
void measure_path(const Corners& corners, const Path& path, Measured& measured) {
    const auto pairs = [](const Point& x, const Point& y) {
        return Triple<Pair>{Pair{x[0], y[0]}, Pair{x[1], y[1]}, Pair{x[2], y[2]}};
    };
    measure_lines<Scalar>({pairs(corners[1], corners[0]), pairs(corners[2], path.to), pairs(corners[0], path.from)},
                          measured);
}

/// The corners that were measured.
[[nodiscard]] inline Corners corners_of(const Measured& x) {
    const Triple<Pair>& ba = x.lines.ba;
    const Triple<Pair>& ct = x.lines.ct;
    return {Point{ba.x[1], ba.y[1], ba.z[1]}, {ba.x[0], ba.y[0], ba.z[0]}, {ct.x[0], ct.y[0], ct.z[0]}};
}

/// How far the volumes may be off.
struct VolumeErrors {
    /// `u`: the unit of the volumes' numbers.
    explicit VolumeErrors(const Measured& x, double u = Arithmetic<double>::unit) {
        const Pair sb = both(9 * u) * x.bar_sb;
        const Pair vc = both(9 * u) * x.bar_vc;
        s = sb[0], b = sb[1], v = vc[0], c = vc[1];
        a = 12 * u * (x.bar_sb[0] + x.bar_sb[1] + x.bar_vc[1]);
        end = 10 * u * (x.bar_sb[0] + x.bar_vc[0]);
    }
    double s, v, a, b, c, end;
};

/// The volumes, and those that are differences of others.
struct FilterVolumes {
    explicit FilterVolumes(const Measured& x) : s(x.s()), v(x.v()), b(x.b()), c(x.c()), a(s - b - c), end(v - s) {}
    FilterVolumes(double s_, double v_, double b_, double c_, double a_, double end_)
        : s(s_), v(v_), b(b_), c(c_), a(a_), end(end_) {}
    double s, v, b, c, a, end;
};

/// An interval for v / s; the whole of [0, 1] where s says nothing. (Three roundings on either side.)
inline void set_interval(const FilterVolumes& x, const VolumeErrors& e, Filtered& filtered) {
    const double s = std::abs(x.s);
    const double v = std::abs(x.v);
    if (!(s > e.s)) return;
    const Pair quotients = Pair{v - e.v, v + e.v} / Pair{s + e.s, s - e.s};
    filtered.earliest = quotients[0] * (1 - 0x1p-49);
    filtered.latest = quotients[1] * (1 + 0x1p-49);
}

/// Strict inequalities between exact values: a hit touches neither an edge nor a plane, so the closed rule and every
/// perturbation of it agree. A miss
/// does not even touch.
[[nodiscard]] inline Filtered filter_volumes(const FilterVolumes& x, const VolumeErrors& e, Sides sides) {
    const double v = x.v;
    const double end = x.end;
    const bool front = sides != Sides::back && !(v > e.v) && !(end < -e.end);
    const bool back = sides != Sides::front && !(v < -e.v) && !(end > e.end);
    if (!front && !back) return {Verdict::miss};
    const double b = x.b;
    const double c = x.c;
    const double a = x.a;
    const auto any = [](bool p, bool q, bool r) {
        return static_cast<int>(p) | static_cast<int>(q) | static_cast<int>(r);
    };
    if ((!front || any(a > e.a, b > e.b, c > e.c) != 0) && (!back || any(a < -e.a, b < -e.b, c < -e.c) != 0))
        return {Verdict::miss};

    Filtered filtered{Verdict::doubtful};
    set_interval(x, e, filtered);
    if (front && back) return filtered;  // both ends may lie in the plane
    const double sign = front ? -1 : 1;
    if (any(!(sign * a > e.a), !(sign * b > e.b), !(sign * c > e.c)) != 0 || !(sign * v > e.v) ||
        !(sign * end < -e.end))
        return filtered;
    filtered.verdict = Verdict::hit;
    filtered.decision.hit = true;
    filtered.decision.side = front ? Sides::front : Sides::back;
    return filtered;
}

[[nodiscard]] inline Filtered filter_strictly(const Measured& x, const VolumeErrors& e, Sides sides) {
    return x.tame ? filter_volumes(FilterVolumes(x), e, sides) : Filtered{Verdict::doubtful};
}

/// The closed rule where some volumes are certainly 0, as those of planes, edges and starts along axes are: each
/// product in them is.
[[nodiscard]] [[gnu::noinline]] inline Verdict settle(const Measured& x, const VolumeErrors& e, Sides sides,
                                                      Decision& decision) {
    constexpr int k_unknown = 2;
    const auto sign = [](double y, double bound) {
        return y > bound ? 1 : y < -bound ? -1 : bound == 0 ? 0 : k_unknown;
    };
    const int v = sign(x.v(), e.v);
    const int end = sign(x.v() - x.s(), e.end);
    if (v == k_unknown || end == k_unknown) return Verdict::doubtful;
    if (!(passes_front(-v, -end) && sides != Sides::back) && !(passes_back(-v, -end, sides) && sides != Sides::front))
        return Verdict::miss;
    // The weight of a has no bar of 0 as a difference. As a volume of its own: (b - c) . ((b - from) x d), with bounds
    // as the others'.
    const Triple<Pair>& ba = x.lines.ba;
    const Triple<Pair>& ct = x.lines.ct;
    const Triple<Pair>& af = x.lines.af;
    const Triple<double> bc = {ba.x[0] - ct.x[0], ba.y[0] - ct.y[0], ba.z[0] - ct.z[0]};
    const Triple<double> ob = {ba.x[0] - af.x[1], ba.y[0] - af.y[1], ba.z[0] - af.z[1]};
    const Triple<double> d = {x.meeting.qd.x[1], x.meeting.qd.y[1], x.meeting.qd.z[1]};
    const auto size = [](const Triple<double>& y) {
        return Triple<double>{std::abs(y.x), std::abs(y.y), std::abs(y.z)};
    };
    const double bar = dot(size(bc), cross_of_magnitudes(size(ob), size(d)));
    const int own = sign(dot(bc, cross(ob, d)), 9 * Arithmetic<double>::unit * bar);
    const int weights[3] = {own != k_unknown ? own : sign(x.s() - x.b() - x.c(), e.a), sign(x.b(), e.b),
                            sign(x.c(), e.c)};
    // Where one has the wrong sign it is a miss, whatever the others are. (A weight of the front has the sign of s,
    // which is < 0.)
    bool unknown = false;
    for (const int w : weights) {
        if (w == (end > 0 ? 1 : -1)) return Verdict::miss;
        unknown = unknown || w == k_unknown;
    }
    if (unknown) return Verdict::doubtful;
    decision = closed_rule(-v, -end, sides, [&weights](int k) { return -weights[k]; });
    return decision.hit ? Verdict::hit : Verdict::miss;
}

/// Never wrong about a hit, with its side and feature, or a miss by the closed rule.
[[nodiscard]] inline Filtered filter(const Measured& x, Sides sides) {
    const VolumeErrors errors(x);
    Filtered filtered = filter_strictly(x, errors, sides);
    if (filtered.verdict != Verdict::doubtful || !x.tame) return filtered;
    filtered.verdict = settle(x, errors, sides, filtered.decision);
    if (filtered.decision.at_start) filtered.earliest = filtered.latest = 0;
    return filtered;
}

}  // namespace pierce::detail
