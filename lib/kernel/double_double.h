// Numbers of twice a double's precision: the unevaluated sum of two doubles, without a branch and the same on every machine.
//
// As in Lange and Rump 2020, "Faithfully rounded floating-point computations" (CPair): the high parts are those of plain arithmetic, the low
// part is what they lost, itself computed in plain arithmetic, and the two are not made to fit again after each operation. So a sum takes 8
// operations, not 20 as in Joldes, Muller and Popescu 2017 (algorithm 6), and what is lost is bounded by the magnitudes of the operands, not
// by the result's: which is what the bounds of this library are made of. (Measured for the values of a hit: README.md, "What exactness costs".)
//
// The errors, in round to nearest (environment.h), with v = 2^-53. Let |x| be at most A, its low part at most j v A, and y, B, k alike.
//   sum        high + e = x.high + y.high exactly (TwoSum, Knuth), |e| <= v (A + B); low = e + (x.low + y.low) with two roundings:
//              v max(j, k) v (A + B) + v (1 + max(j, k)) v (A + B) = (2 max(j, k) + 1) v^2 (A + B); its low part: (max(j, k) + 1) v (A + B)
//   product    high + e = x.high y.high exactly (Dekker 1971), |e| <= v AB; low = e + (x.high y.low + x.low y.high): two products and a sum,
//              2 (j + k) v^2; the last sum, (1 + j + k) v^2; x.low y.low left out, j k v^2: in all
//              (1 + 3 (j + k) + j k) v^2 AB; its low part: (1 + j + k) v AB
//   difference of two doubles: exact; j = 1.
// (Each times 1 + 2^-48 for what is of higher order.) In the deepest formula here, plane.h's weight a, the j of operands are
//   differences 1, products of two 3, cross products 4, products with a difference 6, sums of three 8, then 9:
//   products 8 v^2 and 20 v^2, sums 7, 13, 15, 17 and 19 v^2: each operation is within 32 v^2 = 2^-100 of its magnitude, with room.
// Underflow: each of Dekker's five products and of the two others loses at most 2^-1074 more: 2^-1071 in all; sums lose nothing.
// Overflow: splitting multiplies by 2^27 + 1: all is finite for operands below 2^990 whose product is below 2^1020.
#pragma once

namespace pierce::detail {

struct DoubleDouble {
    double high;
    double low;
};

/// x + y exactly, for any doubles whose sum is finite.
[[nodiscard]] inline DoubleDouble two_sum(double x, double y) {
    const double sum = x + y;
    const double of_y = sum - x;
    return {sum, (x - (sum - of_y)) + (y - of_y)};
}

/// A double as the sum of two of 26 bits (Veltkamp).
[[nodiscard]] inline DoubleDouble split(double x) {
    const double large = 0x8000001p0 * x;
    const double high = large - (large - x);
    return {high, x - high};
}

/// x y exactly, but for underflow.
[[nodiscard]] inline DoubleDouble two_product(double x, double y) {
    const double product = x * y;
    const DoubleDouble a = split(x);
    const DoubleDouble b = split(y);
    return {product, ((a.high * b.high - product) + a.high * b.low + a.low * b.high) + a.low * b.low};
}

[[nodiscard]] inline DoubleDouble operator-(const DoubleDouble& x) { return {-x.high, -x.low}; }

[[nodiscard]] inline DoubleDouble operator+(const DoubleDouble& x, const DoubleDouble& y) {
    const DoubleDouble sum = two_sum(x.high, y.high);
    return {sum.high, sum.low + (x.low + y.low)};
}

[[nodiscard]] inline DoubleDouble operator-(const DoubleDouble& x, const DoubleDouble& y) { return x + -y; }

[[nodiscard]] inline DoubleDouble operator*(const DoubleDouble& x, const DoubleDouble& y) {
    const DoubleDouble product = two_product(x.high, y.high);
    return {product.high, product.low + (x.high * y.low + x.low * y.high)};
}

/// What a formula that is written once needs to know of its numbers. `unit`: each of its operations is within this much of the magnitudes of
/// what goes in; `difference`, of two doubles, too. `Divisor(y)(x)`: x / y as a double.
template <class Number>
struct Arithmetic;

template <>
struct Arithmetic<double> {
    static constexpr double unit = 0x1p-52;  // any rounding mode
    static double difference(double x, double y) { return x - y; }
    static double rounded(double x) { return x; }

    struct Divisor {
        explicit Divisor(double y_) : y(y_) {}
        double operator()(double x) const { return x / y; }
        double y;
    };
};

template <>
struct Arithmetic<DoubleDouble> {
    static constexpr double unit = 0x1p-100;
    static DoubleDouble difference(double x, double y) { return two_sum(x, -y); }
    static double rounded(const DoubleDouble& x) { return x.high + x.low; }

    /// Rounded once, but for 2^-100 of itself before that, if nothing underflows. The parts are made to fit first: each low one is within
    /// v of its high one. Then q = x.high * (1 / y.high) is within 4v of x / y, and what is missing is (x - q y) / y, |x - q y| <= 4v |x|:
    /// x.high - product.high is exact (the two are within a few units of each other), the sums lose 5, 2 and 7 v^2 |x|, q y.low
    /// 1 v^2 |x|, and the inverse of y.high in place of that of y 3v of 5v |q|, the last product 5 v^2: 35 v^2 in all.
    struct Divisor {
        explicit Divisor(const DoubleDouble& y_) : y(two_sum(y_.high, y_.low)), inverse(1 / y.high) {}
        double operator()(const DoubleDouble& x_) const {
            const DoubleDouble x = two_sum(x_.high, x_.low);
            const double q = x.high * inverse;
            const DoubleDouble product = two_product(q, y.high);
            return q + (((x.high - product.high) - product.low) + (x.low - q * y.low)) * inverse;
        }
        DoubleDouble y;
        double inverse;
    };
};

}  // namespace pierce::detail
