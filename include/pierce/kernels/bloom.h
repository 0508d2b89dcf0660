// Bloom's test: the plane of the triangle and two "barycentric planes", twelve numbers.
//
// Source: Bloom 2002, "Fast ray tri (with precomputation)". With n = (b-a) x (c-a), F = height(from), T = height(to)
// and D = F - T, the segment meets the plane in x = (F to - T from) / D: at fraction s = F / D, and to s + from (1 - s)
// is just that. A barycentric plane contains an edge and the direction n, and is scaled to read 1 at the opposite
// corner; its value at x times D is
//   normal . (F to - T from) + offset D,
// so that nothing is divided before the hit is certain.
//
// Departures: the listing adds the two products, where the difference is meant: that is the segment from -> -to, and
// most hits are lost, far from the origin all (tests/kernels/weaknesses_test.cpp). Its normal points to the back, ours
// to the front. It keeps the weights of c (plane through ab) and a (plane through bc); b's, which is u here, is what is
// left.
#pragma once

#include <cmath>

#include <pierce/kernels/concept.h>

namespace pierce::kernels {

/// Planes of the triangle and of two weights. Neighbours that share an edge compute it from different planes: a segment
/// aimed at the edge can pass between them.
struct Bloom {
    /// Twelve numbers: the three planes.
    template <class Number>
    struct Stored {
        Plane<Number> height;    ///< positive in front; the normal's largest component is 1 or -1
        Plane<Number> weight_c;  ///< 0 on the edge ab, 1 at c
        Plane<Number> weight_a;  ///< 0 on the edge bc, 1 at a
    };

    /// One-sided. A computed normal of zero gives twelve zeros, which nothing hits. In range for float where the
    /// triangle's size and its distance from the origin are within 2^-40 .. 2^40; for double 2^-300 .. 2^300.
    template <class Scalar>
    [[nodiscard]] Stored<Scalar> prepare(const Vec3<Scalar>& corner_a, const PointOf<Scalar>& corner_b,
                                         const PointOf<Scalar>& corner_c) const {
        const Triple<Scalar> a = triple<Scalar>(corner_a);
        const Triple<Scalar> b = triple<Scalar>(corner_b);
        const Triple<Scalar> c = triple<Scalar>(corner_c);
        const Triple<Scalar> unscaled = cross(b - a, c - a);
        const Scalar size = std::abs(unscaled[largest(unscaled)]);
        if (!(size > 0)) return {};
        const Triple<Scalar> n = {unscaled[0] / size, unscaled[1] / size, unscaled[2] / size};
        const auto barycentric = [&n](const Triple<Scalar>& p, const Triple<Scalar>& q,
                                      const Triple<Scalar>& opposite) {
            const Triple<Scalar> inwards = cross(n, q - p);
            return plane((1 / dot(inwards, opposite - p)) * inwards, p);
        };
        return {plane(n, a), barycentric(a, b, c), barycentric(b, c, a)};
    }

    /// The test in any type of number: for one segment, or for several in step.
    template <class Number>
    [[nodiscard]] Tested<Number> evaluate(const Stored<Number>& t, const Triple<Number>& from,
                                          const Triple<Number>& to) const {
        const Number f = t.height(from);
        const Number g = t.height(to);
        Mask<Number> hit = (f >= Number{}) & (g < Number{});
        if (none(hit)) return {hit};
        const Number d = f - g;
        const Triple<Number> x = f * to - g * from;
        const Number c = dot(t.weight_c.normal, x) + t.weight_c.offset * d;
        hit = hit & (c >= Number{});
        if (none(hit)) return {hit};
        const Number a = dot(t.weight_a.normal, x) + t.weight_a.offset * d;
        const Number b = (d - c) - a;
        hit = hit & (a >= Number{}) & (b >= Number{});
        if (none(hit)) return {hit};
        return divided(hit, f, b, c, d);
    }

    /// Whether and where the segment from -> to hits the triangle.
    template <class Scalar>
    [[nodiscard]] std::optional<Answer<Scalar>> test(const Stored<Scalar>& stored, const PointOf<Scalar>& from,
                                                     const PointOf<Scalar>& to) const {
        return answer(evaluate(stored, triple<Scalar>(from), triple<Scalar>(to)));
    }
};

static_assert(sizeof(Bloom::Stored<float>) == 12 * sizeof(float));

/// `Bloom` with its defaults.
inline constexpr Bloom bloom{};

}  // namespace pierce::kernels
