// Makes a segment ready for the wide kernels; a segment much longer than the scene is clipped to its box first.
//
// Included by backend_*.cpp, as all of the wide kernels' headers: nothing here may be shared with other files, so no
// standard header with inline functions, and every function depends on a type of an unnamed namespace.
//
// In scene units, relative to Frame::low, the scene is in [0, 2]. x = from * unit - low is within 2^-52 |x| of the
// exact one, as unit is a power of two (underflow: 2^-1074, less than the noise); d = (to - from) * unit is within
// 2^-52 |d|. So a point x + t d is within 2^-52 (|x| + 2 |x + d|) of the exact one, which is part of `noise`.
//
// Where an end is further than k_far from the lattice's corner the segment is clipped (clip.h). From a near end the
// length does not matter.
#pragma once

#include <cstdint>

#include <kernel/clip.h>
#include <kernel/probe.h>
#include <node.h>

namespace pierce::detail {

constexpr double k_far = 8;
/// In scenes of a smaller unit, ends within k_far are up to 2 * k_far / unit >= 2^1024 apart: their difference may
/// overflow. Clipping does without it.
constexpr double k_least_unit = 0x1p-1019;

// Three numbers and one that is of no use, all finite.
typedef double Four __attribute__((vector_size(32)));
typedef float FourFloats __attribute__((vector_size(16)));
typedef std::int64_t FourWords __attribute__((vector_size(32)));
typedef std::uint32_t FourRows __attribute__((vector_size(16)));
typedef std::int32_t FourInts __attribute__((vector_size(16)));
typedef std::uint16_t FourShorts __attribute__((vector_size(8)));

/// Returns false if the segment certainly touches nothing. `ray`: `to` is the way from `from` to the end. `short_way`:
/// of the tree (node.h).
template <class Wide, class Scalar>
[[gnu::always_inline]] inline bool set_probe(const Frame& frame, const double* from, const double* to, bool ray,
                                             bool front_only, bool back_only, float short_way, Probe<Scalar>& probe) {
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
    Four moved = ray ? end : end - start;
    Four x = start * frame.unit - low;
    Four d = moved * frame.unit;
    const Four z = ray ? x + d : end * frame.unit - low;
    const double furthest = most(size_of(x) + size_of(z));
    double noise = frame.noise + 0x1p-51 * furthest;
    probe.begin = 0;
    probe.length = 1;
    probe.front_only = front_only;
    probe.back_only = back_only;
    const bool clipped = !(furthest <= k_far) || frame.unit < k_least_unit;
    if (clipped) [[unlikely]] {
        Clipped cut;
        if (!clip(frame, from, to, ray, cut)) return false;
        probe.begin = cut.begin;
        probe.length = cut.length;
        start = Four{cut.start[0], cut.start[1], cut.start[2], 0};
        moved = Four{cut.way[0], cut.way[1], cut.way[2], 0};
        x = Four{cut.origin[0], cut.origin[1], cut.origin[2], 0};
        d = Four{cut.direction[0], cut.direction[1], cut.direction[2], 0};
        noise = cut.noise;
    }
    store(probe.origin, x);
    store(probe.direction, d);
    store(probe.noise, Four{noise, noise, noise, noise});

    probe.by_box = !clipped && most(size_of(d)) < short_way;
    if (probe.by_box) {
        const double per_step = 1 / frame.step;
        const auto on_lattice = [&](const Four& y) __attribute__((always_inline)) {
            const Four steps = y * per_step;
            const Four above = steps > 0 ? steps : Four{};
            const Four least = above < 65535 ? above : Four{} + 65535;
            return __builtin_convertvector(__builtin_convertvector(least, FourInts), FourShorts);
        };
        const Four last = x + d;
        const auto down = last < x;
        store(probe.low, on_lattice((down ? last : x) - 2 * noise));
        store(probe.high, on_lattice((down ? x : last) + 2 * noise));
    } else {
        // A shorter way along an axis is taken for one of 2^-60: no point moves by more, which is less than the noise.
        const Four size = size_of(d);
        const auto tiny = size < 0x1p-60;
        const Four least = {0x1p-60, 0x1p-60, 0x1p-60, 0x1p-60};
        const Four way = reinterpret_cast<Four>((reinterpret_cast<FourWords>(d) & sign) |
                                                (tiny & reinterpret_cast<FourWords>(least)) |
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
    }

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
