// Which children of a node does a segment touch, and from which parameter on? Sixteen at a time.
//
// On the scene's lattice a slab's side is at t = (bound * step - x) / d = near + bound * pace, and the children that
// the segment touches within the probe's noise have entry <= exit when each near side is taken earlier by e and each
// far side later by e. Rounding, for v = 2^-24, x below k_far = 8 and bounds below 2^16 steps, 2 scene units: pace is
// within v of itself, and so is the product with a bound: 2v * 2 / |d|; near is within v * 9 / |d|; the sum within
// v * 11 / |d|: 24v / |d| < 2^-19 / |d|, which is part of e (set_probe.h), beside noise / |d|. A fused operation rounds
// less often.
//
// In a coarse node's own frame t = (origin - x) / d + bound * step / d. The difference of doubles rounds once more, to
// float, in proportion to itself; c being its size and 255 step the largest bound: 4v (c + 255 step) / |d| in all,
// 2^-20 (c + 255 step) / |d| are allowed. NaN: entry <= exit is false; but no probe has any.
#pragma once

#include <kernel/probe.h>
#include <node.h>

namespace pierce::detail {

/// Sixteen numbers, one for each child.
template <class Wide>
struct Sixteen {
    static constexpr unsigned groups = k_children / Wide::width;
    typename Wide::Float part[groups];
};

/// Children that are touched, and where the segment comes to them.
template <class Wide>
struct Touched {
    Sixteen<Wide> entry;
    typename Wide::Mask hit[Sixteen<Wide>::groups];
};

template <class Wide>
struct Ray {
    typename Wide::Float pace[3];
    typename Wide::Float near[3];
    typename Wide::Float far[3];
    unsigned near_row[3];
    unsigned far_row[3];

    template <class Scalar>
    [[gnu::always_inline]] explicit Ray(const Probe<Scalar>& probe) {
        for (unsigned k = 0; k < 3; ++k) {
            pace[k] = Wide::all(probe.pace[k]);
            near[k] = Wide::all(probe.near[k]);
            far[k] = Wide::all(probe.far[k]);
            near_row[k] = probe.near_row[k];
            far_row[k] = near_row[k] ^ 1;
        }
    }
};

/// Bounds read by `read(row, group)`: t = near + bound * pace, no earlier than `first`.
template <class Wide, class Read>
[[gnu::always_inline]] inline void slab_test_rows(const Read& read, const Ray<Wide>& ray, typename Wide::Float first,
                                                  typename Wide::Float limit, Touched<Wide>& out) {
    using Float = typename Wide::Float;
    for (unsigned g = 0; g < Sixteen<Wide>::groups; ++g) {
        const auto at = [&](unsigned row, unsigned k, Float offset) {
            return Wide::multiply_add(read(row, g), ray.pace[k], offset);
        };
        const Float entry =
            Wide::max(Wide::max(at(ray.near_row[0], 0, ray.near[0]), at(ray.near_row[1], 1, ray.near[1])),
                      Wide::max(at(ray.near_row[2], 2, ray.near[2]), first));
        const Float exit = Wide::min(Wide::min(at(ray.far_row[0], 0, ray.far[0]), at(ray.far_row[1], 1, ray.far[1])),
                                     Wide::min(at(ray.far_row[2], 2, ray.far[2]), limit));
        out.entry.part[g] = entry;
        out.hit[g] = Wide::at_most(entry, exit);
    }
}

template <class Wide, class Scalar>
[[gnu::always_inline]] inline void slab_test(const Node& node, const Probe<Scalar>&, const Ray<Wide>& ray, float limit,
                                             Touched<Wide>& out) {
    const auto read = [&](unsigned row, unsigned g) { return Wide::words(node.bounds[row] + Wide::width * g); };
    slab_test_rows<Wide>(read, ray, Wide::all(0), Wide::all(limit), out);
}

// From which distance on, in sizes of a coarse node, its own base is taken: the bound above is then a 64th of its size.
constexpr float k_far_node = 0x1p14F;

/// A coarse node so far away that floats would not tell its children apart: all parameters are taken relative to
/// `base`, about where the segment comes to the node, computed in double. With center = (origin - x) / d, within 2^-51
/// of itself, a slab's side is at (center - base) + bound * pace; 2^-22 (|center - base| + 255 |pace|) is more than the
/// roundings of that to float and of the sum.
template <class Wide, class Scalar>
[[gnu::noinline]] Touched<Wide> slab_test_far(const CoarseNode& node, const Probe<Scalar>& probe, float limit) {
    double center[3];
    double pace[3];
    double base = -static_cast<double>(__builtin_inff());
    for (unsigned k = 0; k < 3; ++k) {
        center[k] = (node.origin[k] - probe.origin[k]) * probe.full_inverse[k];
        pace[k] = static_cast<double>(node.step[k]) * probe.full_inverse[k];
        const double near = pace[k] < 0 ? center[k] + 255 * pace[k] : center[k];
        base = near > base ? near : base;
    }
    Ray<Wide> own(probe);
    for (unsigned k = 0; k < 3; ++k) {
        const double from_base = center[k] - base;
        const double e = __builtin_fabs(probe.full_inverse[k]) * probe.noise[k] + 0x1p-50 * __builtin_fabs(center[k]) +
                         0x1p-22 * (__builtin_fabs(from_base) + 255 * __builtin_fabs(pace[k]));
        own.pace[k] = Wide::all(static_cast<float>(pace[k]));
        own.near[k] = Wide::all(static_cast<float>(from_base - e));
        own.far[k] = Wide::all(static_cast<float>(from_base + e));
    }
    const double slack = 0x1p-50 * __builtin_fabs(base);
    const double left = static_cast<double>(limit) - base;
    Touched<Wide> out;
    const auto read = [&](unsigned row, unsigned g) { return Wide::bytes(node.bounds[row] + Wide::width * g); };
    slab_test_rows<Wide>(read, own, Wide::all(static_cast<float>(-base - 0x1p-22 * __builtin_fabs(base))),
                         Wide::all(static_cast<float>(left + slack + 0x1p-22 * __builtin_fabs(left))), out);
    // From the segment's start again, rounded down: keys are compared with the limit.
    const auto to_start = Wide::all(static_cast<float>(base - 0x1p-21 * __builtin_fabs(base)));
    for (unsigned g = 0; g < Sixteen<Wide>::groups; ++g)
        out.entry.part[g] = Wide::max(out.entry.part[g] + to_start, Wide::all(0));
    return out;
}

template <class Wide, class Scalar>
[[gnu::always_inline]] inline void slab_test(const CoarseNode& node, const Probe<Scalar>& probe, const Ray<Wide>& ray,
                                             float limit, Touched<Wide>& out) {
    Ray<Wide> own = ray;
    float furthest = 0;
    float largest = 0;
    for (unsigned k = 0; k < 3; ++k) {
        const auto c = static_cast<float>(node.origin[k] - probe.origin[k]);
        const float distance = __builtin_fabsf(c);
        const float extent = 255 * node.step[k];
        furthest = distance > furthest ? distance : furthest;
        largest = extent > largest ? extent : largest;
        const float e = probe.margin[k] + 0x1p-20F * (distance + extent) * __builtin_fabsf(probe.inverse[k]);
        const float center = c * probe.inverse[k];
        own.pace[k] = Wide::all(node.step[k] * probe.inverse[k]);
        own.near[k] = Wide::all(center - e);
        own.far[k] = Wide::all(center + e);
    }
    if (furthest > k_far_node * largest) [[unlikely]] {
        out = slab_test_far<Wide>(node, probe, limit);
        return;
    }
    const auto read = [&](unsigned row, unsigned g) { return Wide::bytes(node.bounds[row] + Wide::width * g); };
    slab_test_rows<Wide>(read, own, Wide::all(0), Wide::all(limit), out);
}

template <class Wide>
[[gnu::always_inline]] inline unsigned touched_bits(const Touched<Wide>& touched) {
    unsigned bits = 0;
    for (unsigned g = 0; g < Sixteen<Wide>::groups; ++g) bits |= Wide::bits(touched.hit[g]) << (Wide::width * g);
    return bits;
}

// Keys: the bits of an entry, which are in the order of the entries as none is negative, with the child's place in the
// lowest four. k_no_key is that of a child that is not touched or was taken already.
constexpr std::uint32_t k_no_key = 0x7f800000U;

template <class Wide>
[[gnu::always_inline]] inline Sixteen<Wide> keys_of(const Touched<Wide>& touched) {
    Sixteen<Wide> keys;
    for (unsigned g = 0; g < Sixteen<Wide>::groups; ++g)
        keys.part[g] = Wide::none_but(touched.hit[g], Wide::key(touched.entry.part[g], Wide::width * g));
    return keys;
}

/// For each lane of a register, the least key of all groups.
template <class Wide>
[[gnu::always_inline]] inline typename Wide::Float least_keys(const Sixteen<Wide>& keys) {
    typename Wide::Float least = keys.part[0];
    for (unsigned g = 1; g < Sixteen<Wide>::groups; ++g) least = Wide::least(least, keys.part[g]);
    return least;
}

template <class Wide>
[[gnu::always_inline]] inline std::uint32_t least_key(const Sixteen<Wide>& keys) {
    return Wide::least_of(least_keys(keys));
}

/// 1 if there is a key that was not taken.
template <class Wide>
[[gnu::always_inline]] inline unsigned any_key(const Sixteen<Wide>& keys) {
    return Wide::bits(Wide::below(least_keys(keys), Wide::all(__builtin_inff()))) != 0 ? 1U : 0U;
}

/// Takes a key out.
template <class Wide>
[[gnu::always_inline]] inline void take_key(Sixteen<Wide>& keys, std::uint32_t key) {
    for (unsigned g = 0; g < Sixteen<Wide>::groups; ++g)
        keys.part[g] = Wide::none_where(Wide::same(keys.part[g], Wide::all_bits(key)), keys.part[g]);
}

/// A parameter made comparable with keys: no key of an entry up to it is larger.
template <class Wide>
[[gnu::always_inline]] inline std::uint32_t key_limit(float limit) {
    std::uint32_t bits;
    __builtin_memcpy(&bits, &limit, sizeof bits);
    return bits | 15U;
}

}  // namespace pierce::detail
