// The values of a hit from the volumes of its meeting, in double or in twice that precision, each with a bound for its
// error.
//
// With meeting.h's bounds e_s = 9u S, e_v = 9u V, and e_w = 12u (S + B + C) for any weight, e_s <= 2^-10 |s|, and u the
// number's unit:
//   fraction  |v~ / s~ - v / s| <= (e_v + t e_s) / (|s~| - e_s) and the quotient's own 2u t: below 1.01 (e_v + t e_s) /
//   |s| + 2u t
//   weights   b, c in the same way; a = 1 - b - c: what b and c are off, 9u (B + C + (b + c) S) / |s| and 2u (b + c), and two sums, 2u each: all are
//             below 1.01 (e_w + e_s) / |s| + 8u
//   normal    a component is off by 5u N_k, and by 2^-53 of itself where it was rounded from a double-double.
// A quotient of double-doubles keeps its bound where nothing underflows: where it is 0 or at least 2^-200, so that it
// times s is a multiple of 2^-1008.
//
// The true point is P = from + t d = a + b p + c q, each coordinate by the formula whose terms vary less: so floors
// along two axes and paths along one
// come out exact, and errors are those of the mesh's coordinates where the segment's end is far away. Its error:
//   along the path    |d| e_t + u |d| (the product) + u (|from| + |d|) (the sum) + u (|from| + |d|) (d itself)
//   in the triangle   (|p| + |q|) e_w + u (|p| + |q|) + 2u (|a| + |p| + |q|) + u (|a| + |p| + |q|)
// in both cases below reach e + 5u (|base| + reach), reach being |d| or |p| + |q|; where that is 0 there is nothing to
// be off. It is taken twice, for terms
// of second order and the roundings here.
#pragma once

#include <kernel/meeting.h>
#include <kernel/refine_function.h>
#include <kernel/spot.h>

namespace pierce::detail {

struct Values {
    double fraction;
    double barycentric[3];
    double fraction_error;  ///< before it was rounded to double
    double weight_error;    ///< of each
    double length;          ///< |normal|
    double normal_error;    ///< of the normal as a vector, but for its rounding
    Spot spot;              ///< and the normal
    bool good;              ///< the bounds hold, for all but the normal
};

/// One lane of a pair.
[[nodiscard]] [[gnu::always_inline]] inline double lane(Pair x, int i) { return x[i]; }
template <class Product>
[[nodiscard]] [[gnu::always_inline]] inline BasicDoubleDouble<double, Product> lane(
    const BasicDoubleDouble<Pair, Product>& x, int i) {
    return {x.high[i], x.low[i]};
}
[[nodiscard]] [[gnu::always_inline]] inline double low_part(double) { return 0; }
template <class Product>
[[nodiscard]] [[gnu::always_inline]] inline double low_part(const BasicDoubleDouble<double, Product>& x) {
    return x.low;
}
[[nodiscard]] [[gnu::always_inline]] inline double high_part(double x) { return x; }
template <class Product>
[[nodiscard]] [[gnu::always_inline]] inline double high_part(const BasicDoubleDouble<double, Product>& x) {
    return x.high;
}

[[nodiscard]] [[gnu::always_inline]] inline double clamped(double x) { return x < 0 ? 0 : x > 1 ? 1 : x; }

/// Two at once, as a point is copied soon after: that would wait for numbers written one by one. (Of a Point no
/// function is used: what std::array has is
/// not of one file alone.)
[[gnu::always_inline]] inline void store(const double (&x)[3], Point* to) {
    const Pair first = {x[0], x[1]};
    __builtin_memcpy(to, &first, sizeof first);
    __builtin_memcpy(reinterpret_cast<char*>(to) + sizeof first, &x[2], sizeof x[2]);
}

[[nodiscard]] [[gnu::always_inline]] inline bool not_lost(double x) { return x == 0 || magnitude_of(x) >= 0x1p-200; }

/// `bars` are those of `x`.
template <class Number>
[[gnu::always_inline]] inline void evaluate(const Measured& bars, const Meeting<Number>& x, Values& values) {
    using A = Arithmetic<Number>;
    using Single = typename A::Single;
    using S = Arithmetic<Single>;
    constexpr double u = A::unit;

    // (1 | b) and (t | -c)
    const Number s2 = A::tidy(x.sb);
    const Pair s_high = A::rounded(s2);
    const Pair inverse = both(1.0 / s_high[0]);
    const Single s = lane(s2, 0);
    const Number divisor = A::all(s);
    const Number of_b = A::quotient(s2, divisor, inverse);
    const Number of_tc = A::quotient(A::tidy(x.vc), divisor, inverse);
    const Single t = lane(of_tc, 0);
    const Single b = lane(of_b, 1);
    const Single c = -lane(of_tc, 1);
    const Single a = S::number(1) - b - c;

    const double size = magnitude_of(s_high[0]);
    const double over = 1.01 * magnitude_of(inverse[0]);
    const double es = 9 * u * bars.bar_sb[0];
    const double ev = 9 * u * bars.bar_vc[0];
    const double ew = 12 * u * (bars.bar_sb[0] + bars.bar_sb[1] + bars.bar_vc[1]);
    values.fraction = clamped(S::rounded(t));
    values.barycentric[0] = clamped(S::rounded(a));
    values.barycentric[1] = clamped(S::rounded(b));
    values.barycentric[2] = clamped(S::rounded(c));
    values.fraction_error = over * (ev + values.fraction * es) + 2 * u * values.fraction;
    const double of_weights = over * (ew + es) + 8 * u;
    values.weight_error = of_weights;
    values.good =
        bars.tame && es < size * 0x1p-10 && not_lost(high_part(t)) && not_lost(high_part(b)) && not_lost(high_part(c));

    const double n[3] = {A::rounded(x.nr.x)[0], A::rounded(x.nr.y)[0], A::rounded(x.nr.z)[0]};
    const double bar_n[3] = {bars.bar_nr.x[0], bars.bar_nr.y[0], bars.bar_nr.z[0]};
    values.length = __builtin_sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    values.normal_error = 5 * u * (bar_n[0] + bar_n[1] + bar_n[2]);

    Spot& spot = values.spot;
    spot.length = values.length;
    const double far = magnitude_of(A::rounded(x.vc)[0]) - ev;
    spot.distance = far > 0 ? far : 0;
    const Number* const po = &x.po.x;
    const Number* const qd = &x.qd.x;
    const Pair* const af = &bars.lines.af.x;
    double high[3], low[3], error[3], normal[3], normal_error[3];
    const double et = values.fraction_error;
    for (int k = 0; k < 3; ++k) {
        const Single p = lane(po[k], 0);
        const Single q = lane(qd[k], 0);
        const Single d = lane(qd[k], 1);
        const double along = magnitude_of(high_part(d));
        const double across = magnitude_of(high_part(p)) + magnitude_of(high_part(q));
        const bool on_path = along < across;
        const double base = af[k][on_path ? 1 : 0];
        const double reach = on_path ? along : across;
        const Single first = S::number(base) + (on_path ? t : b) * (on_path ? d : p);
        const Single sum = on_path ? first : first + c * q;
        const Single tidy = S::tidy(sum);
        high[k] = high_part(tidy);
        low[k] = low_part(tidy);
        error[k] = reach == 0 ? 0 : 2 * (reach * (on_path ? et : of_weights) + 5 * u * (magnitude_of(base) + reach));
        normal[k] = n[k];
        normal_error[k] = bar_n[k] == 0 ? 0 : 5 * u * bar_n[k] + (u < 0x1p-60 ? 0x1p-52 * magnitude_of(n[k]) : 0);
    }
    store(high, &spot.high);
    store(low, &spot.low);
    store(error, &spot.error);
    store(normal, &spot.normal);
    store(normal_error, &spot.normal_error);
}

/// Values in twice the precision.
template <class Product>
[[gnu::always_inline]] inline void refine_with(const Measured& bars, Values& values) {
    Meeting<BasicDoubleDouble<Pair, Product>> finer;
    meet(bars.lines, finer);
    evaluate(bars, finer, values);
}

}  // namespace pierce::detail
