// A small box in eight bytes, so that one comparison tests it against another: the grid writes them, the kernels cull with them.
#pragma once

#include <cstdint>

#include <packed_level.h>

namespace pierce::detail {

using Ints [[gnu::vector_size(16)]] = int;

/// A closed box in steps; three integers each, the fourth is 0.
struct Steps {
    Ints low;
    Ints high;
};

/// A box is listed in the cells that it comes within this many steps of, and lies at least as far inside of the grid (kernel/walk.h says why).
constexpr int k_margin = 1;

namespace packing {

[[nodiscard]] inline Ints within(const Ints& x, int most) {
    const Ints least = {0, 0, 0, 0};
    const Ints greatest = {most, most, most, most};
    const Ints above = x > least ? x : least;
    return above < greatest ? above : greatest;
}
using Halves [[gnu::vector_size(16)]] = std::uint64_t;

// The low bytes of four numbers; two at a time, as baseline machines have no instruction for it.
[[nodiscard]] inline std::uint64_t bytes(const Ints& x) {
    const Ints byte = {0xff, 0xff, 0xff, 0xff};
    const auto halves = reinterpret_cast<Halves>(x & byte);
    const auto two = [](std::uint64_t half) { return (half | half >> 24) & 0xffff; };
    return two(halves[0]) | two(halves[1]) << 16;
}
// Bit k set where number k is not 0, for masks.
[[nodiscard]] inline std::uint64_t bits(const Ints& mask) {
    const Ints bit = {1, 2, 4, 0};
    const auto halves = reinterpret_cast<Halves>(mask & bit);
    return (halves[0] | halves[0] >> 32 | halves[1]) & 7;
}

}  // namespace packing

/// The part of a box in a cell, given by its place in cells; the fourth number is 0.
[[nodiscard]] inline PackedBox pack(const Steps& box, const Ints& cell) {
    const Ints low = box.low - cell * k_steps;
    const Ints high = box.high - cell * k_steps;
    const std::uint64_t lower = packing::bytes(packing::within(low, k_steps - 1)) | packing::bits(low < k_margin) << 24;
    const std::uint64_t upper = packing::bytes(-packing::within(high, k_steps - 1)) | packing::bits(high >= k_steps - k_margin) << 24;
    return lower | upper << 32;
}

}  // namespace pierce::detail
