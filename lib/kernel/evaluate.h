// The values of a hit from the volumes of its meeting, in double or in twice that precision, each with a bound for its
// error.
//
// With meeting.h's bounds e_s = 9u S, e_v = 9u V, and e_w = 12u (S + B + C) for any weight, e_s <= 2^-10 |s|, and u the
// number's unit:
//   fraction  |v~ / s~ - v / s| <= (e_v + t e_s) / (|s~| - e_s) and the quotient's own 2u t:
//             below 1.01 (e_v + t e_s) / |s| + 2u t
//   weights   b, c in the same way; a = 1 - b - c: what b and c are off, 9u (B + C + (b + c) S) / |s| and 2u (b + c),
//             and two sums, 2u each: all are below 1.01 (e_w + e_s) / |s| + 8u
//   normal    a component is off by 5u N_k, and by 2^-53 of itself where it was rounded from a double-double.
// A quotient of double-doubles keeps its bound where nothing underflows: where it is 0 or at least 2^-200, so that it
// times s is a multiple of 2^-1008.
//
// The true point is P = from + t d = a + b p + c q, each coordinate by the formula whose terms vary less: so floors
// along two axes and paths along one come out exact, and errors are those of the mesh's coordinates where the segment's
// end is far away. Its error:
//   along the path    |d| e_t + u |d| (the product) + u (|from| + |d|) (the sum) + u (|from| + |d|) (d itself)
//   in the triangle   (|p| + |q|) e_w + u (|p| + |q|) + 2u (|a| + |p| + |q|) + u (|a| + |p| + |q|)
// in both cases below reach e + 5u (|base| + reach), reach being |d| or |p| + |q|; where that is 0 there is nothing to
// be off. It is taken twice, for terms of second order and the roundings here.
//
// Rounded to Scalar, the true point is certain where both ends of the interval around it round to one number, as
// rounding is monotone. The interval is widened by what its own sums lose.
#pragma once

#include <type_traits>

#include <kernel/four.h>
#include <kernel/meeting.h>
#include <kernel/values.h>

namespace pierce::detail {

/// One lane of a pair.
[[nodiscard]] [[gnu::always_inline]] inline double lane(Pair x, int i) { return x[i]; }
template <class Product>
[[nodiscard]] [[gnu::always_inline]] inline BasicDoubleDouble<double, Product> lane(
    const BasicDoubleDouble<Pair, Product>& x, int i) {
    return {x.high[i], x.low[i]};
}

/// The same lanes of three pairs, as vectors.
template <class Four>
[[nodiscard]] [[gnu::always_inline]] inline Four first_lanes(const Triple<Pair>& x) {
    return Four::first_lanes(x);
}
template <class Four>
[[nodiscard]] [[gnu::always_inline]] inline Four second_lanes(const Triple<Pair>& x) {
    return Four::second_lanes(x);
}
template <class Four, class Product>
[[nodiscard]] [[gnu::always_inline]] inline FineFour<Four> first_lanes(
    const Triple<BasicDoubleDouble<Pair, Product>>& x) {
    return {Four::first_lanes({x.x.high, x.y.high, x.z.high}), Four::first_lanes({x.x.low, x.y.low, x.z.low})};
}
template <class Four, class Product>
[[nodiscard]] [[gnu::always_inline]] inline FineFour<Four> second_lanes(
    const Triple<BasicDoubleDouble<Pair, Product>>& x) {
    return {Four::second_lanes({x.x.high, x.y.high, x.z.high}), Four::second_lanes({x.x.low, x.y.low, x.z.low})};
}

/// One number in all lanes.
template <class Four>
[[nodiscard]] [[gnu::always_inline]] inline Four in_all_lanes(double x) {
    return Four::all(x);
}
template <class Four, class Product>
[[nodiscard]] [[gnu::always_inline]] inline FineFour<Four> in_all_lanes(const BasicDoubleDouble<double, Product>& x) {
    return {Four::all(x.high), Four::all(x.low)};
}

template <class Four>
[[nodiscard]] [[gnu::always_inline]] inline Four select(Four mask, Four yes, Four no) {
    return Four::select(mask, yes, no);
}
template <class Four>
[[nodiscard]] [[gnu::always_inline]] inline FineFour<Four> select(Four mask, const FineFour<Four>& yes,
                                                                  const FineFour<Four>& no) {
    return {Four::select(mask, yes.high, no.high), Four::select(mask, yes.low, no.low)};
}
template <class Four>
[[nodiscard]] [[gnu::always_inline]] inline Four high_part(Four x) {
    return x;
}
template <class Lane, class Product>
[[nodiscard]] [[gnu::always_inline]] inline Lane high_part(const BasicDoubleDouble<Lane, Product>& x) {
    return x.high;
}
template <class Four>
[[nodiscard]] [[gnu::always_inline]] inline Four low_part(Four) {
    return Four::all(0);
}
template <class Lane, class Product>
[[nodiscard]] [[gnu::always_inline]] inline Lane low_part(const BasicDoubleDouble<Lane, Product>& x) {
    return x.low;
}

/// Sets `position`, and says whether it is the true point rounded correctly.
template <class Scalar, class Four>
[[nodiscard]] [[gnu::always_inline]] inline bool round_position(Four high, Four low, Four error, Values& values) {
    Four slack = Four::all(1 + 0x1p-20) * error + Four::all(0x1p-50) * magnitudes(low) + Four::all(0x1p-1073);
    // For the sum, rounded to double before it is to float.
    if (sizeof(Scalar) == 4) slack = slack + Four::all(0x1p-51) * magnitudes(high);
    const Four zero = Four::all(0);
    slack = slack & (Four::less(zero, error) | (Four::less(low, zero) | Four::less(zero, low)));
    const Four least = Four::template rounded<Scalar>(high + (low - slack));
    const Four most = Four::template rounded<Scalar>(high + (low + slack));
    (least + zero).store(values.position);  // not -0
    return (Four::signs(Four::equal(least, most)) & 7U) == 7U;
}

/// All values of a hit but `point` and `tried`. `bars` are those of `x`; `unit`: of the search for a place.
template <class Scalar, class Four, class Number>
[[gnu::always_inline]] inline void evaluate(const Measured& bars, const Meeting<Number>& x, double unit,
                                            Values& values) {
    using A = Arithmetic<Number>;
    using Single = typename A::Single;
    using S = Arithmetic<Single>;
    constexpr double u = A::unit;
    constexpr double k_unknown = __builtin_huge_val();

    // (1 | b) and (t | -c)
    const Number s2 = A::tidy(x.sb);
    const Pair s_high = A::rounded(s2);
    const Pair inverse = both(1.0 / s_high[0]);
    const Number divisor = A::all(lane(s2, 0));
    const Number of_b = A::quotient(s2, divisor, inverse);
    const Number of_tc = A::quotient(A::tidy(x.vc), divisor, inverse);
    const Single t = lane(of_tc, 0);
    const Single b = lane(of_b, 1);
    const Single c = -lane(of_tc, 1);
    const Single a = S::number(1) - b - c;

    // NaN stays, and fails every comparison.
    Four weights = Four::of(Pair{S::rounded(a), S::rounded(b)}, Pair{S::rounded(c), S::rounded(t)});
    weights = Four::select(Four::less(weights, Four::all(0)), Four::all(0), weights);
    weights = Four::select(Four::less(Four::all(1), weights), Four::all(1), weights);
    weights.store(values.weights);

    const double size = magnitude_of(s_high[0]);
    const double over = 1.01 * magnitude_of(inverse[0]);
    const double es = 9 * u * bars.bar_sb[0];
    const double ev = 9 * u * bars.bar_vc[0];
    const double ew = 12 * u * (bars.bar_sb[0] + bars.bar_sb[1] + bars.bar_vc[1]);
    const double fraction = Four::lane(weights, 3);
    const double of_fraction = over * (ev + fraction * es) + 2 * u * fraction;
    const double of_weights = over * (ew + es) + 8 * u;
    // Fraction, b and c are 0 or not so small that something underflowed.
    const Four parts = Four::of(Pair{high_part(b), high_part(b)}, Pair{high_part(c), high_part(t)});
    const Four kept = Four::at_most(Four::all(0x1p-200), magnitudes(parts)) | Four::equal(parts, Four::all(0));
    const bool good = bars.tame && es < size * 0x1p-10 && Four::signs(kept) == 0xfU;
    values.fraction_error = good ? of_fraction : k_unknown;
    values.weight_error = good ? of_weights : k_unknown;

    const Four n = first_lanes<Four>(Triple<Pair>{A::rounded(x.nr.x), A::rounded(x.nr.y), A::rounded(x.nr.z)});
    const Four bar_n = first_lanes<Four>(bars.bar_nr);
    // Where the bar is 0 so is n.
    Four normal_errors = Four::all(5 * u) * bar_n;
    if constexpr (u < 0x1p-60) normal_errors = normal_errors + Four::all(0x1p-52) * magnitudes(n);
    const Four sums = Four::sums(n * n, bar_n, normal_errors, normal_errors);
    values.length = __builtin_sqrt(Four::lane(sums, 0));
    n.store(values.normal);
    normal_errors.store(values.normal_errors);
    values.normal_error = bars.tame ? 5 * u * Four::lane(sums, 1) : k_unknown;
    values.length_error = Four::lane(sums, 2);
    const double distance = magnitude_of(A::rounded(x.vc)[0]) - ev;
    values.distance = distance > 0 ? distance : 0;

    const auto p = first_lanes<Four>(x.po);
    using C = Arithmetic<std::remove_const_t<decltype(p)>>;
    const auto q = first_lanes<Four>(x.qd);
    const auto d = second_lanes<Four>(x.qd);
    const Four along = magnitudes(high_part(d));
    const Four across = magnitudes(high_part(p)) + magnitudes(high_part(q));
    const Four on_path = Four::less(along, across);
    const Four base = select(on_path, second_lanes<Four>(bars.lines.af), first_lanes<Four>(bars.lines.af));
    const Four reach = select(on_path, along, across);
    const auto share = select(on_path, in_all_lanes<Four>(t), in_all_lanes<Four>(b));
    const auto first = C::number(base) + share * select(on_path, d, p);
    const auto sum = C::tidy(select(on_path, first, first + in_all_lanes<Four>(c) * q));
    const Four high = high_part(sum);
    const Four low = low_part(sum);
    const Four e = select(on_path, Four::all(of_fraction), Four::all(of_weights));
    const Four twice = Four::all(2) * (reach * e + Four::all(5 * u) * (magnitudes(base) + reach));
    const Four error = twice & Four::less(Four::all(0), reach);
    high.store(values.high);
    low.store(values.low);
    error.store(values.error);
    const bool near = (Four::signs(Four::at_most(error, Four::all(unit / 16))) & 7U) == 7U;
    values.located = good && near;
    values.rounded = round_position<Scalar>(high, low, error, values) && good;
}

}  // namespace pierce::detail
