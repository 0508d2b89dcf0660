// Bailey's test: Cramer's rule with four determinants, each computed by itself.
//
// Source: Bailey 2023, "An Efficient Ray-Triangle Intersection Algorithm" (slides, Oregon State University). From
// S + t Q = P0 + u (P1-P0) + v (P2-P0) follow three equations A t + B u + C v = D with the columns A = -Q, B = P1 - P0,
// C = P2 - P0, D = S - P0, and
//   t = |D B C| / |A B C|     u = |A D C| / |A B C|     v = |A B D| / |A B C|
// |A B C| = -Q . n is positive for a segment that comes from the front. The slides call it Moller and Trumbore's, which
// has the same quotients but shares the cross products: 27 multiplications there, 36 here.
//
// Departures: a segment, t < 1; signs are judged on determinants and the division comes last; |A B C| = 0 is judged
// exactly as computed.
#pragma once

#include <pierce/kernels/concept.h>

namespace pierce::kernels {

/// Of either side, by `sides`. Errs as `MollerTrumbore` does, but two equal corners give a determinant of exactly 0,
/// and are never hit.
struct Cramer {
    Sides sides = Sides::front;  ///< the side that a segment must come from

    /// What is stored: the corners.
    template <class Number>
    using Stored = Vertices<Number>;

    /// The stored form of a triangle.
    template <class Scalar>
    [[nodiscard]] Vertices<Scalar> prepare(const Vec3<Scalar>& a, const PointOf<Scalar>& b,
                                           const PointOf<Scalar>& c) const {
        return {triple<Scalar>(a), triple<Scalar>(b), triple<Scalar>(c)};
    }

    /// The test in any type of number: for one segment, or for several in step.
    template <class Number>
    [[nodiscard]] Tested<Number> evaluate(const Vertices<Number>& triangle, const Triple<Number>& from,
                                          const Triple<Number>& to) const {
        const Triple<Number> a = from - to;
        const Triple<Number> b = triangle.b - triangle.a;
        const Triple<Number> c = triangle.c - triangle.a;
        const Triple<Number> d = from - triangle.a;
        const Number facing = of_columns(a, b, c);
        const Turning<Number> turn(facing, sides);
        const Number whole = turn(facing);
        Mask<Number> hit = whole > Number{};
        if (none(hit)) return {hit};
        const Number t = turn(of_columns(d, b, c));
        hit = hit & turn.passes(t, whole);
        if (none(hit)) return {hit};
        const Number u = turn(of_columns(a, d, c));
        hit = hit & (u >= Number{}) & (u <= whole);
        if (none(hit)) return {hit};
        const Number v = turn(of_columns(a, b, d));
        hit = hit & (v >= Number{}) & ((whole - u) - v >= Number{});
        if (none(hit)) return {hit};
        return divided(hit, t, u, v, whole);
    }

    /// Whether and where the segment from -> to hits the triangle.
    template <class Scalar>
    [[nodiscard]] std::optional<Answer<Scalar>> test(const Vertices<Scalar>& stored, const PointOf<Scalar>& from,
                                                     const PointOf<Scalar>& to) const {
        return answer(evaluate(stored, triple<Scalar>(from), triple<Scalar>(to)));
    }

  private:
    // By the first row.
    template <class Number>
    static Number of_columns(const Triple<Number>& p, const Triple<Number>& q, const Triple<Number>& r) {
        return p[0] * (q[1] * r[2] - q[2] * r[1]) - q[0] * (p[1] * r[2] - p[2] * r[1]) +
               r[0] * (p[1] * q[2] - p[2] * q[1]);
    }
};

/// `Cramer` with its defaults.
inline constexpr Cramer cramer{};

}  // namespace pierce::kernels
