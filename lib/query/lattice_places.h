// The places on a lattice of one unit around a point, each coordinate rounded to a Scalar.
#pragma once

#include <array>
#include <cstddef>

#include <point.h>
#include <query/lattice_ball.h>

namespace pierce::detail {

/// Calls `visit(place)` for those of up to `most_steps` units from `high` that are within `reach` of `high + low`, both
/// in units, and are moved by `least` at least along `normal`: nearest first, until it says true, and says whether it
/// did.
///
/// All that is asked of a place is a sum over its coordinates, each of which is one of a few numbers; so 7,152 places
/// cost some tens of microseconds.
template <class Scalar, int most_steps, class Visit>
[[nodiscard]] bool each_on_lattice(const Point& high, const Point& low, double unit, const Point& normal, double least,
                                   double reach, Visit&& visit) {
    struct Step {
        double to;      // the coordinate
        double out;     // its part in how far the place is moved along the normal
        double square;  // and in the square of the distance, in units
    };
    std::array<std::array<Step, std::size_t{2 * most_steps + 1}>, 3> steps;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto near = static_cast<double>(static_cast<Scalar>(high[k]));
        for (int step = -most_steps; step <= most_steps; ++step) {
            const double by = step * unit;
            const auto to = static_cast<double>(static_cast<Scalar>(near + by));
            const double off = ((to - high[k]) - low[k]) / unit;
            steps[k][static_cast<std::size_t>(step + most_steps)] = {to, by * normal[k], off * off};
        }
    }
    const auto at = [&](std::size_t k, int step) -> const Step& {
        return steps[k][static_cast<std::size_t>(step + most_steps)];
    };
    static constexpr LatticeBall<most_steps> k_ball;
    for (const auto& place : k_ball) {
        const Step& x = at(0, place.x);
        const Step& y = at(1, place.y);
        const Step& z = at(2, place.z);
        if (x.out + y.out + z.out < least || !(x.square + y.square + z.square <= reach * reach)) continue;
        if (visit(Point{x.to, y.to, z.to})) return true;
    }
    return false;
}

}  // namespace pierce::detail
