// Barnes' test: all triangles around a corner at once, by changes of basis from each to the next.
//
// Source: Barnes 2014, "A Beautiful Ray/Mesh Intersection Algorithm" (tavianator.com). The triangles are A R0 R1, A R1 R2, ... In the basis of
// the first, p = A + u AB + v AC + w N, with B = R0, C = R1, N = AB x AC. Our derivation of the step to the next, A C D, where
// p = A + u' AC + v' AD + w' N' with N' = AC x AD: the origins agree, and AC is the first vector of the new basis. The other two are
//   AB = a AC + b AD + c N'     N = d AC + e AD + f N'
// and by Cramer's rule, over N'.N' = [AC AD N'],
//   a = (AB x AD).N'   b = (AC x AB).N'   c = AB.N'     d = (N x AD).N'   e = (AC x N).N'   f = N.N'
// Putting them into p gives u' = a u + v + d w, v' = b u + e w, w' = c u + f w: six numbers, 6 multiplications, 4 additions a vector.
// All that is asked of N is its direction. Its length is chosen as `Basis` says, so that u, v, w and the six are free of units.
//
// Counts. The source gives n divisions, 6 + 14 n multiplications, 7 + 11 n additions for a ray, that is a start and a direction; a segment
// first needs its direction, 3 additions more. We make up for them, and stay within the same counts, by z = u + v in two places, where
// 0 <= u <= z <= 1 needs no sum and only an answer the difference, 1 addition:
// - The first middle row reads z, not v; the next u' = (a - 1) u + z + d w costs what it did. Segment 3, three rows of start and direction
//   9 + 6, two values at the plane 2: 20 additions.
// - The last triangle is judged at the point where the line meets its plane, in the basis before it, by v' and z' = (a + b) u + v + (d + e) w:
//   2 additions for the heights, 3 for the point, 1 + 2 for v' and z' there: 8 in place of 11.
// One of these at most is the answer: 20 + 11 (n - 2) + 8 + 1 = 7 + 11 n. A fan of one triangle does both in the world's basis: direction 3,
// heights 3 + 2, point 3, u and z 6, the difference 1: 18. The direction is kept backwards, from - to, so that t = w(start) / w(direction)
// needs no sign.
#pragma once

#include <algorithm>
#include <cmath>
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

/// Of either side, by `sides`. The answer is the first hit along the segment, of equal fractions as computed that of the first triangle. The
/// errors of u, v, w are handed on from each triangle to the next, and grow where these are thin or nearly opposite to one another: for fans
/// of good triangles with up to ten members they stay within a few times those of `BaldwinWeber12`, with 64 it is some hundred times. `fans_of` has a limit for that.
struct TriangleFan {
    Sides sides = Sides::front;

    /// The affine map to the first triangle's basis.
    template <class Number>
    struct First {
        Plane<Number> u;
        Plane<Number> u_plus_v;
        Plane<Number> height;
    };
    /// From the basis of one triangle to that of the next. The first `a` of a fan is lowered by one, and
    /// in the last `a` and `d` are a + b and d + e, see above.
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

    /// What a fan can be computed with, as a power of two: 40 for float, 320 for double. See `Basis`.
    template <class Scalar>
    static constexpr int k_range = std::numeric_limits<Scalar>::max_exponent * 5 / 16;

    /// Whether there is a basis. There is if the longer of ab and ac is within 2^-40 .. 2^40 in float, 2^-320 .. 2^320 in double, and the double
    /// area, as computed, at least 2^-40 (2^-320) of its square; and none where the area is computed as zero, infinite or NaN.
    template <class Scalar>
    [[nodiscard]] static bool has_basis(const Vec3<Scalar>& a, const PointOf<Scalar>& b, const PointOf<Scalar>& c) {
        return basis_of<Scalar>(triple<Scalar>(b) - triple<Scalar>(a), triple<Scalar>(c) - triple<Scalar>(a)).has_value();
    }

    /// n triangles from n + 1 ring vertices. Throws `MeshError` when there is no triangle, or one without a basis, which breaks the chain, among
    /// several; `fans_of` makes no such fan. A single triangle without one gives zeros, which nothing hits.
    template <class Scalar>
    [[nodiscard]] Stored<Scalar> prepare(const Vec3<Scalar>& apex, std::span<const Vec3<Scalar>> ring) const {
        if (ring.size() < 2) throw MeshError("a fan needs at least one triangle");
        if (ring.size() == 2) return prepare<Scalar>(apex, ring[0], ring[1]);
        const Triple<Scalar> a = triple<Scalar>(apex);
        const std::size_t last = ring.size() - 2;
        Stored<Scalar> stored;
        stored.turns.reserve(last);
        std::optional<Basis<Scalar>> before;
        for (std::size_t k = 0; k <= last; ++k) {
            const auto basis = basis_of<Scalar>(triple<Scalar>(ring[k]) - a, triple<Scalar>(ring[k + 1]) - a);
            if (!basis) throw MeshError("fan triangle " + std::to_string(k) + " has no area, or one that can't be computed with");
            if (!before) stored.first = first_of(*basis, a);
            else stored.turns.push_back(turn_of(*before, *basis, k == last));
            before = basis;
        }
        stored.turns.front().a -= 1;
        return stored;
    }

    template <class Scalar>
    [[nodiscard]] Stored<Scalar> prepare(const Vec3<Scalar>& a, const PointOf<Scalar>& b, const PointOf<Scalar>& c) const {
        const Triple<Scalar> apex = triple<Scalar>(a);
        const auto basis = basis_of<Scalar>(triple<Scalar>(b) - apex, triple<Scalar>(c) - apex);
        return basis ? Stored<Scalar>{first_of(*basis, apex), {}} : Stored<Scalar>{};
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
    /// The start is in front or on the plane, and the end, whose height is w - back_w, behind it; from the back the same, mirrored.
    template <class Number>
    [[nodiscard]] bool passes(const Number& w, const Number& back_w) const {
        const bool down = w >= Number{} && w < back_w;
        const bool up = w <= Number{} && w > back_w;
        return sides == Sides::front ? down : sides == Sides::back ? up : down || up;
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
            if (new_u >= Number{} && new_v >= Number{} && new_u + new_v <= Number(1)) *this = {at, new_u, new_v, number, true};
        }
        void take_last(const Number& at, const Number& new_v, const Number& u_plus_v, std::size_t number) {
            if (new_v >= Number{} && u_plus_v >= new_v && u_plus_v <= Number(1)) *this = {at, u_plus_v - new_v, new_v, number, true};
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

    /// Two edges at the apex times the power of two that brings their largest component into 1 .. 2, and n = ab x ac there, so that
    /// n.n has no fourth power of a length. N is n in the world's units, n / scale.
    ///
    /// With R for `k_range`, which allows the exponents -R - 1 .. R: edges are at most 2 sqrt(3) < 2^1.8 long, n 2^3.6, and at least 2^-R. The
    /// edges and N of one basis are at most 2^(2 R + 1) times as large in the units of the next. So the largest of the six, d and e, are at most
    /// 2^(3.6 + 2 R + 1) 2^1.8 / 2^-R = 2^(3 R + 6.4), for float 2^126.4, and their numerators less; rows are at most 2^(R + 1) 2^1.8 / 2^-R.
    template <class Scalar>
    struct Basis {
        Triple<Scalar> ab;
        Triple<Scalar> ac;
        Triple<Scalar> n;
        Scalar square;
        Scalar scale;
    };

    template <class Scalar>
    static std::optional<Basis<Scalar>> basis_of(const Triple<Scalar>& ab, const Triple<Scalar>& ac) {
        const Scalar size = std::max(std::abs(ab[largest(ab)]), std::abs(ac[largest(ac)]));
        const int exponent = std::ilogb(size);  // of zero, infinity and NaN far out of range
        if (exponent < -k_range<Scalar> - 1 || exponent > k_range<Scalar>) return std::nullopt;
        const Scalar scale = std::scalbn(Scalar{1}, -exponent);
        Basis<Scalar> basis{scale * ab, scale * ac, {}, {}, scale};
        basis.n = cross(basis.ab, basis.ac);
        basis.square = dot(basis.n, basis.n);
        if (!(basis.square >= std::scalbn(Scalar{1}, -2 * k_range<Scalar>))) return std::nullopt;  // NaN too
        return basis;
    }

    // Rows of the inverse of (AB, AC, N): the cross products of the other two columns, over [AB AC N] = n.n / scale^3.
    template <class Scalar>
    static First<Scalar> first_of(const Basis<Scalar>& b, const Triple<Scalar>& a) {
        const Scalar inverse = 1 / b.square;
        const auto row = [&](const Triple<Scalar>& x) { return plane(b.scale * (inverse * x), a); };
        // u + v is 1 on BC: (AC x N + N x AB) = N x (AB - AC)
        return {row(cross(b.ac, b.n)), row(cross(b.n, b.ab - b.ac)), row(b.n)};
    }

    template <class Scalar>
    static Turn<Scalar> turn_of(const Basis<Scalar>& before, const Basis<Scalar>& basis, bool last) {
        const Scalar units = basis.scale / before.scale;
        const Triple<Scalar> ab = units * before.ab;
        const Triple<Scalar> normal = units * before.n;
        const Triple<Scalar>& ac = basis.ab;
        const Triple<Scalar>& ad = basis.ac;
        // a + b and d + e: (AB x AD + AC x AB) = AB x (AD - AC)
        const Triple<Scalar> other = last ? ad - ac : ad;
        const auto part = [&](const Triple<Scalar>& x) { return dot(x, basis.n) / basis.square; };
        return {part(cross(ab, other)), part(cross(ac, ab)), part(ab), part(cross(normal, other)), part(cross(ac, normal)), part(normal)};
    }
};

static_assert(sizeof(TriangleFan::First<float>) == 12 * sizeof(float) && sizeof(TriangleFan::Turn<float>) == 6 * sizeof(float));

inline constexpr TriangleFan triangle_fan{};

}  // namespace pierce::kernels
