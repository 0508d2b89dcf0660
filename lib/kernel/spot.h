// Where a hit lies and how its plane lies there, each number with a bound for its error: what the place of a hit is
// chosen from.
#pragma once

#include <cmath>
#include <cstddef>

#include <path.h>

namespace pierce::detail {

/// `high + low` is within `error` of the true point, `normal` (towards the front) within `normal_error` of a multiple
/// of the true one.
struct Spot {
    Point high;
    Point low;
    Point error;
    Point normal;
    Point normal_error;
    double length;    ///< |normal|
    double distance;  ///< of the start from the plane, at least but for a rounding, in units of |normal|
};

/// The true point rounded correctly, if that is certain: both ends of the interval around it round to one number, and
/// rounding is monotone. (The
/// interval is widened by what its own sums lose.)
template <class Scalar>
[[nodiscard]] bool round_position(const Spot& spot, Point& position) {
    for (std::size_t k = 0; k < 3; ++k) {
        double low = spot.high[k];
        double high = low;
        if (spot.error[k] > 0 || spot.low[k] != 0) {
            double slack = spot.error[k] * (1 + 0x1p-20) + std::abs(spot.low[k]) * 0x1p-50 + 0x1p-1073;
            if (sizeof(Scalar) == 4)
                slack += std::abs(low) * 0x1p-51;  // for the sum, rounded to double before it is to float
            low += spot.low[k] - slack;
            high += spot.low[k] + slack;
        }
        if (static_cast<Scalar>(low) != static_cast<Scalar>(high)) return false;
        position[k] = static_cast<double>(static_cast<Scalar>(low)) + 0.0;
    }
    return true;
}

}  // namespace pierce::detail
