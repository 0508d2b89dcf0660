// Which children of a node does a segment touch, and from which parameter on? Sixteen at a time.
//
// On the scene's lattice a slab's side is at t = (bound * step - x) / d = near + bound * pace, and the children that the segment touches within the
// probe's noise have entry <= exit when each near side is taken earlier by e and each far side later by e.
// Rounding, for v = 2^-24, x below k_far = 8 and bounds below 2^16 steps, 2 scene units: pace is within v of itself, and so is the product with a bound:
//   2v * 2 / |d|; near is within v * 9 / |d|; the sum within v * 11 / |d|: 24v / |d| < 2^-19 / |d|, which is part of e (set_probe.h), beside noise / |d|.
// A fused operation rounds less often.
//
// In a coarse node's own frame t = (origin - x) / d + bound * step / d. The difference of doubles rounds once more, to float, in proportion to itself;
// c being its size and 255 step the largest bound: 4v (c + 255 step) / |d| in all, 2^-20 (c + 255 step) / |d| are allowed.
// NaN: entry <= exit is false; but no probe has any.
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

template <class Wide, class Scalar>
[[gnu::always_inline]] inline void slab_test(const Node& node, const Probe<Scalar>&, const Ray<Wide>& ray, typename Wide::Float limit,
                                             Touched<Wide>& out) {
    using Float = typename Wide::Float;
    for (unsigned g = 0; g < Sixteen<Wide>::groups; ++g) {
        const auto at = [&](unsigned row, unsigned k, Float offset) {
            return Wide::multiply_add(Wide::words(node.bounds[row] + Wide::width * g), ray.pace[k], offset);
        };
        const Float entry = Wide::max(Wide::max(at(ray.near_row[0], 0, ray.near[0]), at(ray.near_row[1], 1, ray.near[1])),
                                      Wide::max(at(ray.near_row[2], 2, ray.near[2]), Wide::all(0)));
        const Float exit = Wide::min(Wide::min(at(ray.far_row[0], 0, ray.far[0]), at(ray.far_row[1], 1, ray.far[1])),
                                     Wide::min(at(ray.far_row[2], 2, ray.far[2]), limit));
        out.entry.part[g] = entry;
        out.hit[g] = Wide::at_most(entry, exit);
    }
}

template <class Wide, class Scalar>
[[gnu::always_inline]] inline void slab_test(const CoarseNode& node, const Probe<Scalar>& probe, const Ray<Wide>& ray,
                                             typename Wide::Float limit, Touched<Wide>& out) {
    using Float = typename Wide::Float;
    Float pace[3];
    Float near[3];
    Float far[3];
    for (unsigned k = 0; k < 3; ++k) {
        const auto c = static_cast<float>(node.origin[k] - probe.origin[k]);
        const float size = __builtin_fabsf(c) + 255 * node.step[k];
        const float e = probe.margin[k] + 0x1p-20F * size * __builtin_fabsf(probe.inverse[k]);
        const float center = c * probe.inverse[k];
        pace[k] = Wide::all(node.step[k] * probe.inverse[k]);
        near[k] = Wide::all(center - e);
        far[k] = Wide::all(center + e);
    }
    for (unsigned g = 0; g < Sixteen<Wide>::groups; ++g) {
        const auto at = [&](unsigned row, unsigned k, Float offset) {
            return Wide::multiply_add(Wide::bytes(node.bounds[row] + Wide::width * g), pace[k], offset);
        };
        const Float entry = Wide::max(Wide::max(at(ray.near_row[0], 0, near[0]), at(ray.near_row[1], 1, near[1])),
                                      Wide::max(at(ray.near_row[2], 2, near[2]), Wide::all(0)));
        const Float exit = Wide::min(Wide::min(at(ray.far_row[0], 0, far[0]), at(ray.far_row[1], 1, far[1])),
                                     Wide::min(at(ray.far_row[2], 2, far[2]), limit));
        out.entry.part[g] = entry;
        out.hit[g] = Wide::at_most(entry, exit);
    }
}

template <class Wide>
[[gnu::always_inline]] inline unsigned touched_bits(const Touched<Wide>& touched) {
    unsigned bits = 0;
    for (unsigned g = 0; g < Sixteen<Wide>::groups; ++g) bits |= Wide::bits(touched.hit[g]) << (Wide::width * g);
    return bits;
}

// Keys: the bits of an entry, which are in the order of the entries as none is negative, with the child's place in the lowest four. k_no_key is
// that of a child that is not touched or was taken already.
constexpr std::uint32_t k_no_key = 0x7f800000U;

template <class Wide>
[[gnu::always_inline]] inline Sixteen<Wide> keys_of(const Touched<Wide>& touched) {
    Sixteen<Wide> keys;
    for (unsigned g = 0; g < Sixteen<Wide>::groups; ++g)
        keys.part[g] = Wide::none_but(touched.hit[g], Wide::key(touched.entry.part[g], Wide::width * g));
    return keys;
}

template <class Wide>
[[gnu::always_inline]] inline std::uint32_t least_key(const Sixteen<Wide>& keys) {
    typename Wide::Float least = keys.part[0];
    for (unsigned g = 1; g < Sixteen<Wide>::groups; ++g) least = Wide::least(least, keys.part[g]);
    return Wide::least_of(least);
}

/// 1 if there is one that was not taken.
template <class Wide>
[[gnu::always_inline]] inline unsigned any_key(const Sixteen<Wide>& keys) {
    typename Wide::Float least = keys.part[0];
    for (unsigned g = 1; g < Sixteen<Wide>::groups; ++g) least = Wide::least(least, keys.part[g]);
    return Wide::bits(Wide::below(least, Wide::all(__builtin_inff()))) != 0 ? 1U : 0U;
}

/// Takes a key out.
template <class Wide>
[[gnu::always_inline]] inline void take_key(Sixteen<Wide>& keys, std::uint32_t key) {
    for (unsigned g = 0; g < Sixteen<Wide>::groups; ++g)
        keys.part[g] = Wide::none_where(Wide::same(keys.part[g], Wide::all_bits(key)), keys.part[g]);
}

/// Of a parameter, for comparison with keys: none of an entry up to it is larger.
template <class Wide>
[[gnu::always_inline]] inline std::uint32_t key_limit(float limit) {
    std::uint32_t bits;
    __builtin_memcpy(&bits, &limit, sizeof bits);
    return bits | 15U;
}

}  // namespace pierce::detail
