// Makes a segment ready for the wide kernels; a segment much longer than the scene is clipped to its box first.
//
// Included by backend_*.cpp, as all of the wide kernels' headers: nothing here may be shared with other files, so no
// standard header with inline functions, and every function depends on a type of an unnamed namespace.
//
// In scene units, relative to Frame::low, the scene is in [0, 2]. x = from * unit - low is within 2^-52 |x| of the
// exact one, as unit is a power of two (underflow: 2^-1074, less than the noise); d = (to - from) * unit is within
// 2^-52 |d|. So a point x + t d is within 2^-52 (|x| + 2 |x + d|) of the exact one, which is part of `noise`.
//
// Where an end is further than k_far from the lattice's corner the segment is clipped. From the nearer end on, y + r e
// with r in [0, 1] has left [-1/8, 17/8] before r_in and after r_out; (bound - y) and the quotient round three times,
// so r is within 2^-50 of itself, which moves a point by at most 2^-50 (|y| + |e| r) < 2^-49 (|y| + 4): nothing that is
// within the eighth of the scene less the noise is lost if that is below 1/16, and what is lost in the place of the
// points is added to the noise. From a near end, |y| <= k_far, the length does not matter (k_overflows). Where both
// ends are far, the noise grows with the distance of the nearer one: from 2^30 scenes on boxes are told apart less and
// less well, and from 2^46 on everything is visited (k_beyond_all).
#pragma once

#include <cstdint>

#include <kernel/probe.h>
#include <node.h>

namespace pierce::detail {

constexpr double k_far = 8;
/// In scenes of a smaller unit, ends within k_far are up to 2 * k_far / unit >= 2^1024 apart: their difference may
/// overflow. Clipping does without it.
constexpr double k_least_unit = 0x1p-1019;

/// A segment whose ends are both further away than this, in scene units, comes near to everything.
constexpr double k_beyond_all = 0x1p100;
/// From here on products with the unit, of coordinates below 2^1024, overflow: the way is taken 2^-1100 times as long,
/// and its parameters 2^1100 times as large. Its largest component is then 2^-102 or more, so it has passed the scene
/// at a parameter below 2^204. What underflows of the others, 2^-603, leads no further than 2^-399 up to there.
constexpr double k_overflows = 0x1p1000;

template <class Wide>
[[gnu::always_inline]] inline double magnitude(double x) {
    return __builtin_fabs(x);
}

/// A probe that comes near to everything at its start.
template <class Wide, class Scalar>
void visit_all(const Frame& frame, Probe<Scalar>& probe, double* moved_from, double* moved) {
    probe.begin = 0;
    probe.length = 1;
    for (int k = 0; k < 3; ++k) {
        probe.origin[k] = 0;
        probe.direction[k] = 1;
        probe.noise[k] = 0x1p100;
        moved_from[k] = frame.low[k] / frame.unit;
        moved[k] = 1 / frame.unit;
    }
}

/// Clips. Returns false where nothing is left. `whole` has origin and direction of the whole segment.
template <class Wide, class Scalar>
[[gnu::noinline]] bool clip(const Frame& frame, const double* from, const double* to, Probe<Scalar>& probe,
                            double* moved_from, double* moved) {
    double ends[2][3];
    double reach[2] = {0, 0};
    for (int k = 0; k < 3; ++k) {
        ends[0][k] = from[k] * frame.unit - frame.low[k];
        ends[1][k] = to[k] * frame.unit - frame.low[k];
        for (int i = 0; i < 2; ++i) {
            const double x = magnitude<Wide>(ends[i][k]);
            reach[i] = x > reach[i] ? x : reach[i];
        }
    }
    const int base = reach[0] <= reach[1] ? 0 : 1;
    if (!(reach[base] <= k_beyond_all)) {
        visit_all<Wide>(frame, probe, moved_from, moved);
        return true;
    }
    const bool scaled = !(reach[1 - base] <= k_overflows);
    const double half = scaled ? 0x1p-550 : 1;
    const double* y = ends[base];
    const double off = 0x1p-48 * (reach[base] + 8);
    const double wide = 0.125 + frame.noise + off;
    double in = 0;
    double out = scaled ? 0x1p1000 : 1;
    double e[3];
    for (int k = 0; k < 3; ++k) {
        // Halves: the difference of two doubles may be infinite.
        const double way = (base == 0 ? to[k] : from[k]) * 0.5 - (base == 0 ? from[k] : to[k]) * 0.5;
        e[k] = (way * half) * (frame.unit * half);
        const double low = -wide;
        const double high = frame.high[k] - frame.low[k] + wide;
        if (e[k] == 0) {
            if (y[k] < low || y[k] > high) return false;
            continue;
        }
        const double a = (low - y[k]) * 0.5 / e[k];
        const double b = (high - y[k]) * 0.5 / e[k];
        const double first = a < b ? a : b;
        const double last = a < b ? b : a;
        in = first > in ? first : in;
        out = last < out ? last : out;
    }
    in *= 1 - 0x1p-49;
    out *= 1 + 0x1p-49;
    if (!scaled && out > 1) out = 1;
    if (in > out) return false;
    probe.begin = base == 0 ? in * half * half : 1 - out * half * half;
    probe.length = (out - in) * half * half;
    const double at = base == 0 ? in : out;
    const double sign = base == 0 ? 2 : -2;
    for (int k = 0; k < 3; ++k) {
        probe.origin[k] = y[k] + at * 2 * e[k];
        probe.direction[k] = sign * ((out - in) * e[k]);
        probe.noise[k] = frame.noise + off;
        const double start = (base == 0 ? from[k] : to[k]);
        moved_from[k] = start + (at * 2 * e[k]) / frame.unit;
        moved[k] = probe.direction[k] / frame.unit;
    }
    return true;
}

// Three numbers and one that is of no use, all finite.
typedef double Four __attribute__((vector_size(32)));
typedef float FourFloats __attribute__((vector_size(16)));
typedef std::int64_t FourWords __attribute__((vector_size(32)));
typedef std::uint32_t FourRows __attribute__((vector_size(16)));

/// Returns false if the segment certainly touches nothing.
template <class Wide, class Scalar>
[[gnu::always_inline]] inline bool set_probe(const Frame& frame, const double* from, const double* to, bool front_only,
                                             bool back_only, Probe<Scalar>& probe) {
    constexpr bool k_double = sizeof(Scalar) == sizeof(double);
    const auto most = [](const Four& x) __attribute__((always_inline)) {
        const double y = x[0] > x[1] ? x[0] : x[1];
        return y > x[2] ? y : x[2];
    };
    const auto store = [](auto* to_, const auto& x) __attribute__((always_inline)) {
        __builtin_memcpy(to_, &x, sizeof x);
    };
    const FourWords sign = {INT64_MIN, INT64_MIN, INT64_MIN, INT64_MIN};
    const auto size_of = [&](const Four& y) __attribute__((always_inline)) {
        return reinterpret_cast<Four>(reinterpret_cast<FourWords>(y) & ~sign);
    };
    // Number by number: a load of two that were just written as single numbers would wait for both.
    const auto load = [](const double* y) __attribute__((always_inline)) {
        const auto* each = static_cast<const volatile double*>(y);
        const double a = each[0];
        const double b = each[1];
        const double c = each[2];
        return Four{a, b, c, 0};
    };
    Four start = load(from);
    const Four end = load(to);
    const Four low = {frame.low[0], frame.low[1], frame.low[2], 0};
    Four moved = end - start;
    Four x = start * frame.unit - low;
    const Four z = end * frame.unit - low;
    Four d = moved * frame.unit;
    const double furthest = most(size_of(x) + size_of(z));
    double noise = frame.noise + 0x1p-51 * furthest;
    probe.begin = 0;
    probe.length = 1;
    probe.front_only = front_only;
    probe.back_only = back_only;
    const bool clipped = !(furthest <= k_far) || frame.unit < k_least_unit;
    if (clipped) [[unlikely]] {
        double moved_from[3];
        double way[3];
        if (!clip<Wide>(frame, from, to, probe, moved_from, way)) return false;
        start = Four{moved_from[0], moved_from[1], moved_from[2], 0};
        moved = Four{way[0], way[1], way[2], 0};
        x = Four{probe.origin[0], probe.origin[1], probe.origin[2], 0};
        d = Four{probe.direction[0], probe.direction[1], probe.direction[2], 0};
        noise = probe.noise[0];
    }
    store(probe.origin, x);
    store(probe.direction, d);
    store(probe.noise, Four{noise, noise, noise, noise});

    // A shorter way along an axis is taken for one of 2^-60: no point moves by more, which is less than the noise.
    const Four size = size_of(d);
    const auto tiny = size < 0x1p-60;
    const Four least = {0x1p-60, 0x1p-60, 0x1p-60, 0x1p-60};
    const Four way =
        reinterpret_cast<Four>((reinterpret_cast<FourWords>(d) & sign) | (tiny & reinterpret_cast<FourWords>(least)) |
                               (~tiny & reinterpret_cast<FourWords>(size)));
    const Four inverse = 1 / way;
    const Four per_noise = size_of(inverse);
    const Four center = -x * inverse;
    const Four e = per_noise * (noise + 0x1p-19);
    store(probe.full_inverse, inverse);
    store(probe.inverse, __builtin_convertvector(inverse, FourFloats));
    store(probe.margin, __builtin_convertvector(per_noise * (noise * (1 + 0x1p-20)), FourFloats));
    store(probe.pace, __builtin_convertvector(inverse * frame.step, FourFloats));
    store(probe.near, __builtin_convertvector(center - e, FourFloats));
    store(probe.far, __builtin_convertvector(center + e, FourFloats));
    store(probe.near_row, FourRows{0, 2, 4, 6} - __builtin_convertvector(way < 0, FourRows));

    const double scale = k_double ? frame.unit : 1;
    const Four length = k_double ? d : moved;
    if constexpr (k_double)
        store(probe.corner_origin, start);
    else
        store(probe.corner_origin, __builtin_convertvector(start, FourFloats));
    store(probe.corner_direction, __builtin_convertvector(length, FourFloats));
    probe.scale = static_cast<Scalar>(scale);
    // Of the cluster test; derived there.
    constexpr double u = 0x1p-24;
    // Of the cluster test's lengths in scene units: 1, or that of the caller's coordinates.
    const double unit = scale / frame.unit;
    const double reach = most(size_of(length));
    double g = noise * unit * (1 + 0x1p-20);
    if (clipped) [[unlikely]]  // the origin was moved and rounded
        g += most(size_of(start)) * scale * (k_double ? 0x1p-50 : 0x1p-23);
    const bool tame = frame.unit >= 0x1p-30 && frame.unit <= 0x1p30;
    const double floor = 0x1p-120 * (1 + 16 * unit) * (1 + 16 * unit);  // normal: a denormal operand costs 150 cycles
    const double none = static_cast<double>(__builtin_inff());
    probe.edge_bound = static_cast<float>(64 * u * (1 + 0x1p-20) * reach);
    probe.start_bound = static_cast<float>(128 * u * (1 + 0x1p-20) * reach);
    probe.noise_bound = static_cast<float>(12 * g * (1 + 0x1p-20) * reach);
    probe.plane_bound = static_cast<float>(64 * u);
    probe.plane_noise = static_cast<float>(6 * g * (1 + 0x1p-20) + 64 * u * (1 + 0x1p-20) * reach);
    probe.floor = static_cast<float>(k_double || tame ? floor : none);
    probe.nodes = 0;
    probe.clusters = 0;
    return true;
}

}  // namespace pierce::detail
