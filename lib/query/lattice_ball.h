// The points of whole numbers within a distance of 0, nearest first.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace pierce::detail {

/// Those within `reach`, but for 0 itself: by their squares, then x, then y, then |z|, then z downwards. Made when the
/// library is compiled: for `reach` 12, 30,000 pairs of x and y and a root for each took longer than all that is asked
/// about the 7,152 points.
template <int reach>
class LatticeBall {
  public:
    struct Place {
        std::int8_t x;
        std::int8_t y;
        std::int8_t z;
    };

    constexpr LatticeBall() {
        std::array<std::size_t, k_squares + 2> begin{};
        each([&](int, int, int, std::size_t square) { ++begin[square + 1]; });
        for (std::size_t square = 0; square <= k_squares; ++square) begin[square + 1] += begin[square];
        each([&](int x, int y, int z, std::size_t square) {
            places_[begin[square]++] = {static_cast<std::int8_t>(x), static_cast<std::int8_t>(y),
                                        static_cast<std::int8_t>(z)};
        });
    }

    [[nodiscard]] constexpr const Place* begin() const { return places_.data(); }
    [[nodiscard]] constexpr const Place* end() const { return places_.data() + k_count; }

  private:
    static_assert(reach > 0 && reach < 128);
    static constexpr std::size_t k_squares = std::size_t{reach} * reach;

    template <class Visit>
    static constexpr void each(Visit&& visit) {
        for (int x = -reach; x <= reach; ++x)
            for (int y = -reach; y <= reach; ++y)
                for (int z = 0; x * x + y * y + z * z <= reach * reach; ++z) {
                    const auto square = static_cast<std::size_t>(x * x + y * y + z * z);
                    if (square == 0) continue;
                    visit(x, y, z, square);
                    if (z != 0) visit(x, y, -z, square);
                }
    }
    static constexpr std::size_t count() {
        std::size_t sum = 0;
        each([&](int, int, int, std::size_t) { ++sum; });
        return sum;
    }
    static constexpr std::size_t k_count = count();

    std::array<Place, k_count> places_{};
};

}  // namespace pierce::detail
