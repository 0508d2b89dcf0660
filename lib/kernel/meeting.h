// Where the line of a path meets a triangle's plane, in double or in twice that precision: one formula and one
// derivation for both, and one set of volumes for the filter's decision and for all values of a hit.
//
// Moller and Trumbore's determinants (1997), relative to corner a. Edges p = b - a and q = c - a, start o = a - from,
// direction d = to - from, of a ray what it is given, n = p x q, r = o x d. From o = t d - weight_b p - weight_c q by
// Cramer's rule:
//   s = d . n,  v = o . n,  w_b = r . q,  w_c = -r . p,  w_a = s - w_b - w_c;  fraction v / s, weights w / s
//   the start's side is that of -v, the end's that of s - v.
// They come in pairs: n and r are (p | o) x (q | d), s and w_b are (d | q) . (n | r), v and -w_c are (o | p) . (n | r).
//
// The bounds are in parts of the "bars": the same sums of products, of magnitudes and with all signs made +: N, R for n
// and r, S, V, B, C for s, v, w_b, w_c. With u the number's unit (double_double.h: differences, products and sums are
// within u of their magnitudes), in first order:
//   differences u, products of two 3u, n and r 4u of N and R, products with another difference 6u,
//   sums of three 8u of S, V, B, C.
// 9u in place of 8u is enough for terms of second order, the roundings of the bars themselves, and the low parts of
// double-doubles:
//   |err| <= 9u bar for s, v, w_b, w_c     |err n_k| <= 5u N_k
//   v - s: 10u (S + V)                     w_a: 9u and two sums: 12u (S + B + C).
// And a bar of 0 says that each product is exactly 0, and so is the value.
//
// `tame`: that holds. Each coordinate is 0 or in [2^-200, 2^200], so each is a multiple of 2^-252, and so are
// differences and their low parts (rounding keeps a number on a lattice coarser than itself); products of two are
// multiples of 2^-504 below 2^403, products of three of 2^-756 below 2^606: nothing underflows or overflows, and what a
// product of high parts lost is a double. That includes all floats. False for NaN.
#pragma once

#include <kernel/double_double.h>
#include <kernel/triple.h>

namespace pierce::detail {

template <class Number>
struct Meeting {
    Triple<Number> po, qd;  ///< (p | o) and (q | d)
    Triple<Number> nr;      ///< (n | r)
    Number sb;              ///< (s | w_b)
    Number vc;              ///< (v | -w_c)
};

/// What goes in: (b | a), (c | to), (a | from). `kept`: what of (a | from) is taken from (c | to), all bits of a lane
/// or none: of a ray `to` is the direction itself.
struct Lines {
    Triple<Pair> ba, ct, af;
    PairMask kept;
};

[[nodiscard]] [[gnu::always_inline]] inline PairMask kept_of(bool ray) { return PairMask{-1, ray ? 0 : -1}; }

[[nodiscard]] [[gnu::always_inline]] inline Pair swap_lanes(Pair x) { return swapped(x); }
template <class Product>
[[nodiscard]] [[gnu::always_inline]] inline BasicDoubleDouble<Pair, Product> swap_lanes(
    const BasicDoubleDouble<Pair, Product>& x) {
    return {swapped(x.high), swapped(x.low)};
}
template <class Number>
[[nodiscard]] [[gnu::always_inline]] inline Triple<Number> swapped(const Triple<Number>& x) {
    return {swap_lanes(x.x), swap_lanes(x.y), swap_lanes(x.z)};
}

template <class Number>
[[gnu::always_inline]] inline void meet(const Lines& lines, Meeting<Number>& m) {
    using A = Arithmetic<Number>;
    const Triple<Pair>& a = lines.af;
    const auto kept = [&lines](Pair x) __attribute__((always_inline)) {
        return reinterpret_cast<Pair>(reinterpret_cast<PairMask>(x) & lines.kept);
    };
    m.po = {A::difference(lines.ba.x, a.x), A::difference(lines.ba.y, a.y), A::difference(lines.ba.z, a.z)};
    m.qd = {A::difference(lines.ct.x, kept(a.x)), A::difference(lines.ct.y, kept(a.y)),
            A::difference(lines.ct.z, kept(a.z))};
    m.nr = cross(m.po, m.qd);
    m.sb = dot(swapped(m.qd), m.nr);
    m.vc = dot(swapped(m.po), m.nr);
}

/// Bars of a meeting, and all of it in double.
struct Measured {
    Lines lines;
    Meeting<Pair> meeting;
    Triple<Pair> bar_nr;
    Pair bar_sb;
    Pair bar_vc;
    bool tame;

    [[nodiscard]] [[gnu::always_inline]] double s() const { return meeting.sb[0]; }
    [[nodiscard]] [[gnu::always_inline]] double v() const { return meeting.vc[0]; }
    [[nodiscard]] [[gnu::always_inline]] double b() const { return meeting.sb[1]; }
    [[nodiscard]] [[gnu::always_inline]] double c() const { return -meeting.vc[1]; }
};

template <class Number>
[[nodiscard]] [[gnu::always_inline]] inline Triple<Number> magnitudes_of(const Triple<Number>& x) {
    return {magnitude_of(x.x), magnitude_of(x.y), magnitude_of(x.z)};
}

/// All bits of a lane are set where its number is not tame.
[[nodiscard]] [[gnu::always_inline]] inline PairMask untame(Pair x) {
    const Pair size = magnitude_of(x);
    return ((size < both(0x1p-200)) & (size != both(0))) | ~(size <= both(0x1p200));
}
[[nodiscard]] [[gnu::always_inline]] inline PairMask untame(const Triple<Pair>& x) {
    return untame(x.x) | untame(x.y) | untame(x.z);
}

/// `Scalar`: what the coordinates were; all floats are tame.
template <class Scalar>
[[gnu::always_inline]] inline void measure_lines(const Lines& lines, Measured& x) {
    x.lines = lines;
    meet(lines, x.meeting);
    const Triple<Pair> po = magnitudes_of(x.meeting.po);
    const Triple<Pair> qd = magnitudes_of(x.meeting.qd);
    x.bar_nr = cross_of_magnitudes(po, qd);
    x.bar_sb = dot(swapped(qd), x.bar_nr);
    x.bar_vc = dot(swapped(po), x.bar_nr);
    x.tame = true;
    if constexpr (sizeof(Scalar) == sizeof(double)) {
        const PairMask out = untame(lines.ba) | untame(lines.ct) | untame(lines.af);
        x.tame = (out[0] | out[1]) == 0;
    }
}

}  // namespace pierce::detail
