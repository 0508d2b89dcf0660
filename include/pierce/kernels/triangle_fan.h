// Barnes' test: all triangles around a corner at once, by changes of basis from each to the next.
//
// Source: Barnes 2014, "A Beautiful Ray/Mesh Intersection Algorithm" (tavianator.com); the bases and the steps between
// them are in fan_basis.h.
//
// Counts. The source gives n divisions, 6 + 14 n multiplications, 7 + 11 n additions for a ray, that is a start and a
// direction; a segment first needs its direction, 3 additions more. We make up for them, and stay within the same
// counts, by z = u + v in two places, where 0 <= u <= z <= 1 needs no sum and only an answer the difference, 1
// addition:
// - The first middle row reads z, not v; the next u' = (a - 1) u + z + d w costs what it did. Segment 3, three rows of
//   start and direction 9 + 6, two values at the plane 2: 20 additions.
// - The last triangle is judged at the point where the line meets its plane, in the basis before it, by v' and
//   z' = (a + b) u + v + (d + e) w: 2 additions for the heights, 3 for the point, 1 + 2 for v' and z' there: 8 in place
//   of 11.
// One of these at most is the answer: 20 + 11 (n - 2) + 8 + 1 = 7 + 11 n. A fan of one triangle does both in the
// world's basis: direction 3, heights 3 + 2, point 3, u and z 6, the difference 1: 18. The direction is kept backwards,
// from - to, so that t = w(start) / w(direction) needs no sign.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <pierce/kernels/concept.h>
#include <pierce/kernels/fan_basis.h>
#include <pierce/mesh_view.h>

namespace pierce::kernels {

/// Where a segment meets a fan.
template <class Scalar>
struct FanAnswer : Answer<Scalar> {
    /// Which of the fan: k has the corners apex, ring[k], ring[k + 1]; u and v are the weights of the last two.
    std::uint32_t triangle;
};

/// Of either side, by `sides`. The answer is the first hit along the segment, of equal fractions as computed that of
/// the first triangle. The errors of u, v, w are handed on from each triangle to the next, and grow where these are
/// thin or nearly opposite to one another: for fans of good triangles with up to ten members they stay within a few
/// times those of `BaldwinWeber12`, with 64 it is some hundred times. `fans_of` has a limit for that.
struct TriangleFan {
    Sides sides = Sides::front;  ///< the side that a segment must come from

    /// The map to the basis of the first triangle.
    template <class Number>
    using First = FanFirst<Number>;
    /// The change from one basis to the next.
    template <class Number>
    using Turn = FanTurn<Number>;
    /// 6 (n + 1) numbers.
    template <class Number>
    struct Stored {
        First<Number> first;              ///< the first triangle
        std::vector<Turn<Number>> turns;  ///< one for each of the others

        /// How many triangles the fan has.
        [[nodiscard]] std::size_t triangles() const { return turns.size() + 1; }
    };

    /// Whether there is a basis. There is if the longer of ab and ac is within 2^-40 .. 2^40 in float, 2^-320 .. 2^320
    /// in double, and the double area, as computed, at least 2^-40 (2^-320) of its square; and none where the area is
    /// computed as zero, infinite or NaN.
    template <class Scalar>
    [[nodiscard]] static bool has_basis(const Vec3<Scalar>& a, const PointOf<Scalar>& b, const PointOf<Scalar>& c) {
        return fan_basis<Scalar>(triple<Scalar>(b) - triple<Scalar>(a), triple<Scalar>(c) - triple<Scalar>(a))
            .has_value();
    }

    /// n triangles from n + 1 ring vertices. Throws `MeshError` when there is no triangle, or one without a basis,
    /// which breaks the chain, among several; `fans_of` makes no such fan. A single triangle without one gives zeros,
    /// which nothing hits.
    template <class Scalar>
    [[nodiscard]] Stored<Scalar> prepare(const Vec3<Scalar>& apex, std::span<const Vec3<Scalar>> ring) const {
        if (ring.size() < 2) throw_mesh_error("a fan needs at least one triangle");
        if (ring.size() == 2) return prepare<Scalar>(apex, ring[0], ring[1]);
        const Triple<Scalar> a = triple<Scalar>(apex);
        const std::size_t last = ring.size() - 2;
        Stored<Scalar> stored;
        stored.turns.reserve(last);
        std::optional<FanBasis<Scalar>> before;
        for (std::size_t k = 0; k <= last; ++k) {
            const auto basis = fan_basis<Scalar>(triple<Scalar>(ring[k]) - a, triple<Scalar>(ring[k + 1]) - a);
            if (!basis)
                throw_mesh_error("fan triangle " + std::to_string(k) +
                                 " has no area, or one that can't be computed with");
            if (!before)
                stored.first = fan_first(*basis, a);
            else
                stored.turns.push_back(fan_turn(*before, *basis, k == last));
            before = basis;
        }
        stored.turns.front().a -= 1;
        return stored;
    }

    /// A fan of one triangle.
    template <class Scalar>
    [[nodiscard]] Stored<Scalar> prepare(const Vec3<Scalar>& a, const PointOf<Scalar>& b,
                                         const PointOf<Scalar>& c) const {
        const Triple<Scalar> apex = triple<Scalar>(a);
        const auto basis = fan_basis<Scalar>(triple<Scalar>(b) - apex, triple<Scalar>(c) - apex);
        return basis ? Stored<Scalar>{fan_first(*basis, apex), {}} : Stored<Scalar>{};
    }

    /// The first hit along the segment, if there is one. Linear in the triangles.
    template <class Scalar>
    [[nodiscard]] std::optional<FanAnswer<Scalar>> test(const Stored<Scalar>& fan, const PointOf<Scalar>& from,
                                                        const PointOf<Scalar>& to) const {
        return evaluate<Scalar>(fan.first, fan.turns, triple<Scalar>(from), triple<Scalar>(to));
    }

    /// The same in any type of number that has one lane: its mask is bool.
    template <class Number>
    [[nodiscard]] std::optional<FanAnswer<Number>> evaluate(const First<Number>& first,
                                                            std::span<const Turn<Number>> turns,
                                                            const Triple<Number>& from,
                                                            const Triple<Number>& to) const {
        const Triple<Number> back = from - to;
        Line<Number> line{{}, {}, first.height(from), dot(first.height.normal, back)};
        Nearest<Number> nearest;
        if (turns.empty()) {
            if (!passes(line.w, line.back_w)) return std::nullopt;
            const Number t = line.w / line.back_w;
            const Triple<Number> x = from - t * back;
            nearest.take_first(t, first.u(x), first.u_plus_v(x));
            return nearest.answer();
        }
        line.u = {first.u(from), dot(first.u.normal, back)};
        line.v = {first.u_plus_v(from), dot(first.u_plus_v.normal, back)};
        if (passes(line.w, line.back_w)) {
            const Number t = line.w / line.back_w;
            nearest.take_first(t, line.u.at(t), line.v.at(t));
        }
        const std::size_t last = turns.size() - 1;
        for (std::size_t k = 0; k < last; ++k) {
            line = line.turned(turns[k]);
            if (!passes(line.w, line.back_w)) continue;
            const Number t = line.w / line.back_w;
            if (nearest.is_before(t)) nearest.take(t, line.u.at(t), line.v.at(t), k + 1);
        }
        const Turn<Number>& turn = turns[last];
        const Number end_w = turn.c * line.u.start + turn.f * line.w;
        const Number end_back = turn.c * line.u.back + turn.f * line.back_w;
        if (passes(end_w, end_back)) {
            const Number t = end_w / end_back;
            if (nearest.is_before(t)) {
                const Number u = line.u.at(t);
                const Number w = line.w - t * line.back_w;
                nearest.take_last(t, turn.b * u + turn.e * w, turn.a * u + line.v.at(t) + turn.d * w, last + 1);
            }
        }
        return nearest.answer();
    }

  private:
    /// The start is in front or on the plane, and the end, whose height is w - back_w, behind it; from the back the
    /// same, mirrored; for both a change of side, where on the plane counts as in front.
    template <class Number>
    [[nodiscard]] bool passes(const Number& w, const Number& back_w) const {
        const bool down = w >= Number{} && w < back_w;
        if (sides == Sides::front) return down;
        if (sides == Sides::back) return w <= Number{} && w > back_w;
        return down || (w < Number{} && w >= back_w);
    }

    /// A coordinate along the line: of its start, and of the way back from its end.
    template <class Number>
    struct Coordinate {
        Number start;
        Number back;
        [[nodiscard]] Number at(const Number& t) const { return start - t * back; }
    };

    template <class Number>
    struct Nearest {
        Number t{};
        Number u{};
        Number v{};
        std::size_t triangle = 0;
        bool found = false;

        [[nodiscard]] bool is_before(const Number& other) const { return !found || other < t; }
        /// Keeps u + v for v: only if nothing nearer comes is the difference needed.
        void take_first(const Number& at, const Number& new_u, const Number& u_plus_v) {
            if (new_u >= Number{} && u_plus_v >= new_u && u_plus_v <= Number(1)) *this = {at, new_u, u_plus_v, 0, true};
        }
        void take(const Number& at, const Number& new_u, const Number& new_v, std::size_t number) {
            if (new_u >= Number{} && new_v >= Number{} && new_u + new_v <= Number(1))
                *this = {at, new_u, new_v, number, true};
        }
        void take_last(const Number& at, const Number& new_v, const Number& u_plus_v, std::size_t number) {
            if (new_v >= Number{} && u_plus_v >= new_v && u_plus_v <= Number(1))
                *this = {at, u_plus_v - new_v, new_v, number, true};
        }
        [[nodiscard]] std::optional<FanAnswer<Number>> answer() const {
            if (!found) return std::nullopt;
            return FanAnswer<Number>{{t, u, triangle == 0 ? v - u : v}, static_cast<std::uint32_t>(triangle)};
        }
    };

    template <class Number>
    struct Line {
        Coordinate<Number> u;
        Coordinate<Number> v;  ///< in the first basis u + v
        Number w;
        Number back_w;

        [[nodiscard]] Line turned(const Turn<Number>& m) const {
            return {{m.a * u.start + v.start + m.d * w, m.a * u.back + v.back + m.d * back_w},
                    {m.b * u.start + m.e * w, m.b * u.back + m.e * back_w},
                    m.c * u.start + m.f * w,
                    m.c * u.back + m.f * back_w};
        }
    };
};

/// `TriangleFan` with its defaults.
inline constexpr TriangleFan triangle_fan{};

}  // namespace pierce::kernels
