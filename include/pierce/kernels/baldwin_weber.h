// Baldwin and Weber's test: the affine map that takes the triangle to (0,0,0), (1,0,0), (0,1,0), as twelve numbers or
// as nine.
//
// Source: Baldwin and Weber 2016, "Fast Ray-Triangle Intersections by Coordinate Transformation", sections 2 and 3. Our
// derivation of the inverse: every point is p = a + u E1 + v E2 + w f, with E1 = b - a, E2 = c - a, and a "free vector"
// f that only must not lie in the plane. Multiplying p - a by E2 x f removes E2 and f, by f x E1 removes E1 and f, by
// n = E1 x E2 removes E1 and E2:
//   u = (E2 x f) . (p - a) / n.f      v = (f x E1) . (p - a) / n.f      w = n . (p - a) / n.f
// Let k be the axis of n's largest component, (k, i, j) the axes in cyclic order, and s the sign of n_k. With
// f = s e_k, n.f = |n_k| and
//   u = ( E2_j (p-a)_i - E2_i (p-a)_j) / n_k
//   v = (-E1_j (p-a)_i + E1_i (p-a)_j) / n_k
//   w = s (p-a)_k + (n_i (p-a)_i + n_j (p-a)_j) / |n_k|
// Two coefficients of column k are 0 and one is s: what remains are nine numbers and which column, with its sign.
//
// Departures: the source takes f = e_k, so that w > 0 may be either side; with the sign it is the front, always. And it
// divides first; here both ends of the segment are transformed, and with F = w(from), T = w(to) and D = F - T the
// weights at the plane times D are F u(to) - T u(from) and F v(to) - T v(from). Some entries of the printed inverses
// are hard to read; tests/kernels/inverse_test.cpp applies ours to the corners.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include <pierce/kernels/concept.h>

namespace pierce::kernels {

/// Which column of the map holds (0, 0, s): the axis k, plus 3 where s is -1. One byte; for numbers with lanes a number
/// in each.
template <class Number>
using Column = std::conditional_t<std::is_arithmetic_v<Number>, std::uint8_t, Number>;

/// The coordinates (k, i, j) of p.
template <class Number>
[[nodiscard]] constexpr Triple<Number> from_column(std::uint8_t column, const Triple<Number>& p) {
    constexpr std::array<std::uint8_t, 8> cyclic = {0, 1, 2, 0, 1, 2, 0, 1};
    return {p[cyclic[column]], p[cyclic[column + 1U]], p[cyclic[column + 2U]]};
}
/// x times the sign s of the column.
template <class Number>
[[nodiscard]] constexpr Number with_sign_of(std::uint8_t column, const Number& x) {
    return column < 3 ? x : -x;
}

/// The coordinates (k, i, j) of p, for numbers with lanes.
template <class Number>
requires(!std::is_arithmetic_v<Number>)
    [[nodiscard]] Triple<Number> from_column(const Number& column, const Triple<Number>& p) {
    const auto is = [&](int k) { return (column == Number(k)) | (column == Number(k + 3)); };
    const auto pick = [&](std::size_t x, std::size_t y, std::size_t z) {
        return select(is(0), p[x], select(is(1), p[y], p[z]));
    };
    return {pick(0, 1, 2), pick(1, 2, 0), pick(2, 0, 1)};
}
/// x times the sign s of the column, for numbers with lanes.
template <class Number>
requires(!std::is_arithmetic_v<Number>) [[nodiscard]] Number with_sign_of(const Number& column, const Number& x) {
    return select(column < Number(3), x, -x);
}

/// Twelve numbers: the three rows of the map. Of either side, by `sides`. In range where `Bloom` is; a computed normal
/// of zero gives zeros, which nothing hits. Neighbours that share an edge compute it from different rows: a segment
/// aimed at the edge can pass between them, and can hit both.
struct BaldwinWeber12 {
    Sides sides = Sides::front;  ///< the side that a segment must come from

    /// The three rows of the map.
    template <class Number>
    struct Stored {
        Plane<Number> u;       ///< weight of b
        Plane<Number> v;       ///< weight of c
        Plane<Number> height;  ///< above the plane, positive in front
    };

    /// The stored form of a triangle.
    template <class Scalar>
    [[nodiscard]] Stored<Scalar> prepare(const Vec3<Scalar>& corner_a, const PointOf<Scalar>& corner_b,
                                         const PointOf<Scalar>& corner_c) const {
        const Triple<Scalar> a = triple<Scalar>(corner_a);
        const Triple<Scalar> e1 = triple<Scalar>(corner_b) - a;
        const Triple<Scalar> e2 = triple<Scalar>(corner_c) - a;
        const Triple<Scalar> n = cross(e1, e2);
        const std::size_t k = largest(n);
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        const Scalar size = std::abs(n[k]);
        if (!(size > 0)) return {};
        Triple<Scalar> u{};
        Triple<Scalar> v{};
        Triple<Scalar> height{};
        u[i] = e2[j] / n[k];
        u[j] = -e2[i] / n[k];
        v[i] = -e1[j] / n[k];
        v[j] = e1[i] / n[k];
        height[k] = n[k] > 0 ? Scalar{1} : Scalar{-1};
        height[i] = n[i] / size;
        height[j] = n[j] / size;
        return {plane(u, a), plane(v, a), plane(height, a)};
    }

    /// The test in any type of number: for one segment, or for several in step.
    template <class Number>
    [[nodiscard]] Tested<Number> evaluate(const Stored<Number>& t, const Triple<Number>& from,
                                          const Triple<Number>& to) const {
        auto [hit, f, g] = passage(t.height(from), t.height(to), sides);
        if (none(hit)) return {hit};
        const Number d = f - g;
        const Number u = f * t.u(to) - g * t.u(from);
        hit = hit & (u >= Number{}) & (u <= d);
        if (none(hit)) return {hit};
        const Number v = f * t.v(to) - g * t.v(from);
        hit = hit & (v >= Number{}) & ((d - u) - v >= Number{});
        if (none(hit)) return {hit};
        return divided(hit, f, u, v, d);
    }

    /// Whether and where the segment from -> to hits the triangle.
    template <class Scalar>
    [[nodiscard]] std::optional<Answer<Scalar>> test(const Stored<Scalar>& stored, const PointOf<Scalar>& from,
                                                     const PointOf<Scalar>& to) const {
        return answer(evaluate(stored, triple<Scalar>(from), triple<Scalar>(to)));
    }
};

static_assert(sizeof(BaldwinWeber12::Stored<float>) == 12 * sizeof(float));

/// Nine numbers and the column: the same map without what is known of it. The rest as for `BaldwinWeber12`.
struct BaldwinWeber9 {
    Sides sides = Sides::front;  ///< the side that a segment must come from

    /// A row without its entry in column k: `at_i p_i + at_j p_j + offset`.
    template <class Number>
    struct Row {
        Number at_i;    ///< coefficient along axis i
        Number at_j;    ///< coefficient along axis j
        Number offset;  ///< the value at the origin

        /// The value at a point whose coordinates are in the order (k, i, j).
        [[nodiscard]] constexpr Number operator()(const Triple<Number>& kij) const {
            return at_i * kij[1] + at_j * kij[2] + offset;
        }
    };
    /// The three rows, each without one entry, and which.
    template <class Number>
    struct Stored {
        Row<Number> u;            ///< weight of b
        Row<Number> v;            ///< weight of c
        Row<Number> height;       ///< times s, so that its entry in column k is 1
        Column<Number> column{};  ///< the axis k and the sign s
    };

    /// The stored form of a triangle.
    template <class Scalar>
    [[nodiscard]] Stored<Scalar> prepare(const Vec3<Scalar>& a, const PointOf<Scalar>& b,
                                         const PointOf<Scalar>& c) const {
        const auto full = BaldwinWeber12{}.prepare<Scalar>(a, b, c);
        std::uint8_t k = 0;
        while (k < 2 && std::abs(full.height.normal[k]) != 1) ++k;
        const std::size_t i = (k + 1U) % 3;
        const std::size_t j = (k + 2U) % 3;
        const Scalar sign = full.height.normal[k];
        if (sign == 0) return without_area<Scalar>();
        const auto row = [i, j](const Plane<Scalar>& p, Scalar s) {
            return Row<Scalar>{s * p.normal[i], s * p.normal[j], s * p.offset};
        };
        return {row(full.u, 1), row(full.v, 1), row(full.height, sign),
                static_cast<std::uint8_t>(sign > 0 ? k : k + 3)};
    }

    /// The test in any type of number: for one segment, or for several in step.
    template <class Number>
    [[nodiscard]] Tested<Number> evaluate(const Stored<Number>& t, const Triple<Number>& from,
                                          const Triple<Number>& to) const {
        const Triple<Number> start = from_column(t.column, from);
        const Triple<Number> end = from_column(t.column, to);
        auto [hit, f, g] = passage(with_sign_of(t.column, start[0] + t.height(start)),
                                   with_sign_of(t.column, end[0] + t.height(end)), sides);
        if (none(hit)) return {hit};
        const Number d = f - g;
        const Number u = f * t.u(end) - g * t.u(start);
        hit = hit & (u >= Number{}) & (u <= d);
        if (none(hit)) return {hit};
        const Number v = f * t.v(end) - g * t.v(start);
        hit = hit & (v >= Number{}) & ((d - u) - v >= Number{});
        if (none(hit)) return {hit};
        return divided(hit, f, u, v, d);
    }

    /// Whether and where the segment from -> to hits the triangle.
    template <class Scalar>
    [[nodiscard]] std::optional<Answer<Scalar>> test(const Stored<Scalar>& stored, const PointOf<Scalar>& from,
                                                     const PointOf<Scalar>& to) const {
        return answer(evaluate(stored, triple<Scalar>(from), triple<Scalar>(to)));
    }

  private:
    // The entry in column k is 1 whatever is stored, so zeros would be a plane. NaN is on no side of anything.
    template <class Scalar>
    static Stored<Scalar> without_area() {
        Stored<Scalar> stored{};
        stored.height.offset = std::numeric_limits<Scalar>::quiet_NaN();
        return stored;
    }
};

// The column is one byte, and three to align it.
static_assert(sizeof(BaldwinWeber9::Stored<float>) == 10 * sizeof(float));

/// `BaldwinWeber12` with its defaults.
inline constexpr BaldwinWeber12 baldwin_weber_12{};
/// `BaldwinWeber9` with its defaults.
inline constexpr BaldwinWeber9 baldwin_weber_9{};

}  // namespace pierce::kernels
