// Where a hit lies and how its plane lies there, each number with a bound for its error: what the place of a hit is chosen from.
//
// The true point is P = from + t d = a + w_b p + w_c q (plane.h), each coordinate by the formula whose terms vary less: so floors along two
// axes and paths along one come out exact, and errors are those of the mesh's coordinates where the segment's end is far away. With u the
// number's unit, e_t = (e_v + t e_s) / |s| + u t and e_w = (e_a + e_s) / |s| + u (quotients of what is off by e_v, e_s and e_a; weights and t are at most 1):
//   along the path    |d| e_t + u |d| (the product) + u (|from| + |d|) (the sum) + u (|from| + |d|) (d itself)
//   in the triangle   (|p| + |q|) e_w + u (|p| + |q|) + 2u (|a| + |p| + |q|) + u (|a| + |p| + |q|)
// in both cases below reach e + 5u (|base| + reach), reach being |d| or |p| + |q|; where that is 0 there is nothing to be off.
// A component of n is off by 4u (|p_i q_j| + |p_j q_i|) (differences 1, each, products 1, their difference 1), and by 2^-53 of itself where it was
// rounded from a DoubleDouble; it is exactly 0 where one factor of each product is. Everything is taken twice, for terms of second order and the roundings here.
// Underflow: a product loses 2^-1071 at most; 2^-1060 is added.
#pragma once

#include <kernel/plane.h>

namespace pierce::detail {

/// `high + low` is within `error` of the true point, `normal` (towards the front) within `normal_error` of a multiple of the true one.
struct Spot {
    Point high;
    Point low;
    Point error;
    Point normal;
    Point normal_error;
    double distance;  ///< of the start from the plane, at least, in units of |normal|
};

[[nodiscard]] inline double quotient(double x, double y) { return x / y; }
/// Within 2^-100 of itself: as in Divisor (double_double.h), whose last sum is left out.
[[nodiscard]] inline DoubleDouble quotient(const DoubleDouble& x_, const DoubleDouble& y_) {
    const DoubleDouble x = two_sum(x_.high, x_.low);
    const DoubleDouble y = two_sum(y_.high, y_.low);
    const double inverse = 1 / y.high;
    const double q = x.high * inverse;
    const DoubleDouble product = two_product(q, y.high);
    return {q, (((x.high - product.high) - product.low) + (x.low - q * y.low)) * inverse};
}

namespace spot {
[[nodiscard]] inline double number(double x, double) { return x; }
[[nodiscard]] inline DoubleDouble number(double x, DoubleDouble) { return {x, 0}; }
[[nodiscard]] inline DoubleDouble parts(double x) { return {x, 0}; }
[[nodiscard]] inline DoubleDouble parts(const DoubleDouble& x) { return two_sum(x.high, x.low); }
template <class Number>
[[nodiscard]] std::array<Number, 3> row(const Triple<Number>& x) { return {x.x, x.y, x.z}; }
}  // namespace spot

/// False where the bounds do not hold or say nothing.
template <class Number>
[[nodiscard]] bool find_spot(const Plane<Number>& plane, const Meeting<Number>& meeting, const Path& path, Spot& spot) {
    using A = Arithmetic<Number>;
    constexpr double u = A::unit;
    constexpr double k_least = 0x1p-1060;
    const double s = std::abs(A::rounded(meeting.s));
    if (!meeting.tame || !(meeting.es <= s * 0x1p-10)) return false;
    const Number t = quotient(meeting.v, meeting.s);
    const Number b = quotient(meeting.w.y, meeting.s);
    const Number c = quotient(meeting.w.z, meeting.s);
    const double et = 2 * ((meeting.ev + meeting.es) / s + u);
    const double ew = 2 * ((meeting.ea + meeting.es) / s + u);
    spot.distance = std::max(0.0, std::abs(A::rounded(meeting.v)) - meeting.ev);
    const auto p = spot::row(plane.p);
    const auto q = spot::row(plane.q);
    const auto d = spot::row(difference<Number>(path.to, path.from));
    for (std::size_t k = 0; k < 3; ++k) {
        const double along = std::abs(A::rounded(d[k]));
        const double across = std::abs(A::rounded(p[k])) + std::abs(A::rounded(q[k]));
        const bool on_path = along < across;
        const double base = on_path ? path.from[k] : plane.a[k];
        const double reach = on_path ? along : across;
        const Number origin = spot::number(base, t);
        const DoubleDouble x = spot::parts(on_path ? origin + t * d[k] : origin + b * p[k] + c * q[k]);
        spot.high[k] = x.high;
        spot.low[k] = x.low;
        spot.error[k] = reach == 0 ? 0 : reach * (on_path ? et : ew) + 10 * u * (std::abs(base) + reach) + k_least;

        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        const auto product = [](const Number& x1, const Number& x2) { return std::abs(A::rounded(x1)) * std::abs(A::rounded(x2)); };
        const auto none = [](const Number& x1, const Number& x2) { return A::rounded(x1) == 0 || A::rounded(x2) == 0; };
        spot.normal[k] = k == 0 ? plane.normal.x : k == 1 ? plane.normal.y : plane.normal.z;
        spot.normal_error[k] = none(p[i], q[j]) && none(p[j], q[i])
                                   ? 0
                                   : 8 * u * (product(p[i], q[j]) + product(p[j], q[i])) + 0x1p-52 * std::abs(spot.normal[k]) + k_least;
    }
    return true;
}

/// The true point rounded correctly, if that is certain: both ends of the interval around it round to one number, and rounding is monotone. (The
/// interval is widened by what its own sums lose.)
template <class Scalar>
[[nodiscard]] bool round_position(const Spot& spot, Point& position) {
    for (std::size_t k = 0; k < 3; ++k) {
        double low = spot.high[k];
        double high = low;
        if (spot.error[k] > 0 || spot.low[k] != 0) {
            double slack = spot.error[k] * (1 + 0x1p-20) + std::abs(spot.low[k]) * 0x1p-50 + 0x1p-1073;
            if (sizeof(Scalar) == 4) slack += std::abs(low) * 0x1p-51;  // for the sum, rounded to double before it is to float
            low += spot.low[k] - slack;
            high += spot.low[k] + slack;
        }
        if (static_cast<Scalar>(low) != static_cast<Scalar>(high)) return false;
        position[k] = static_cast<double>(static_cast<Scalar>(low)) + 0.0;
    }
    return true;
}

}  // namespace pierce::detail
