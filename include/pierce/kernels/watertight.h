// Woop, Benthin and Wald's test: no crack at the edges that triangles share.
//
// Source: Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection", JCGT 2(1). The origin is moved to zero
// and the axis of the direction's largest component, z, is sheared onto the direction: the line becomes the z axis, and
// it hits the triangle if the origin lies in the triangle's image in the plane. The corners are transformed one by one,
// and the three edge functions
//   U = Cx By - Cy Bx     V = Ax Cy - Ay Cx     W = Bx Ay - By Ax
// depend on two corners each, so that the two triangles at an edge see the same number with opposite signs. x and y are
// exchanged where the direction goes down its axis, so that U, V, W are positive for a front. An edge function that is
// 0 in float is recomputed in double.
//
// Departures: a segment, fraction < 1. For double, where there is nothing wider at hand, a 0 is recomputed from the
// rounding errors of the two products, which are exact in a fused operation. Transforming per ray is done once per test
// here.
#pragma once

#include <cmath>

#include <pierce/kernels/concept.h>

namespace pierce::kernels {

/// p q - r s where it is 0 as computed: its exact sign.
[[nodiscard]] inline float refined(float p, float q, float r, float s) {
    const double difference = double{p} * double{q} - double{r} * double{s};  // both products are exact
    return static_cast<float>(difference);
}
[[nodiscard]] inline double refined(double p, double q, double r, double s) {
    return std::fma(p, q, -(p * q)) - std::fma(r, s, -(r * s));  // the products are the same number
}

/// The edge function p q - r s, and the better one where it is 0. For a type of number with lanes there is another in
/// its namespace.
template <class Number>
[[nodiscard]] Number edge_function(const Number& p, const Number& q, const Number& r, const Number& s, bool refine) {
    return refine ? refined(p, q, r, s) : p * q - r * s;
}

/// Of either side, by `sides`. Watertight at edges and corners against one and the same segment, as long as nothing
/// overflows or underflows and nothing is contracted. Not at the plane: whether an end lies in front of it is as
/// rounded as everywhere, so chains of steps leak.
struct Watertight {
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
        const Number zero{};
        const Triple<Number> way = to - from;
        const auto magnitude = [&zero](const Number& x) { return select(x < zero, -x, x); };
        const Triple<Number> size = {magnitude(way[0]), magnitude(way[1]), magnitude(way[2])};
        const Mask<Number> x_beats_y = size[0] >= size[1];
        const Mask<Number> x_beats_z = size[0] >= size[2];
        const Mask<Number> x_is_z = x_beats_y & x_beats_z;
        const Mask<Number> y_is_z = size[1] >= size[2];
        const auto turned = [&](const Triple<Number>& p) -> Triple<Number> {
            const auto pick = [&](std::size_t i, std::size_t j, std::size_t k) {
                return select(x_is_z, p[i], select(y_is_z, p[j], p[k]));
            };
            return {pick(1, 2, 0), pick(2, 0, 1), pick(0, 1, 2)};
        };
        const Triple<Number> d = turned(way);
        const Mask<Number> down = d[2] < zero;
        const Number shear_z = Number(1) / d[2];
        const Number shear_x = d[0] / d[2];
        const Number shear_y = d[1] / d[2];
        const auto sheared = [&](const Triple<Number>& corner) -> Triple<Number> {
            const Triple<Number> p = turned(corner - from);
            const Number x = p[0] - shear_x * p[2];
            const Number y = p[1] - shear_y * p[2];
            return {select(down, y, x), select(down, x, y), p[2]};
        };
        const Triple<Number> a = sheared(t.a);
        const Triple<Number> b = sheared(t.b);
        const Triple<Number> c = sheared(t.c);
        Number u = c[0] * b[1] - c[1] * b[0];
        Number v = a[0] * c[1] - a[1] * c[0];
        Number w = b[0] * a[1] - b[1] * a[0];
        const Mask<Number> doubtful = (u == zero) | (v == zero) | (w == zero);
        if (!none(doubtful)) {
            u = edge_function(c[0], b[1], c[1], b[0], u == zero);
            v = edge_function(a[0], c[1], a[1], c[0], v == zero);
            w = edge_function(b[0], a[1], b[1], a[0], w == zero);
        }
        const Mask<Number> front = (u >= zero) & (v >= zero) & (w >= zero);
        const Mask<Number> back = (u <= zero) & (v <= zero) & (w <= zero);
        Mask<Number> hit = sides == Sides::front ? front : sides == Sides::back ? back : front | back;
        if (none(hit)) return {hit};
        const Number area = u + v + w;
        const Turning<Number> turn(area, sides);
        const Number det = turn(area);
        hit = hit & (det > zero);
        const Number fraction = turn(u * (shear_z * a[2]) + v * (shear_z * b[2]) + w * (shear_z * c[2]));
        hit = hit & turn.passes(fraction, det);
        if (none(hit)) return {hit};
        return divided(hit, fraction, turn(v), turn(w), det);
    }

    /// Whether and where the segment from -> to hits the triangle.
    template <class Scalar>
    [[nodiscard]] std::optional<Answer<Scalar>> test(const Vertices<Scalar>& stored, const PointOf<Scalar>& from,
                                                     const PointOf<Scalar>& to) const {
        return answer(evaluate(stored, triple<Scalar>(from), triple<Scalar>(to)));
    }
};

/// `Watertight` with its defaults.
inline constexpr Watertight watertight{};

}  // namespace pierce::kernels
