// The decision contract's closed rule, on signs: what a hit is, once the sides of a segment's ends and the signs of its
// weights are known.
#pragma once

#include <cstdint>

#include <pierce/sides.h>

namespace pierce::detail {

struct Decision {
    bool hit = false;
    Sides side = Sides::front;           ///< front or back: where the segment comes from
    Feature feature = Feature::face;
    std::uint8_t feature_index = 0;
    bool at_start = false;
};

/// Whether ends on these sides pass the plane from its front: on the plane counts as in front.
[[nodiscard]] [[gnu::always_inline]] constexpr bool passes_front(int from, int to) { return from >= 0 && to < 0; }

/// Whether they pass it from its back. On the plane counts as behind for `back`, which is `front` mirrored; for `both`
/// as in
/// front, so that a hit is a change of side: a point on the plane can leave it to the front.
[[nodiscard]] [[gnu::always_inline]] constexpr bool passes_back(int from, int to, Sides sides) {
    return sides == Sides::both ? from < 0 && to >= 0 : from <= 0 && to > 0;
}

/// The ends pass the plane from a side that counts, and the segment meets the closed triangle. `from`, `to`: the signs
/// of the ends' sides; `weight(k)`: that of corner k's weight times their difference. It is asked only if it matters.
template <class Weight>
[[nodiscard]] [[gnu::always_inline]] inline Decision closed_rule(int from, int to, Sides sides, Weight&& weight) {
    Decision decision{};
    const bool front = passes_front(from, to) && sides != Sides::back;
    const bool back = passes_back(from, to, sides) && sides != Sides::front;
    if (!front && !back) return decision;

    // The sides differ, so the line pierces the plane in one point, and the three weights, which add up to the
    // difference of the sides, have the sign of that inside and zero on an edge.
    int zeros = 0;
    int last_zero = 0;
    int last_nonzero = 0;
    for (int k = 0; k < 3; ++k) {
        const int sign = weight(k);
        if (sign == (front ? -1 : 1)) return decision;
        if (sign == 0) {
            ++zeros;
            last_zero = k;
        } else {
            last_nonzero = k;
        }
    }
    decision.hit = true;
    decision.side = front ? Sides::front : Sides::back;
    decision.at_start = from == 0;
    if (zeros == 1) {
        decision.feature = Feature::edge;  // the edge opposite to the corner without weight
        decision.feature_index = static_cast<std::uint8_t>((last_zero + 1) % 3);
    } else if (zeros == 2) {
        decision.feature = Feature::vertex;
        decision.feature_index = static_cast<std::uint8_t>(last_nonzero);
    }
    return decision;
}

/// Whether the weight of corner k is exactly 0 for what a hit lies on.
[[nodiscard]] constexpr bool is_off(const Decision& decision, int k) {
    return decision.feature == Feature::edge     ? k == (decision.feature_index + 2) % 3
           : decision.feature == Feature::vertex ? k != decision.feature_index
                                                 : false;
}

}  // namespace pierce::detail
