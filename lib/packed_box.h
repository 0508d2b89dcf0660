// A small box in eight bytes, so that one comparison tests it against another: the grid writes them, the kernels cull with them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace pierce::detail {

/// Steps to a cell, along each axis: what a packed box is measured in, counted from the cell's lower corner.
constexpr int k_step_bits = 7;
constexpr int k_steps = 1 << k_step_bits;

/// A closed box in steps; three integers each.
struct Steps {
    std::array<int, 3> low;
    std::array<int, 3> high;
};

/// A box is listed in the cells that it comes within this many steps of (grid/walk.h says why).
constexpr int k_margin = 1;

/// The part of a box in one cell. Bytes 0-2 hold its lower corner, bytes 4-6 its upper one, negated; byte 3 has bit k set where the
/// cell before this one along axis k lists the box too, byte 7 where the one after it does. Each is a signed byte. So for a box and
/// a `Cull`, all that makes them disjoint is that a byte of the one is larger than that of the other.
using PackedBox = std::uint64_t;

/// What packed boxes are compared with: a box is of no use if one of its bytes, as signed numbers, is larger than that of `above`, or
/// if it has a bit of `seen`.
struct Cull {
    std::uint64_t above;
    std::uint64_t seen;
};

namespace packing {

[[nodiscard]] inline std::uint64_t byte(int value, int place) {
    return (static_cast<std::uint64_t>(value) & 0xff) << (8 * place);
}
[[nodiscard]] inline int clamped(int step) { return std::clamp(step, 0, k_steps - 1); }

}  // namespace packing

/// `cell`: the place of the cell, in cells.
[[nodiscard]] inline PackedBox pack(const Steps& box, const std::array<int, 3>& cell) {
    PackedBox packed = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const int corner = cell[k] * k_steps;
        const int at = static_cast<int>(k);
        packed |= packing::byte(packing::clamped(box.low[k] - corner), at);
        packed |= packing::byte(-packing::clamped(box.high[k] - corner), at + 4);
        packed |= packing::byte(box.low[k] - k_margin < corner ? 1 << k : 0, 3);
        packed |= packing::byte(box.high[k] + k_margin >= corner + k_steps ? 1 << k : 0, 7);
    }
    return packed;
}

/// Leaves the boxes that share a step with `box` in a cell.
[[nodiscard, gnu::always_inline]] inline Cull cull_of(const Steps& box, const std::array<int, 3>& cell) {
    Cull cull{packing::byte(127, 3) | packing::byte(127, 7), 0};
    for (std::size_t k = 0; k < 3; ++k) {
        const int corner = cell[k] * k_steps;
        const int at = static_cast<int>(k);
        cull.above |= packing::byte(packing::clamped(box.high[k] - corner), at);
        cull.above |= packing::byte(-packing::clamped(box.low[k] - corner), at + 4);
    }
    return cull;
}

/// The boxes that the cell before this one, along each axis where that is one of the query's as well, lists too are left to that one: it leaves
/// them whenever this one would, as the query's box then reaches to its end.
[[nodiscard]] inline std::uint64_t seen_before(const std::array<int, 3>& cell, const std::array<int, 3>& first) {
    int axes = 0;
    for (std::size_t k = 0; k < 3; ++k) axes |= cell[k] > first[k] ? 1 << k : 0;
    return packing::byte(axes, 3);
}

/// Leaves all boxes but those that the cell listed from which a walk came, by a step of +1 or -1 along an axis.
[[nodiscard]] inline Cull cull_seen(std::size_t axis, int step) {
    return {0x7f7f7f7f7f7f7f7f, packing::byte(1 << axis, step > 0 ? 3 : 7)};
}
[[nodiscard]] inline Cull cull_none() { return {0x7f7f7f7f7f7f7f7f, 0}; }

}  // namespace pierce::detail
