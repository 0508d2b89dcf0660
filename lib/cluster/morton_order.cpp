// Digit by digit, from the last (Knuth, volume 3, 5.2.5), in parts that know where each of their digits goes.
#include <cluster/morton_order.h>

#include <algorithm>
#include <utility>
#include <vector>

#include <chunks.h>

namespace pierce::detail {

void sort_by_key(RawArray<Keyed>& keyed, const Executor& executor) {
    constexpr int k_bits = 10;
    constexpr std::size_t k_digits = std::size_t{1} << k_bits;
    const std::size_t part = std::max<std::size_t>(std::size_t{1} << 14, keyed.size() / 8 + 1);
    const std::size_t parts = chunks_of(keyed.size(), part);
    RawArray<Keyed> other(keyed.size());
    std::vector<std::uint32_t> next(parts * k_digits);
    for (int shift = 32; shift < 32 + k_key_bits; shift += k_bits) {
        const auto digit = [&](Keyed x) { return x >> shift & (k_digits - 1); };
        each_chunk(executor, keyed.size(), [&](std::size_t p, std::size_t begin, std::size_t end) {
            std::uint32_t* counts = &next[p * k_digits];
            std::fill_n(counts, k_digits, 0);
            for (std::size_t i = begin; i < end; ++i) ++counts[digit(keyed[i])];
        }, part);
        std::uint32_t sum = 0;
        for (std::size_t d = 0; d < k_digits; ++d)
            for (std::size_t p = 0; p < parts; ++p) sum += std::exchange(next[p * k_digits + d], sum);
        each_chunk(executor, keyed.size(), [&](std::size_t p, std::size_t begin, std::size_t end) {
            std::uint32_t* places = &next[p * k_digits];
            for (std::size_t i = begin; i < end; ++i) other[places[digit(keyed[i])]++] = keyed[i];
        }, part);
        std::swap(keyed, other);
    }
}

}  // namespace pierce::detail
