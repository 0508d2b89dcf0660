// Numbers of twice a double's precision: the unevaluated sum of two doubles, without a branch and the same on every
// machine.
//
// As in Lange and Rump 2020, "Faithfully rounded floating-point computations" (CPair): the high parts are those of
// plain arithmetic, the low part is what they lost, itself computed in plain arithmetic, and the two are not made to
// fit again after each operation. So a sum takes 8 operations, not 20 as in Joldes, Muller and Popescu 2017
// (algorithm 6), and what is lost is bounded by the magnitudes of the operands, not by the result's: which is what the
// bounds of this library are made of. (Measured for the values of a hit: README.md, "What exactness costs".)
//
// The errors, in round to nearest (environment.h), with v = 2^-53. Let |x| be at most A, its low part at most j v A,
// and y, B, k alike.
//   sum        high + e = x.high + y.high exactly (TwoSum, Knuth), |e| <= v (A + B);
//              low = e + (x.low + y.low) with two roundings:
//              v max(j, k) v (A + B) + v (1 + max(j, k)) v (A + B) = (2 max(j, k) + 1) v^2 (A + B);
//              its low part: (max(j, k) + 1) v (A + B)
//   product    high + e = x.high y.high exactly (Dekker 1971), |e| <= v AB;
//              low = e + (x.high y.low + x.low y.high): two products and a sum, 2 (j + k) v^2;
//              the last sum, (1 + j + k) v^2; x.low y.low left out, j k v^2: in all (1 + 3 (j + k) + j k) v^2 AB;
//              its low part: (1 + j + k) v AB
//   difference of two doubles: exact; j = 1.
// (Each times 1 + 2^-48 for what is of higher order.) In the deepest formulas here, meeting.h's volumes, the j of
// operands are
//   differences 1, products of two 3, cross products 4, products with a difference 6, sums of three 8, then 9:
//   products 8 v^2 and 20 v^2, sums 7, 13, 15, 17 and 19 v^2: each operation is within 32 v^2 = 2^-100 of its
//   magnitude, with room.
// Underflow: each of Dekker's five products and of the two others loses at most 2^-1074 more: 2^-1071 in all; sums lose
// nothing. Overflow: splitting multiplies by 2^27 + 1: all is finite for operands below 2^990 whose product is below
// 2^1020.
//
// What a product lost can be had by a fused operation as well: both are exact, and so the same bits, where the
// product's last digit is not below 2^-1074: that is, where the factors are whole multiples of powers of two whose
// product is not. (Dekker: each half of a factor is a multiple of that power too, the partial products fit 53 bits, and
// each sum is exact.) meeting.h says where the numbers here are. So machines that have fused operations use them
// (narrow_fused.cpp) and answer the same.
#pragma once

#include <kernel/pair.h>

namespace pierce::detail {

/// What a product of two doubles lost, `product` being x y rounded: by halves of 26 bits (Veltkamp, Dekker).
struct Dekker {
    template <class Lane>
    [[gnu::always_inline]] static Lane lost(Lane x, Lane y, Lane product) {
        const Lane of_x = high_half(x);
        const Lane of_y = high_half(y);
        const Lane rest_x = x - of_x;
        const Lane rest_y = y - of_y;
        return ((of_x * of_y - product) + of_x * rest_y + rest_x * of_y) + rest_x * rest_y;
    }

  private:
    template <class Lane>
    [[gnu::always_inline]] static Lane high_half(Lane x) {
        const Lane large = 0x8000001p0 * x;
        return large - (large - x);
    }
};

/// `Lane`: double, or a Pair of them. `Product` says what products lose.
template <class Lane, class Product>
struct BasicDoubleDouble {
    Lane high;
    Lane low;
};
using DoubleDouble = BasicDoubleDouble<double, Dekker>;

/// x + y exactly, for any doubles whose sum is finite.
template <class Product = Dekker, class Lane>
[[nodiscard]] [[gnu::always_inline]] inline BasicDoubleDouble<Lane, Product> two_sum(Lane x, Lane y) {
    const Lane sum = x + y;
    const Lane of_y = sum - x;
    return {sum, (x - (sum - of_y)) + (y - of_y)};
}

/// x y exactly, but for underflow.
template <class Product = Dekker, class Lane>
[[nodiscard]] [[gnu::always_inline]] inline BasicDoubleDouble<Lane, Product> two_product(Lane x, Lane y) {
    const Lane product = x * y;
    return {product, Product::lost(x, y, product)};
}

template <class Lane, class Product>
[[nodiscard]] [[gnu::always_inline]] inline BasicDoubleDouble<Lane, Product> operator-(
    const BasicDoubleDouble<Lane, Product>& x) {
    return {-x.high, -x.low};
}
template <class Lane, class Product>
[[nodiscard]] [[gnu::always_inline]] inline BasicDoubleDouble<Lane, Product> operator+(
    const BasicDoubleDouble<Lane, Product>& x, const BasicDoubleDouble<Lane, Product>& y) {
    const auto sum = two_sum<Product>(x.high, y.high);
    return {sum.high, sum.low + (x.low + y.low)};
}
template <class Lane, class Product>
[[nodiscard]] [[gnu::always_inline]] inline BasicDoubleDouble<Lane, Product> operator-(
    const BasicDoubleDouble<Lane, Product>& x, const BasicDoubleDouble<Lane, Product>& y) {
    return x + -y;
}
template <class Lane, class Product>
[[nodiscard]] [[gnu::always_inline]] inline BasicDoubleDouble<Lane, Product> operator*(
    const BasicDoubleDouble<Lane, Product>& x, const BasicDoubleDouble<Lane, Product>& y) {
    const auto product = two_product<Product>(x.high, y.high);
    return {product.high, product.low + (x.high * y.low + x.low * y.high)};
}

/// What a formula that is written once needs to know of its numbers: doubles or double-doubles, single or in pairs.
/// `unit`: each operation is within this much of the magnitudes of what goes in; `difference`, of two doubles, too.
template <class Number>
struct Arithmetic {
    using Lane = Number;                     ///< what it is made of: double or Pair
    using Single = double;                   ///< one of a pair
    static constexpr double unit = 0x1p-52;  // any rounding mode
    [[gnu::always_inline]] static Lane difference(Lane x, Lane y) { return x - y; }
    [[gnu::always_inline]] static Lane rounded(Number x) { return x; }
    [[gnu::always_inline]] static Number number(Lane x) { return x; }
    [[gnu::always_inline]] static Number all(double x) { return x - Number{}; }
    /// Within 2 units of itself.
    [[gnu::always_inline]] static Number quotient(Number x, Number, Lane inverse) { return x * inverse; }
    [[gnu::always_inline]] static Number tidy(Number x) { return x; }
};

template <class Lane_, class Product>
struct Arithmetic<BasicDoubleDouble<Lane_, Product>> {
    using Lane = Lane_;
    using Number = BasicDoubleDouble<Lane, Product>;
    using Single = BasicDoubleDouble<double, Product>;
    static constexpr double unit = 0x1p-100;
    [[gnu::always_inline]] static Number difference(Lane x, Lane y) { return two_sum<Product>(x, -y); }
    [[gnu::always_inline]] static Lane rounded(const Number& x) { return x.high + x.low; }
    [[gnu::always_inline]] static Number number(Lane x) { return {x, Lane{}}; }
    [[gnu::always_inline]] static Number all(const Single& x) { return {x.high - Lane{}, x.low - Lane{}}; }
    /// The same number with a low part within v of the high one.
    [[gnu::always_inline]] static Number tidy(const Number& x) { return two_sum<Product>(x.high, x.low); }

    /// x / y, x and y being tidy and `inverse` 1 / y.high rounded: within 2^-100 of itself, if nothing underflows.
    /// q = x.high * inverse is within 4v of x / y, and what is missing is (x - q y) / y, |x - q y| <= 4v |x|:
    /// x.high - product.high is exact (the two are within a few units of each other), the sums lose 5, 2 and 7 v^2 |x|,
    /// q y.low 1 v^2 |x|, and the inverse of y.high in place of that of y 3v of 5v |q|, the last product 5 v^2: 35 v^2
    /// in all, with the tidying 36 (not quite 2^-100, but less than two of these units, which is what is counted).
    [[gnu::always_inline]] static Number quotient(const Number& x, const Number& y, Lane inverse) {
        const Lane q = x.high * inverse;
        const auto product = two_product<Product>(q, y.high);
        return {q, (((x.high - product.high) - product.low) + (x.low - q * y.low)) * inverse};
    }
};

}  // namespace pierce::detail
