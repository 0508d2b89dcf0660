// A triangle as the filter reads it.
#include <mesh/prepared_triangle.h>

#include <cmath>
#include <limits>

#include <exact/planes.h>

namespace pierce::detail {

namespace {

// The unit that the bounds are in: any operation, in any rounding mode, is within 2^-52 of its exact result.
constexpr double k_unit = 0x1p-52;

double sum_of_magnitudes(const Point& v) { return std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]); }

// The bound of a weight's product with D: see kernel/filter.h for the 30, and for why a plane out of this range has none.
double weight_error(double normal, double weight) {
    return weight >= 0x1p-300 && weight <= 0x1p300 ? 30 * k_unit * normal * weight
                                                   : std::numeric_limits<double>::infinity();
}

}  // namespace

PreparedTriangle prepare(const Corners& corners) {
    const Planes planes = exact_planes(corners);
    const double normal = sum_of_magnitudes(planes.normal);
    return {.b = corners[1],
            .normal = planes.normal,
            .weight_c = planes.weight_c,
            .weight_a = planes.weight_a,
            .plane_error = 6 * k_unit * normal,
            .weight_c_error = weight_error(normal, sum_of_magnitudes(planes.weight_c)),
            .weight_a_error = weight_error(normal, sum_of_magnitudes(planes.weight_a))};
}

}  // namespace pierce::detail
