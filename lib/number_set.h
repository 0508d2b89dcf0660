// Some of the numbers below a bound, a bit for each.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pierce::detail {

class NumberSet {
  public:
    explicit NumberSet(std::size_t bound) : words_((bound + 63) / 64) {}

    void add(std::uint32_t number) { words_[number / 64] |= std::uint64_t{1} << number % 64; }
    void clear() { std::fill(words_.begin(), words_.end(), 0); }
    /// Calls `visit(number)` from the largest down; it may add smaller ones.
    template <class Visit>
    void each_down(Visit&& visit) const {
        for (std::size_t w = words_.size(); w-- > 0;) {
            std::uint64_t seen = 0;
            for (std::uint64_t left = 0; (left = words_[w] & ~seen) != 0;) {
                const auto bit = static_cast<unsigned>(63 - std::countl_zero(left));
                seen |= std::uint64_t{1} << bit;
                visit(static_cast<std::uint32_t>(64 * w + bit));
            }
        }
    }
    [[nodiscard]] std::size_t bytes() const { return words_.capacity() * sizeof(std::uint64_t); }

  private:
    std::vector<std::uint64_t> words_;
};

}  // namespace pierce::detail
