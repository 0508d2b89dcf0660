// The narrow phase in double precision, one triangle at a time: says hit, miss or doubtful, and is never wrong about
// the first two.
//
// Bloom's inequalities (2002, "Fast ray tri (with precomputation)", with the signs of one line put right), on volumes
// in place of stored planes, as in Moller and Trumbore 1997: nothing is stored but the corners, so the build has no
// planes to make exact, and half of the memory is left to caches. Measured against Bloom's planes: README.md, "The
// narrow phase". Volumes and bounds: meeting.h.
#pragma once

#include <decision.h>
#include <kernel/four.h>
#include <kernel/meeting.h>
#include <kernel/verdict.h>
#include <path.h>

namespace pierce::detail {

/// The volumes of a triangle and a path. `Scalar`: what the coordinates were.
template <class Scalar>
void measure_path(const Corners& corners, const Path& path, Measured& measured) {
    const auto pairs = [](const Point& x, const Point& y) {
        return Triple<Pair>{Pair{x[0], y[0]}, Pair{x[1], y[1]}, Pair{x[2], y[2]}};
    };
    measure_lines<Scalar>(
        {pairs(corners[1], corners[0]), pairs(corners[2], path.to), pairs(corners[0], path.from), kept_of(path.ray)},
        measured);
    if (path.wild) measured.tame = false;
}

/// The corners that were measured.
[[nodiscard]] inline Corners corners_of(const Measured& x) {
    const Triple<Pair>& ba = x.lines.ba;
    const Triple<Pair>& ct = x.lines.ct;
    return {Point{ba.x[1], ba.y[1], ba.z[1]}, {ba.x[0], ba.y[0], ba.z[0]}, {ct.x[0], ct.y[0], ct.z[0]}};
}

/// Six volumes, or how far they may be off: (s, b, v, c), and (a, end | -, -) with end = v - s.
template <class Four>
struct FilterVolumes {
    Four sbvc;
    Four ends;
};

template <class Four>
[[nodiscard]] [[gnu::always_inline]] inline FilterVolumes<Four> volumes_of(const Measured& x) {
    const Pair vc =
        reinterpret_cast<Pair>(reinterpret_cast<PairMask>(x.meeting.vc) ^ reinterpret_cast<PairMask>(Pair{0.0, -0.0}));
    return {Four::of(x.meeting.sb, vc), Four::of(Pair{x.s() - x.b() - x.c(), x.v() - x.s()}, Pair{})};
}

/// `u`: the unit of the volumes' numbers.
template <class Four>
[[nodiscard]] [[gnu::always_inline]] inline FilterVolumes<Four> errors_of(const Measured& x,
                                                                          double u = Arithmetic<double>::unit) {
    const double a = 12 * u * (x.bar_sb[0] + x.bar_sb[1] + x.bar_vc[1]);
    const double end = 10 * u * (x.bar_sb[0] + x.bar_vc[0]);
    return {Four::all(9 * u) * Four::of(x.bar_sb, x.bar_vc), Four::of(Pair{a, end}, Pair{})};
}

/// An interval for v / s; the whole of [0, 1] where s says nothing. (Three roundings on either side.)
[[gnu::always_inline]] inline void set_interval(double s, double v, double es, double ev, Filtered& filtered) {
    filtered.earliest = 0;
    filtered.latest = 1;
    if (!(s > es)) return;
    const Pair quotients = Pair{v - ev, v + ev} / Pair{s + es, s - es} * Pair{1 - 0x1p-49, 1 + 0x1p-49};
    filtered.earliest = quotients[0];
    filtered.latest = quotients[1];
}

/// Strict inequalities between exact values: a hit touches neither an edge nor a plane, so the closed rule and every
/// perturbation of it agree. A miss does not even touch.
template <class Four>
[[gnu::always_inline]] inline void filter_volumes(const FilterVolumes<Four>& x, const FilterVolumes<Four>& e,
                                                  Sides sides, Filtered& filtered) {
    // Bits of volumes that are certainly positive, and negative. None is either where it is NaN.
    constexpr unsigned k_b = 2;
    constexpr unsigned k_v = 4;
    constexpr unsigned k_c = 8;
    constexpr unsigned k_a = 16;
    constexpr unsigned k_end = 32;
    constexpr unsigned k_weights = k_a | k_b | k_c;
    const unsigned plus = Four::signs(Four::less(e.sbvc, x.sbvc)) | Four::signs(Four::less(e.ends, x.ends)) << 4;
    const unsigned minus = Four::signs(Four::less(x.sbvc, -e.sbvc)) | Four::signs(Four::less(x.ends, -e.ends)) << 4;
    const bool front = sides != Sides::back && (plus & k_v) == 0 && (minus & k_end) == 0;
    const bool back = sides != Sides::front && (minus & k_v) == 0 && (plus & k_end) == 0;
    // (Weights of a front hit have the sign of s, which is < 0.)
    if ((!front || (plus & k_weights) != 0) && (!back || (minus & k_weights) != 0)) {
        filtered.verdict = Verdict::miss;
        return;
    }
    set_interval(magnitude_of(Four::lane(x.sbvc, 0)), magnitude_of(Four::lane(x.sbvc, 2)), Four::lane(e.sbvc, 0),
                 Four::lane(e.sbvc, 2), filtered);
    const bool inside = front ? (minus & (k_v | k_weights)) == (k_v | k_weights) && (plus & k_end) != 0
                              : (plus & (k_v | k_weights)) == (k_v | k_weights) && (minus & k_end) != 0;
    filtered.verdict = Verdict::doubtful;
    if (!inside) return;  // where front and back are left, both ends may lie in the plane
    filtered.verdict = Verdict::hit;
    filtered.decision = Decision{.hit = true, .side = front ? Sides::front : Sides::back};
}

template <class Four = TwoPairs>
[[nodiscard]] [[gnu::always_inline]] inline Filtered filter_strictly(const Measured& x, Sides sides) {
    Filtered filtered{Verdict::doubtful};
    if (x.tame) filter_volumes(volumes_of<Four>(x), errors_of<Four>(x), sides, filtered);
    return filtered;
}

/// The closed rule where some volumes are certainly 0, as those of planes, edges and starts along axes are: each
/// product in them is.
template <class Four>
[[nodiscard]] [[gnu::always_inline]] inline Verdict settle(const Measured& x, const FilterVolumes<Four>& volumes,
                                                           const FilterVolumes<Four>& e, Sides sides,
                                                           Decision& decision) {
    constexpr int k_unknown = 2;
    const auto sign = [](double y, double bound) __attribute__((always_inline)) {
        return y > bound ? 1 : y < -bound ? -1 : bound == 0 ? 0 : k_unknown;
    };
    const auto sign_in = [sign](Four y, Four bound, int lane) __attribute__((always_inline)) {
        return sign(Four::lane(y, lane), Four::lane(bound, lane));
    };
    const int v = sign_in(volumes.sbvc, e.sbvc, 2);
    const int end = sign_in(volumes.ends, e.ends, 1);
    if (v == k_unknown || end == k_unknown) return Verdict::doubtful;
    if (!(passes_front(-v, -end) && sides != Sides::back) && !(passes_back(-v, -end, sides) && sides != Sides::front))
        return Verdict::miss;
    // As a difference the weight of a has no bar that is 0. So it is taken as a volume of its own,
    // (b - c) . ((b - from) x d), with bounds like the others'.
    const Triple<Pair>& ba = x.lines.ba;
    const Triple<Pair>& ct = x.lines.ct;
    const Triple<Pair>& af = x.lines.af;
    const Triple<double> bc = {ba.x[0] - ct.x[0], ba.y[0] - ct.y[0], ba.z[0] - ct.z[0]};
    const Triple<double> ob = {ba.x[0] - af.x[1], ba.y[0] - af.y[1], ba.z[0] - af.z[1]};
    const Triple<double> d = {x.meeting.qd.x[1], x.meeting.qd.y[1], x.meeting.qd.z[1]};
    const double bar = dot(magnitudes_of(bc), cross_of_magnitudes(magnitudes_of(ob), magnitudes_of(d)));
    const int own = sign(dot(bc, cross(ob, d)), 9 * Arithmetic<double>::unit * bar);
    const int weights[3] = {own != k_unknown ? own : sign_in(volumes.ends, e.ends, 0), sign_in(volumes.sbvc, e.sbvc, 1),
                            sign_in(volumes.sbvc, e.sbvc, 3)};
    // Where one has the wrong sign it is a miss, whatever the others are.
    bool unknown = false;
    for (const int w : weights) {
        if (w == (end > 0 ? 1 : -1)) return Verdict::miss;
        unknown = unknown || w == k_unknown;
    }
    if (unknown) return Verdict::doubtful;
    decision = closed_rule(
        -v, -end, sides, [&weights](int k) __attribute__((always_inline)) { return -weights[k]; });
    return decision.hit ? Verdict::hit : Verdict::miss;
}

/// Never wrong about a hit, with its side and feature, or a miss by the closed rule. Of a `filtered` that was used
/// before, the decision is written where it is a hit, the interval unless it is a miss.
template <class Four>
[[gnu::always_inline]] inline void filter(const Measured& x, Sides sides, Filtered& filtered) {
    if (!x.tame) {
        filtered.verdict = Verdict::doubtful;
        filtered.earliest = 0;
        filtered.latest = 1;
        return;
    }
    const FilterVolumes<Four> volumes = volumes_of<Four>(x);
    const FilterVolumes<Four> errors = errors_of<Four>(x);
    filter_volumes(volumes, errors, sides, filtered);
    if (filtered.verdict != Verdict::doubtful) [[likely]]
        return;
    filtered.decision.at_start = false;
    filtered.verdict = settle(x, volumes, errors, sides, filtered.decision);
    if (filtered.decision.at_start) filtered.earliest = filtered.latest = 0;
}
[[nodiscard]] [[gnu::always_inline]] inline Filtered filter(const Measured& x, Sides sides) {
    Filtered filtered{Verdict::doubtful};
    filter<TwoPairs>(x, sides, filtered);
    return filtered;
}

}  // namespace pierce::detail
