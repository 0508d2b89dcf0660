// Three counting passes of ten bits each (Knuth, volume 3, 5.2.5), in parts that know where each of their digits goes.
#include <cluster/sort_entries.h>

#include <algorithm>
#include <utility>
#include <vector>

#include <chunks.h>

namespace pierce::detail {

namespace {

constexpr int k_digit_bits = 10;
constexpr std::size_t k_digits = std::size_t{1} << k_digit_bits;

// The digit's place is a constant: one in a register is read from memory again after each store.
template <int pass>
std::size_t digit(std::uint64_t entry) {
    return entry >> (32 + pass * k_digit_bits) & (k_digits - 1);
}

// Counts to places: of the digits in their order, each with its parts in theirs.
void add_up(std::uint32_t* counts, std::size_t parts) {
    std::uint32_t sum = 0;
    for (std::size_t d = 0; d < k_digits; ++d)
        for (std::size_t p = 0; p < parts; ++p) sum += std::exchange(counts[p * k_digits + d], sum);
}

template <int pass>
void move(const std::uint64_t* from, std::size_t begin, std::size_t end, std::uint64_t* to, std::uint32_t* places) {
    for (std::size_t i = begin; i < end; ++i) to[places[digit<pass>(from[i])]++] = from[i];
}

// One thread counts all digits at once.
void sort_alone(std::uint64_t* entries, std::uint64_t* sorted, std::size_t count) {
    std::vector<std::uint32_t> places(3 * k_digits);
    std::uint32_t* const digits = places.data();
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint64_t entry = entries[i];
        ++digits[digit<0>(entry)];
        ++digits[k_digits + digit<1>(entry)];
        ++digits[2 * k_digits + digit<2>(entry)];
    }
    for (int pass = 0; pass < 3; ++pass) add_up(digits + static_cast<std::size_t>(pass) * k_digits, 1);
    move<0>(entries, 0, count, sorted, digits);
    move<1>(sorted, 0, count, entries, digits + k_digits);
    move<2>(entries, 0, count, sorted, digits + 2 * k_digits);
}

// `places` has k_digits for each part.
template <int pass>
void sort_by_digit(const std::uint64_t* from, std::uint64_t* to, std::size_t count, std::vector<std::uint32_t>& places,
                   std::size_t part, const Executor& executor) {
    each_chunk(
        executor, count,
        [&](std::size_t p, std::size_t begin, std::size_t end) {
            std::uint32_t* counts = &places[p * k_digits];
            std::fill_n(counts, k_digits, 0);
            for (std::size_t i = begin; i < end; ++i) ++counts[digit<pass>(from[i])];
        },
        part);
    add_up(places.data(), places.size() / k_digits);
    each_chunk(
        executor, count,
        [&](std::size_t p, std::size_t begin, std::size_t end) {
            move<pass>(from, begin, end, to, &places[p * k_digits]);
        },
        part);
}

}  // namespace

void sort_entries(std::uint64_t* entries, std::uint64_t* sorted, std::size_t count, const Executor& executor) {
    // The order does not depend on the parts: each pass is stable.
    const std::size_t part = std::max<std::size_t>(std::size_t{1} << 13, count / 32 + 1);
    if (!executor || count <= part) return sort_alone(entries, sorted, count);
    std::vector<std::uint32_t> places(chunks_of(count, part) * k_digits);
    sort_by_digit<0>(entries, sorted, count, places, part, executor);
    sort_by_digit<1>(sorted, entries, count, places, part, executor);
    sort_by_digit<2>(entries, sorted, count, places, part, executor);
}

}  // namespace pierce::detail
