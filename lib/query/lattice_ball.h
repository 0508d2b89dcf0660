// The points of whole numbers within a distance of 0, nearest first.
#pragma once

#include <array>
#include <cmath>

namespace pierce::detail {

/// Calls `visit(x, y, z)` until it says true, and says whether it did; in a ball of 12 there are 7,153 points, and some
/// 30,000 pairs are looked at.
template <class Visit>
bool each_in_ball(double reach, Visit&& visit) {
    const int last = static_cast<int>(reach * reach);
    for (int square = 1; square <= last; ++square) {
        const int most = static_cast<int>(std::sqrt(static_cast<double>(square)));
        for (int x = -most; x <= most; ++x)
            for (int y = -most; y <= most; ++y) {
                const int rest = square - x * x - y * y;
                if (rest < 0) continue;
                const int z = static_cast<int>(std::sqrt(static_cast<double>(rest)));  // exact for a square
                if (z * z != rest) continue;
                if (visit(x, y, z) || (z != 0 && visit(x, y, -z))) return true;
            }
    }
    return false;
}

}  // namespace pierce::detail
