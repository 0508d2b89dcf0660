// Floors, ramps and valleys to slide on, and ways to compare moves to the last bit.
#pragma once

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <pierce/response.h>
#include <support/expect_hit.h>
#include <support/meshes.h>
#include <Eigen/Geometry>

namespace pierce::test {

using V = Vec3<double>;
using Both = ::testing::Types<float, double>;

inline double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// Squares of `size` in the plane through `at` along the unit vectors `u` and `w`, each cut in two; the front is
/// towards u x w. Within it, corners are moved about by up to `shift` of a square.
template <class Scalar>
void add_floor(TriangleSoup<Scalar>& soup, const V& at, const V& u, const V& w, int count, double size,
               double shift = 0) {
    Random random(3);
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (int i = 0; i <= count; ++i)
        for (int k = 0; k <= count; ++k) {
            const bool inner = i > 0 && k > 0 && i < count && k < count;
            const double du = inner ? shift * random.between(-1, 1) : 0;
            const double dw = inner ? shift * random.between(-1, 1) : 0;
            soup.positions.push_back(V(at + (i + du) * size * u + (k + dw) * size * w).template cast<Scalar>());
        }
    const auto id = [&](int i, int k) { return first + static_cast<std::uint32_t>(i * (count + 1) + k); };
    for (int i = 0; i < count; ++i)
        for (int k = 0; k < count; ++k) {
            soup.triangles.push_back({id(i, k), id(i + 1, k), id(i + 1, k + 1)});
            soup.triangles.push_back({id(i, k), id(i + 1, k + 1), id(i, k + 1)});
        }
}

/// Twenty squares of 1 around `middle`.
template <class Scalar>
CollisionMesh<Scalar> floor_at(const V& middle, const V& up, double shift = 0.3) {
    TriangleSoup<Scalar> soup;
    const V u = up.unitOrthogonal();
    const V w = up.cross(u);
    add_floor<Scalar>(soup, middle - 10 * u - 10 * w, u, w, 20, 1, shift);
    return CollisionMesh<Scalar>(soup.view());
}

template <class Scalar>
constexpr double k_epsilon = static_cast<double>(std::numeric_limits<Scalar>::epsilon());

/// `steps` steps of `seconds` under gravity.
template <class Scalar, class Mover>
Move<Scalar> fall(const Vec3<Scalar>& from, const V& gravity, int steps, double seconds, Mover&& mover) {
    Move<Scalar> move{};
    move.position = from;
    move.velocity.setZero();
    for (int i = 0; i < steps; ++i)
        move = mover(move.position, Vec3<Scalar>(move.velocity + (gravity * seconds).template cast<Scalar>()),
                     static_cast<Scalar>(seconds));
    return move;
}

/// Either call, on a mesh or in a step; `given` without braces.
template <class On, class... Given>
auto move_either(bool bounces, const On& on, Given&&... given) {
    return bounces ? move_and_bounce(on, std::forward<Given>(given)...)
                   : move_and_slide(on, std::forward<Given>(given)...);
}
template <class On, class... Given>
std::size_t move_all_either(bool bounces, const On& on, Given&&... given) {
    return bounces ? moves_and_bounce(on, std::forward<Given>(given)...)
                   : moves_and_slide(on, std::forward<Given>(given)...);
}

template <class Scalar>
bool same_bits(const Vec3<Scalar>& x, const Vec3<Scalar>& y) {
    return same_bits(Coordinates<Scalar>(x), Coordinates<Scalar>(y));
}
template <class Scalar>
bool same_bits(const Move<Scalar>& x, const Move<Scalar>& y) {
    return same_bits(x.position, y.position) && same_bits(x.velocity, y.velocity) && same_bits(x.travel, y.travel) &&
           same_bits(x.remainder, y.remainder) && x.contacts == y.contacts && x.casts == y.casts && x.state == y.state;
}
template <class Scalar>
bool same_bits(const MoveContact<Scalar>& x, const MoveContact<Scalar>& y) {
    return same_bits(x.point, y.point) && same_bits(x.normal, y.normal) && bits(x.speed) == bits(y.speed) &&
           bits(x.seconds) == bits(y.seconds) && x.face == y.face && x.triangle == y.triangle && x.side == y.side;
}

}  // namespace pierce::test
