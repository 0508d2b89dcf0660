// Digit by digit, from the last (Knuth, volume 3, 5.2.5), in parts that know where each of their digits goes.
#include <grid/sort_by_key.h>

#include <algorithm>
#include <utility>
#include <vector>

#include <chunks.h>

namespace pierce::detail {

void sort_by_key(RawArray<std::uint32_t>& keys, RawArray<std::uint32_t>& numbers, const Executor& executor) {
    constexpr int k_bits = 11;
    constexpr std::size_t k_digits = std::size_t{1} << k_bits;
    const std::size_t part = std::max<std::size_t>(std::size_t{1} << 13, keys.size() / 16 + 1);
    const std::size_t parts = chunks_of(keys.size(), part);
    RawArray<std::uint32_t> other_keys(keys.size());
    RawArray<std::uint32_t> other_numbers(numbers.size());
    std::vector<std::uint32_t> next(parts * k_digits);
    for (int shift = 0; shift < 32; shift += k_bits) {
        const auto digit = [&](std::uint32_t key) { return key >> shift & (k_digits - 1); };
        const auto count = [&](std::size_t p, std::size_t begin, std::size_t end) {
            std::uint32_t* counts = &next[p * k_digits];
            std::fill_n(counts, k_digits, 0);
            for (std::size_t i = begin; i < end; ++i) ++counts[digit(keys[i])];
        };
        each_chunk(executor, keys.size(), count, part);
        std::size_t zeros = 0;
        for (std::size_t p = 0; p < parts; ++p) zeros += next[p * k_digits];
        if (zeros == keys.size()) continue;  // as the high digits of a small level's are
        std::uint32_t sum = 0;
        for (std::size_t d = 0; d < k_digits; ++d)
            for (std::size_t p = 0; p < parts; ++p) sum += std::exchange(next[p * k_digits + d], sum);
        const auto move = [&](std::size_t p, std::size_t begin, std::size_t end) {
            std::uint32_t* places = &next[p * k_digits];
            for (std::size_t i = begin; i < end; ++i) {
                const std::uint32_t to = places[digit(keys[i])]++;
                other_keys[to] = keys[i];
                other_numbers[to] = numbers[i];
            }
        };
        each_chunk(executor, keys.size(), move, part);
        std::swap(keys, other_keys);
        std::swap(numbers, other_numbers);
    }
}

}  // namespace pierce::detail
