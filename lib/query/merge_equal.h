// Vertices by their coordinates: which have the same.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <point.h>
#include <raw_array.h>

namespace pierce::detail {

/// Equal coordinates have equal numbers: -0 becomes 0. Products and shifts, so that coordinates on a lattice, or with
/// the low half empty as those of floats, spread over all bits.
[[nodiscard]] inline std::uint64_t hash_of(const Point& position) {
    std::uint64_t hash = 0;
    for (const double x : position) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0x9E3779B97F4A7C15U;  // 2^64 over the golden ratio
        hash ^= hash >> 32;
    }
    return hash * 0xD6E8FEB86659FD93U;
}

/// For each position the first one with the same coordinates. A position that is not a number is the same as itself
/// only. A table of at least twice as many places, probed one after another from where the hash says (Knuth, volume 3,
/// 6.4).
[[nodiscard]] inline std::vector<std::uint32_t> merge_equal(std::span<const Point> positions) {
    constexpr std::size_t k_block = 16;                  // so many places are asked for together
    constexpr std::uint64_t k_free = ~std::uint64_t{0};  // no position has this number
    const int bits = std::max(4, static_cast<int>(std::bit_width(2 * positions.size())));
    const std::size_t mask = (std::size_t{1} << bits) - 1;
    RawArray<std::uint64_t> table(mask + 1);  // 32 bits of the hash, then the position's number
    std::fill(table.begin(), table.end(), k_free);
    std::vector<std::uint32_t> same(positions.size());
    for (std::size_t begin = 0; begin < positions.size(); begin += k_block) {
        const std::size_t end = std::min(positions.size(), begin + k_block);
        std::uint64_t hashes[k_block];
        for (std::size_t i = begin; i < end; ++i) {
            hashes[i - begin] = hash_of(positions[i]);
            __builtin_prefetch(&table[static_cast<std::size_t>(hashes[i - begin] >> (64 - bits))], 1);
        }
        for (std::size_t i = begin; i < end; ++i) {
            same[i] = static_cast<std::uint32_t>(i);
            if (std::isnan(positions[i][0])) continue;
            const std::uint64_t tag = hashes[i - begin] << 32;
            for (auto place = static_cast<std::size_t>(hashes[i - begin] >> (64 - bits));; place = (place + 1) & mask) {
                std::uint64_t& entry = table[place];
                if (entry == k_free) {
                    entry = tag | i;
                    break;
                }
                const auto other = static_cast<std::uint32_t>(entry);
                if ((entry ^ tag) >> 32 == 0 && positions[other] == positions[i]) {
                    same[i] = other;
                    break;
                }
            }
        }
    }
    return same;
}

}  // namespace pierce::detail
