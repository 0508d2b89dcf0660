// The curve that a point goes along in the coordinates of a mesh that turns, its chords, and how far they are off.
//
// R0 and R1 are the rotations at the start and at the end, Q = R0^T R1 the turn as the mesh sees it, about a unit axis
// u by an angle a in [0, pi]; Q(t) by t a. The pivot c goes straight in the world. A world point at a distance d(t)
// from it, linear in t, is in the mesh at
//
//     q(t) = c + Q(t)^T e(t),   e(t) = R0^T d(t) = e0 + t (e1 - e0),   e0 = q(0) - c,   e1 = Q (q(1) - c)
//
// so the curve is given by its two ends in the mesh, q(0) and q(1), which are the images of the ends of the way.
//
// How far a chord is off. q'' = Q(t)^T (-a^2 e + 2 a e' x u), with e and e' perpendicular to u: |q''| <= a^2 r + 2 a v
// with r = max(|e0|, |e1|) and v = |e1 - e0| there. The chord over a part h of the time is at each time within h^2 / 8
// times that of q.
//
// Rounding (u here is 2^-53, D = the length of e0 plus that of c, or of e1, whichever is more; first order).
//   - Images at the ends: placement.h, 2^-46.7 |p - t| for double, 2^-23.2 |p - t| for float, and |p - t| <= D.
//   - Q: an entry of R0^T R1 is off by 2 * 40 u for R and 3 u for its sums; a component of the quaternion by 2^-45
//     (four such entries over at least 2, a square root, a normalisation), the rotation by twice that. Half of a
//     rotation halves its error and adds 6 u. A product of k of them is off by their sum and 5 u each: at most
//     2^-44 + 24 * 11 u. Where the curve ends it is right by construction: e1 is made with Q.
//   - turned_back: two cross products and a sum, 12 u |e|; e and the sum with c: 4 u D more. Rounded to float 2^-24 |q|
//     in each coordinate, 2^-23.2 |q| together.
// All of it is below 2^-42.5 D for double and 2^-22 D for float; `rounding` has 2^-42 and 2^-21, and half of the
// tolerance that is stated as the least for it.
#pragma once

#include <array>

#include <rigid/placement.h>
#include <rigid/quaternion.h>

namespace pierce::detail {

/// (a^2 r + 2 a v) / 8 <= 2.9 D, and the tolerance left is at least 2^-42 D: 22 levels are enough.
constexpr int k_levels = 23;

struct Turn {
    Placement before;
    Placement after;
    Point pivot{};
    double tolerance = 0;
    /// Entry k: the turn divided by 2^k, as the mesh sees it.
    std::array<Quaternion, k_levels + 1> part;
    double angle = 0;  ///< from above
};

/// `before`, `after`, `pivot` and `tolerance` are set.
[[gnu::noinline]] void set_parts(Turn& turn);

/// Q(time), to 2^-36 or so: for what is not certified.
[[nodiscard]] Quaternion part_at(const Turn& turn, double time);

/// Where a point x of the mesh is in the world at that time.
[[nodiscard]] Point out_at(const Turn& turn, const Point& x, double time);
/// A direction.
[[nodiscard]] Point turned_at(const Turn& turn, const Point& x, double time);

struct Curve {
    std::array<Point, 2> end;   ///< q(0), q(1)
    std::array<Point, 2> from;  ///< e0, e1
    int level = 0;              ///< 2^level chords
    double bend = 0;            ///< what one chord for all may be off by, from above
    double rounding = 0;

    /// Between numbers of `Scalar`. Not finite: nothing is promised, and `rounding` is not finite.
    template <class Scalar>
    [[nodiscard]] static Curve between(const Turn& turn, const Point& start, const Point& end);

    /// q at a time, where `q` is Q there, rounded to `Scalar`.
    template <class Scalar>
    [[nodiscard]] Point at(const Turn& turn, double time, const Quaternion& q) const {
        Point e{};
        for (std::size_t k = 0; k < 3; ++k) e[k] = from[0][k] + time * (from[1][k] - from[0][k]);
        Point x = turned_back(q, e);
        for (std::size_t k = 0; k < 3; ++k) x[k] += turn.pivot[k];
        return rounded_image<Scalar>(x);
    }
};

}  // namespace pierce::detail
