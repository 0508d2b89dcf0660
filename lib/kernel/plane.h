// A triangle that is hit, in double or in twice that precision, one formula for both: its normal, the side of its plane that a point is on,
// and where a path meets it, each with a bound for its error.
//
// Moller and Trumbore's determinants (1997), but with the normal first, which all of them share. Relative to corner a: edges p = b - a and
// q = c - a, n = p x q; for a path o = a - from, d = to - from, r = o x d. From o = t d - weight_b p - weight_c q by Cramer's rule:
//   s = d . n,  v = o . n,  w_b = r . q,  w_c = -r . p,  w_a = s - w_b - w_c;  fraction v / s, weights w / s.
// (The filter's volumes have the path's start as their origin, so that no edge's sign depends on the triangle that has it; for values
// that is no matter, and errors here grow with the distance o once only, which for a long path makes all the difference.)
//
// The bounds. Let u be the number's unit (double_double.h): differences, products and sums are within u of their magnitudes. M: the
// largest |component| of p and q, O: of o, D: of d, as computed.
//   products of two in n within 3u M^2, n_k within 2 * 3u M^2 + u 2M^2 = 8u M^2 and at most 2 M^2; r_k in the same way: 8u O D, 2 O D
//   v: a term within O 8u M^2 + u O 2M^2 + u O 2M^2 = 12u M^2 O, three and two sums (4 + 6)u: 46u M^2 O < 48u M^2 O = e_v
//   s: 48u M^2 D = e_s     w_b, w_c: 48u O D M = e     w_a: 48u M^2 D + 2 * 48u O D M + u (6 M^2 D + 6 O D M) + u (6 M^2 D + 12 O D M)
//     = u M D (60 M + 114 O) < u M D (64 M + 120 O) = e_a
// Here 2 of 48 and more of the others is left for terms of second order, for the roundings of the bounds themselves, and for components
// of a DoubleDouble, which are larger than its high part by 2^-53 at most. Underflow, for M, O, D in [2^-300, 2^300]: a product loses at most
// 2^-1071, n_k 2^-1070, which is 2^-370 of u M^2 even for u = 2^-100, and a product of three 2^-1071 of 2^-1000: nothing in 48u. The
// largest number is below 2^904, and the splitting's 2^931.
#pragma once

#include <cmath>
#include <type_traits>

#include <kernel/triple.h>

namespace pierce::detail {

template <class Number>
class Plane {
  public:
    static constexpr double unit = Arithmetic<Number>::unit;

    explicit Plane(const Corners& corners)
        : a(corners[0]), p(difference<Number>(corners[1], a)), q(difference<Number>(corners[2], a)), n(cross(p, q)),
          normal(rounded(n)), size(std::max(largest(p), largest(q))), tame(is_tame(size)) {}

    /// Each component of `normal` is certainly within `tolerance` of the largest (but for the one rounding of a DoubleDouble), and
    /// squares of the largest neither overflow nor underflow.
    [[nodiscard]] bool has_normal(double tolerance) const {
        const double most = largest(normal);
        return tame && 8 * unit * (size * size) <= tolerance * most && most >= 0x1p-500 && most <= 0x1p500;
    }
    /// The triangle's area is certainly not zero.
    [[nodiscard]] bool has_area() const { return tame && largest(normal) > 8 * unit * (size * size); }

    /// The side that a point is on, +1 in front, -1 behind, 0 on the plane, if that is certain; else `doubtful`.
    static constexpr int doubtful = 2;
    [[nodiscard]] int side(const Point& point) const {
        // In double first, from the rounded normal: for DoubleDouble that is within 2^-52 M^2, less than the 8u M^2 of a double's.
        const Triple<double> o = difference<double>(point, a);
        const double reach = largest(o);
        const double volume = tame && is_tame(reach) ? 48 * (size * size) * reach : HUGE_VAL;
        const double near = dot(o, normal);
        if (std::abs(near) > Arithmetic<double>::unit * volume) return near > 0 ? 1 : -1;
        // On a plane along two axes, say, each term is 0, for certain: a computed difference is 0 only if the exact one is.
        const auto none = [](const Number& x, const Number& y) { return is_zero(x) || is_zero(y); };
        if ((o.x == 0 || (none(p.y, q.z) && none(p.z, q.y))) && (o.y == 0 || (none(p.z, q.x) && none(p.x, q.z))) &&
            (o.z == 0 || (none(p.x, q.y) && none(p.y, q.x))))
            return 0;
        if constexpr (!std::is_same_v<Number, double>) {
            const double exact = Arithmetic<Number>::rounded(dot(difference<Number>(point, a), n));
            if (std::abs(exact) > unit * volume) return exact > 0 ? 1 : -1;
        }
        return doubtful;
    }

    const Point& a;
    const Triple<Number> p, q, n;
    const Triple<double> normal;  ///< n, rounded
    const double size;  ///< M
    const bool tame;

  private:
    static bool is_zero(double x) { return x == 0; }
    static bool is_zero(const DoubleDouble& x) { return x.high == 0; }
};

/// Where the line of a path meets the triangle's plane: numerators, what they are to be divided by, and bounds for their errors.
template <class Number>
struct Meeting {
    Meeting(const Plane<Number>& plane, const Path& path) {
        const Triple<Number> o = difference<Number>(plane.a, path.from);
        const Triple<Number> d = difference<Number>(path.to, path.from);
        const Triple<Number> r = cross(o, d);
        s = dot(d, plane.n);
        v = dot(o, plane.n);
        const Number b = dot(r, plane.q);
        const Number c = -dot(r, plane.p);
        w = {s - b - c, b, c};

        const double u = Arithmetic<Number>::unit;
        const double size = plane.size;
        const double start = largest(o);
        const double reach = largest(d);
        tame = plane.tame && is_tame(start) && is_tame(reach);
        ev = 48 * u * (size * size * start);
        es = 48 * u * (size * size * reach);
        ea = u * (size * reach) * (64 * size + 120 * start);
    }

    /// For a hit: whether v / s is certainly within `tolerance` of the true fraction in parts of it, and each w / s within `tolerance` of
    /// the true weight. The first is off by at most (v e_s + s e_v) / (s (s - e_s)), in parts of itself (e_s + e_v s / v) / (s - e_s); a
    /// true weight being at most 1, the second by (e_a + e_s) / s, e_a being the largest of the three.
    [[nodiscard]] bool within(double tolerance) const {
        const double quarter = tolerance / 4;
        const double divisor = quarter * std::abs(Arithmetic<Number>::rounded(s));
        return tame && ev <= quarter * std::abs(Arithmetic<Number>::rounded(v)) && es <= divisor && ea <= divisor;
    }

    Number v, s;
    Triple<Number> w;   ///< of a, b, c
    double ev, es, ea;  ///< of the error of v, of that of s, and of those of w
    bool tame;          ///< the bounds hold
};

}  // namespace pierce::detail
