// McGuire's test: one-sided, with an epsilon on the determinant and, if wished, a tolerance on the weights.
//
// Source: McGuire 2012, The Graphics Codex, "Ray-triangle intersection", after Akenine-Moller, Haines and Hoffman 2008,
// Real-Time Rendering, page 750. With the unit direction w, E1, E2 and n = E1 x E2: q = w x E2, det = E1 . q,
// s = (P - a) / det, r = s x E1, and
//   weight of b = s . q     weight of c = r . w     distance = E2 . r
// The comment of the source attaches these weights to other corners than its listing does; the listing is right.
//
// Departures: a segment, so the distance must be below its length, and is reported as a fraction of it. n is not
// normalised: only its sign along w counts. The early division is the source's, and what its epsilon is for.
#pragma once

#include <cmath>

#include <pierce/kernels/concept.h>

namespace pierce::kernels {

/// det is minus the triangle's double area times the cosine between the direction and the normal: an area. So the
/// epsilon has the dimension of an area, and every triangle with double area x cosine <= epsilon is lost: with 1e-7,
/// right-angled triangles with legs below 0.32 mm, if the unit is a metre, and larger ones at grazing angles.
struct McGuire {
    double epsilon = 1e-7;  ///< in squared units of length
    double tolerance = 0;   ///< weights down to minus this count as inside: a triangle grows by this part of its height

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
        using std::sqrt;
        const Number one(1);
        const auto least = static_cast<Number>(-tolerance);
        const auto threshold = static_cast<Number>(epsilon);
        const Triple<Number> way = to - from;
        const Number length = sqrt(dot(way, way));
        const Triple<Number> w = (one / length) * way;
        const Triple<Number> e1 = t.b - t.a;
        const Triple<Number> e2 = t.c - t.a;
        const Triple<Number> q = cross(w, e2);
        const Number det = dot(e1, q);
        Mask<Number> hit = (dot(cross(e1, e2), w) < Number{}) & ((det > threshold) | (det < -threshold));
        if (none(hit)) return {hit};
        const Triple<Number> s = (one / det) * (from - t.a);
        const Number u = dot(s, q);
        hit = hit & (u >= least);
        if (none(hit)) return {hit};
        const Triple<Number> r = cross(s, e1);
        const Number v = dot(r, w);
        hit = hit & (v >= least) & (one - u - v >= least);
        if (none(hit)) return {hit};
        const Number distance = dot(e2, r);
        hit = hit & (distance >= Number{}) & (distance < length);
        if (none(hit)) return {hit};
        return {hit, distance / length, u, v};
    }

    /// Whether and where the segment from -> to hits the triangle.
    template <class Scalar>
    [[nodiscard]] std::optional<Answer<Scalar>> test(const Vertices<Scalar>& stored, const PointOf<Scalar>& from,
                                                     const PointOf<Scalar>& to) const {
        return answer(evaluate(stored, triple<Scalar>(from), triple<Scalar>(to)));
    }
};

/// `McGuire` with its defaults.
inline constexpr McGuire mcguire{};

}  // namespace pierce::kernels
