// A small box in eight bytes, so that one comparison tests it against another: the grid writes them, the kernels cull with them.
#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

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

#if defined(__SSE2__)
/// Bytes 0-2: three numbers, cut to the range from 0 to `most`; bytes 4-6: three more, negated. The other two are 0. Eight bytes at once, as
/// packing saturates: half the time of a fill.
[[nodiscard]] inline std::uint64_t bytes(const Ints& low, const Ints& high, short most) {
    const short least = static_cast<short>(-most);
    const __m128i both = _mm_packs_epi32(reinterpret_cast<__m128i>(low), reinterpret_cast<__m128i>(-high));
    const __m128i above = _mm_max_epi16(both, _mm_setr_epi16(0, 0, 0, 0, least, least, least, 0));
    const __m128i within = _mm_min_epi16(above, _mm_setr_epi16(most, most, most, 0, 0, 0, 0, 0));
    return static_cast<std::uint64_t>(_mm_cvtsi128_si64(_mm_packs_epi16(within, within)));
}
/// Bit k set where mask k is, for three masks.
[[nodiscard]] inline std::uint64_t bits(const Ints& mask) {
    return static_cast<std::uint64_t>(_mm_movemask_ps(reinterpret_cast<__m128>(mask))) & 7;
}
#else
[[nodiscard]] inline std::uint64_t bytes(const Ints& low, const Ints& high, int most) {
    std::uint64_t packed = 0;
    for (int k = 0; k < 3; ++k) {
        const auto within = [&](int x) { return x < 0 ? 0 : x < most ? x : most; };
        packed |= static_cast<std::uint64_t>(within(low[k])) << 8 * k;
        packed |= static_cast<std::uint64_t>(-within(high[k]) & 0xff) << 8 * (k + 4);
    }
    return packed;
}
[[nodiscard]] inline std::uint64_t bits(const Ints& mask) {
    return (mask[0] != 0 ? 1 : 0) | (mask[1] != 0 ? 2 : 0) | (mask[2] != 0 ? 4 : 0);
}
#endif

}  // namespace packing

/// The part of a box in a cell, given by its place in cells; the fourth number is 0.
[[nodiscard]] inline PackedBox pack(const Steps& box, const Ints& cell) {
    const Ints corner = cell << k_step_bits;
    const Ints low = box.low - corner;
    const Ints high = box.high - corner;
    const std::uint64_t flags = packing::bits(low < k_margin) << 24 | packing::bits(high >= k_steps - k_margin) << 56;
    return packing::bytes(low, high, k_steps - 1) | flags;
}

}  // namespace pierce::detail
