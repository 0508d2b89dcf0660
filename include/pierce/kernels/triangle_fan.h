// Barnes' test: all triangles around a corner at once, by changes of basis from each to the next.
//
// Source: Barnes 2014, "A Beautiful Ray/Mesh Intersection Algorithm" (tavianator.com). The triangles are A R0 R1, A R1 R2, ... In the basis of
// the first, p = A + u AB + v AC + w N, with B = R0, C = R1, N = AB x AC. Our derivation of the step to the next, A C D, where
// p = A + u' AC + v' AD + w' N' with N' = AC x AD: the origins agree, and AC is the first vector of the new basis. The other two are
//   AB = a AC + b AD + c N'     N = d AC + e AD + f N'
// and by Cramer's rule, over N'.N' = [AC AD N'],
//   a = (AB x AD).N'   b = (AC x AB).N'   c = AB.N'     d = (N x AD).N'   e = (AC x N).N'   f = N.N'
// Putting them into p gives u' = a u + v + d w, v' = b u + e w, w' = c u + f w: six numbers, 6 multiplications, 4 additions a vector.
//
// Counts. The source gives n divisions, 6 + 14 n multiplications, 7 + 11 n additions for a ray, that is a start and a direction; a segment
// first needs its direction, 3 additions more. We make up for them, and stay within the same counts, in two places:
// - The first middle row reads z = u + v, not v, so that 0 <= u <= z <= 1 needs no sum; the next u' = (a - 1) u + z + d w costs
//   what it did. Segment 3, three rows of start and direction 9 + 6, two values at the plane 2: 20 additions.
// - The last triangle is judged at the point where the line meets its plane, in the basis before it: 2 additions for the heights, 3 for
//   the point, 3 for u' and v' there, 1 for their sum: 9 in place of 11. A fan of one triangle does the same in the world's basis: 18.
// 20 + 11 (n - 2) + 9 = 7 + 11 n. The direction is kept backwards, from - to, so that t = w(start) / w(direction) needs no sign.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include <pierce/kernels/concept.h>
#include <pierce/mesh_view.h>

namespace pierce::kernels {

template <class Scalar>
struct FanAnswer : Answer<Scalar> {
    std::uint32_t triangle;  ///< which of the fan: k has the corners apex, ring[k], ring[k + 1]; u and v are the weights of the last two
};

/// One-sided. The answer is the first hit along the segment, of equal fractions as computed that of the first triangle. The errors of u, v, w
/// are handed on from each triangle to the next, and grow where these are thin or nearly opposite to one another: for fans of good
/// triangles with up to ten members they stay within a few times those of `BaldwinWeber12`.
struct TriangleFan {
    /// The affine map to the first triangle's basis.
    template <class Number>
    struct First {
        Plane<Number> u;
        Plane<Number> u_plus_v;
        Plane<Number> height;
    };
    /// From the basis of one triangle to that of the next. The first `a` of a fan is lowered by one, see above.
    template <class Number>
    struct Turn {
        Number a, b, c, d, e, f;
    };
    /// 6 (n + 1) numbers.
    template <class Number>
    struct Stored {
        First<Number> first;
        std::vector<Turn<Number>> turns;

        [[nodiscard]] std::size_t triangles() const { return turns.size() + 1; }
    };

    /// Whether there is a basis: the computed normal and its square are not zero, infinite or NaN. In float that takes edges within
    /// 2^-30 .. 2^30, in double within 2^-250 .. 2^250.
    template <class Scalar>
    [[nodiscard]] static bool has_basis(const Vec3<Scalar>& a, const PointOf<Scalar>& b, const PointOf<Scalar>& c) {
        const Triple<Scalar> n = cross(triple<Scalar>(b) - triple<Scalar>(a), triple<Scalar>(c) - triple<Scalar>(a));
        const Scalar square = dot(n, n);
        return square >= std::numeric_limits<Scalar>::min() && square <= std::numeric_limits<Scalar>::max();
    }

    /// n triangles from n + 1 ring vertices. Throws `MeshError` when there is no triangle, or one without a basis, which breaks the chain, among
    /// several; `fans_of` makes no such fan. A single triangle without one gives zeros, which nothing hits.
    template <class Scalar>
    [[nodiscard]] Stored<Scalar> prepare(const Vec3<Scalar>& apex, std::span<const Vec3<Scalar>> ring) const {
        if (ring.size() < 2) throw MeshError("a fan needs at least one triangle");
        if (ring.size() == 2) return prepare<Scalar>(apex, ring[0], ring[1]);
        for (std::size_t k = 0; k + 1 < ring.size(); ++k)
            if (!has_basis<Scalar>(apex, ring[k], ring[k + 1]))
                throw MeshError("fan triangle " + std::to_string(k) + " has no area, or one that can't be computed with");
        Stored<Scalar> stored{first_of<Scalar>(apex, ring[0], ring[1]), {}};
        stored.turns.reserve(ring.size() - 2);
        for (std::size_t k = 0; k + 2 < ring.size(); ++k) {
            const auto vector = [&](std::size_t i) { return triple<Scalar>(ring[k + i]) - triple<Scalar>(apex); };
            stored.turns.push_back(turn_of(vector(0), vector(1), vector(2)));
        }
        stored.turns.front().a -= 1;
        return stored;
    }

    template <class Scalar>
    [[nodiscard]] Stored<Scalar> prepare(const Vec3<Scalar>& a, const PointOf<Scalar>& b, const PointOf<Scalar>& c) const {
        if (!has_basis<Scalar>(a, b, c)) return {};
        return {first_of<Scalar>(a, b, c), {}};
    }

    template <class Scalar>
    [[nodiscard]] std::optional<FanAnswer<Scalar>> test(const Stored<Scalar>& fan, const PointOf<Scalar>& from,
                                                        const PointOf<Scalar>& to) const {
        return evaluate<Scalar>(fan.first, fan.turns, triple<Scalar>(from), triple<Scalar>(to));
    }

    /// `Number` has one lane: its mask is bool.
    template <class Number>
    [[nodiscard]] std::optional<FanAnswer<Number>> evaluate(const First<Number>& first, std::span<const Turn<Number>> turns,
                                                            const Triple<Number>& from, const Triple<Number>& to) const {
        const Triple<Number> back = from - to;
        Line<Number> line{{}, {}, first.height(from), dot(first.height.normal, back)};
        Nearest<Number> nearest;
        if (turns.empty()) {
            if (!line.passes()) return std::nullopt;
            const Number t = line.w / line.back_w;
            const Triple<Number> x = from - t * back;
            nearest.take_first(t, first.u(x), first.u_plus_v(x));
            return nearest.answer();
        }
        line.u = {first.u(from), dot(first.u.normal, back)};
        line.v = {first.u_plus_v(from), dot(first.u_plus_v.normal, back)};
        if (line.passes()) {
            const Number t = line.w / line.back_w;
            nearest.take_first(t, line.u.at(t), line.v.at(t));
        }
        const std::size_t last = turns.size() - 1;
        for (std::size_t k = 0; k < last; ++k) {
            line = line.turned(turns[k]);
            if (!line.passes()) continue;
            const Number t = line.w / line.back_w;
            if (nearest.is_before(t)) nearest.take(t, line.u.at(t), line.v.at(t), k + 1);
        }
        const Turn<Number>& turn = turns[last];
        const Line<Number> end = {{}, {}, turn.c * line.u.start + turn.f * line.w, turn.c * line.u.back + turn.f * line.back_w};
        if (end.passes()) {
            const Number t = end.w / end.back_w;
            if (nearest.is_before(t)) {
                const Number u = line.u.at(t);
                const Number w = line.w - t * line.back_w;
                nearest.take(t, turn.a * u + line.v.at(t) + turn.d * w, turn.b * u + turn.e * w, last + 1);
            }
        }
        return nearest.answer();
    }

  private:
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
            if (new_u >= Number{} && new_v >= Number{} && new_u + new_v <= Number(1)) *this = {at, new_u, new_v, number, true};
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

        /// Starts in front or on the plane, and ends behind: the end's height is w - back_w.
        [[nodiscard]] bool passes() const { return w >= Number{} && w < back_w; }
        [[nodiscard]] Line turned(const Turn<Number>& m) const {
            return {{m.a * u.start + v.start + m.d * w, m.a * u.back + v.back + m.d * back_w},
                    {m.b * u.start + m.e * w, m.b * u.back + m.e * back_w},
                    m.c * u.start + m.f * w,
                    m.c * u.back + m.f * back_w};
        }
    };

    // Rows of the inverse of (AB, AC, N): the cross products of the other two columns, over [AB AC N] = N.N.
    template <class Scalar>
    static First<Scalar> first_of(const Vec3<Scalar>& corner_a, const Vec3<Scalar>& corner_b, const Vec3<Scalar>& corner_c) {
        const Triple<Scalar> a = triple<Scalar>(corner_a);
        const Triple<Scalar> ab = triple<Scalar>(corner_b) - a;
        const Triple<Scalar> ac = triple<Scalar>(corner_c) - a;
        const Triple<Scalar> n = cross(ab, ac);
        const Scalar scale = 1 / dot(n, n);
        // u + v is 1 on BC: (AC x N + N x AB) = N x (AB - AC)
        return {plane(scale * cross(ac, n), a), plane(scale * cross(n, ab - ac), a), plane(scale * n, a)};
    }

    template <class Scalar>
    static Turn<Scalar> turn_of(const Triple<Scalar>& ab, const Triple<Scalar>& ac, const Triple<Scalar>& ad) {
        const Triple<Scalar> old_normal = cross(ab, ac);
        const Triple<Scalar> n = cross(ac, ad);
        const Scalar square = dot(n, n);
        return {dot(cross(ab, ad), n) / square,         dot(cross(ac, ab), n) / square,         dot(ab, n) / square,
                dot(cross(old_normal, ad), n) / square, dot(cross(ac, old_normal), n) / square, dot(old_normal, n) / square};
    }
};

static_assert(sizeof(TriangleFan::First<float>) == 12 * sizeof(float) && sizeof(TriangleFan::Turn<float>) == 6 * sizeof(float));

inline constexpr TriangleFan triangle_fan{};

}  // namespace pierce::kernels
