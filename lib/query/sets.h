// Sets that grow together.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace pierce::detail {

/// Union-find (Tarjan 1975), with paths halved on the way.
class Sets {
  public:
    explicit Sets(std::size_t count) { reset(count); }

    void reset(std::size_t count) {
        parent_.resize(count);
        std::iota(parent_.begin(), parent_.end(), 0U);
    }
    [[nodiscard]] std::uint32_t find(std::uint32_t x) {
        while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
        return x;
    }
    /// Whether they were apart. The lower root stays one.
    bool join(std::uint32_t x, std::uint32_t y) {
        x = find(x);
        y = find(y);
        if (x == y) return false;
        parent_[std::max(x, y)] = std::min(x, y);
        return true;
    }

  private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace pierce::detail
