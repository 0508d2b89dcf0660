// Moller and Trumbore's test: nothing is computed beforehand.
//
// Source: Moller and Trumbore 1997, "Fast, Minimum Storage Ray-Triangle Intersection"; the division comes last, as in
// Bloom 2002, addendum. With d = to - from, E1 = b - a, E2 = c - a, s = from - a, the line from + t d = a + u E1 + v E2
// is solved by triple products over one determinant, which is minus d . n:
//   det = E1 . (d x E2)     u det = s . (d x E2)     v det = d . (s x E1)     t det = E2 . (s x E1)
//
// Departures: a segment, so t det < det as well as t det >= 0; no epsilon on the determinant, since nothing is divided
// by one that is 0.
#pragma once

#include <pierce/kernels/concept.h>

namespace pierce::kernels {

/// Of either side, by `sides`. Differences of coordinates come first, so that distance from the origin costs little.
/// But whether an end is in front of the plane is a triple product with the segment's own direction in it, not a
/// function of the point: the end of one step and the start of the next, which are the same point, may come out on
/// different sides. A triangle of area zero with b = c, or with corners on a slanted line, may have a determinant of
/// the size of rounding, and be hit.
struct MollerTrumbore {
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
    [[nodiscard]] Tested<Number> evaluate(const Vertices<Number>& t, const Triple<Number>& from,
                                          const Triple<Number>& to) const {
        const Triple<Number> d = to - from;
        const Triple<Number> e1 = t.b - t.a;
        const Triple<Number> e2 = t.c - t.a;
        const Triple<Number> p = cross(d, e2);
        const Number facing = dot(e1, p);
        const Turning<Number> turn(facing, sides);
        const Number det = turn(facing);
        Mask<Number> hit = det > Number{};
        if (none(hit)) return {hit};
        const Triple<Number> s = from - t.a;
        const Number u = turn(dot(s, p));
        hit = hit & (u >= Number{}) & (u <= det);
        if (none(hit)) return {hit};
        const Triple<Number> q = cross(s, e1);
        const Number v = turn(dot(d, q));
        hit = hit & (v >= Number{}) & ((det - u) - v >= Number{});
        if (none(hit)) return {hit};
        const Number fraction = turn(dot(e2, q));
        hit = hit & turn.passes(fraction, det);
        if (none(hit)) return {hit};
        return divided(hit, fraction, u, v, det);
    }

    /// Whether and where the segment from -> to hits the triangle.
    template <class Scalar>
    [[nodiscard]] std::optional<Answer<Scalar>> test(const Vertices<Scalar>& stored, const PointOf<Scalar>& from,
                                                     const PointOf<Scalar>& to) const {
        return answer(evaluate(stored, triple<Scalar>(from), triple<Scalar>(to)));
    }
};

/// `MollerTrumbore` with its defaults.
inline constexpr MollerTrumbore moller_trumbore{};

}  // namespace pierce::kernels
