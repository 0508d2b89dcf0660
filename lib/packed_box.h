// A small box in eight bytes, so that one comparison tests it against another: the grid writes them, the kernels cull with them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include <packed_level.h>

namespace pierce::detail {

/// A closed box in steps; three integers each.
struct Steps {
    std::array<int, 3> low;
    std::array<int, 3> high;
};

/// A box is listed in the cells that it comes within this many steps of, and lies at least as far inside of the grid (kernel/walk.h says why).
constexpr int k_margin = 1;

namespace packing {

[[nodiscard]] inline std::uint64_t byte(int value, int place) {
    return (static_cast<std::uint64_t>(value) & 0xff) << (8 * place);
}
[[nodiscard]] inline int clamped(int step) { return std::clamp(step, 0, k_steps - 1); }

}  // namespace packing

/// The part of a box in a cell, given by its place in cells.
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

}  // namespace pierce::detail
