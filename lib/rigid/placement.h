// Where a mesh stands in a world: the local image of a point, by one fixed formula, how far it may be off, and a box.
//
// R is the rotation as it is kept, in double; Q the rotation nearest to it (its polar factor). u = 2^-53.
//
// How near R is to Q. A Newton step X (3 I - X^T X) / 2 takes X^T X = I + E to E' = -3/4 E^2 - 1/4 E^3, in exact
// arithmetic, and keeps Q (Higham 1986, "Computing the polar decomposition", with the inverse left out). |E| <= 3 2^-14
// is accepted, so three steps take it below 2^-24, 2^-48, 2^-90. Rounded, a step is off by its own operations alone: an
// entry of X^T X is three products and two sums of numbers with sum of squares about 1, off by 4 u; 3 - that, halved,
// by 3 u more, and only half of E; times X again three products and two sums, 4 u. Together below 12 u an entry, 36 u
// in norm. So |R - Q| <= 40 u.
//
// The image. d = p - t is off by u |d| in each coordinate, R^T d by 40 u |d| for R and by 3 u |d| for its products and
// sums (Cauchy). Rounded to float, by 2^-24 of itself more. With |d| the length:
//   each coordinate of the image is within (44 u + (float: 2^-24)) |p - t| of that of Q^T (p - t), in first order,
//   the image within sqrt(3) times that: 2^-46.7 |p - t| for double, 2^-23.2 |p - t| for float.
// For R = I and those that only swap axes and signs, products and sums are exact: what is left is one rounding of d (of
// float a second one, to float). Below the normal numbers add 2^-149 or 2^-1074.
//
// A ray's direction is turned only: the same without d.
//
// What that asks of boxes (`k_image_slack`, `box_of`): where the local way at fraction f is in the mesh's box, the
// world's way at f is within the above, of its ends, of the box turned and moved: of the one end and the other in
// proportion, so of the farther one. |p - t| <= sqrt(3) (P + T) with P and T the largest |coordinate| of an end (of a
// ray, of its origin plus that of its way) and of t: 2^-45.9 (P + T) for double, 2^-22.4 (P + T) for float. Allowed
// are 2^-45 and 2^-21.
#pragma once

#include <pierce/pose.h>
#include <point.h>
#include <query/scene.h>

namespace pierce::detail {

/// How far a mesh is from where it was built.
enum class Stand : std::uint8_t {
    still,   ///< not at all
    moved,   ///< by a vector
    turned,  ///< and turned
};

struct Placement {
    std::array<Point, 3> rotation{Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}};  ///< rows
    Point translation{};
    Stand stand = Stand::still;
};

/// Throws std::invalid_argument where a pose is none.
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] Placement make_placement(const Pose<Scalar>& pose);

/// Of what a coordinate of the image may be off, in the largest |coordinate| of a way's ends and of the translation.
template <class Scalar>
inline constexpr double k_image_slack = sizeof(Scalar) == sizeof(float) ? 0x1p-21 : 0x1p-45;

[[nodiscard]] inline Point turned_back(const Placement& placement, const Point& d) {
    const std::array<Point, 3>& r = placement.rotation;
    Point image{};
    for (std::size_t k = 0; k < 3; ++k) image[k] = (r[0][k] * d[0] + r[1][k] * d[1]) + r[2][k] * d[2];
    return image;
}
[[nodiscard]] inline Point turned(const Placement& placement, const Point& x) {
    const std::array<Point, 3>& r = placement.rotation;
    Point out{};
    for (std::size_t k = 0; k < 3; ++k) out[k] = (r[k][0] * x[0] + r[k][1] * x[1]) + r[k][2] * x[2];
    return out;
}

template <class Scalar>
[[nodiscard]] Point rounded_image(const Point& x) {
    const auto rounded = [](double y) { return static_cast<double>(static_cast<Scalar>(y)); };
    return {rounded(x[0]), rounded(x[1]), rounded(x[2])};
}

/// The image of a point in the mesh, rounded to `Scalar`; it may not be finite.
template <class Scalar>
[[nodiscard]] Point image_of(const Placement& placement, const Point& p) {
    if (placement.stand == Stand::still) return p;
    Point d{};
    for (std::size_t k = 0; k < 3; ++k) d[k] = p[k] - placement.translation[k];
    return rounded_image<Scalar>(placement.stand == Stand::turned ? turned_back(placement, d) : d);
}

/// That of a direction.
template <class Scalar>
[[nodiscard]] Point direction_of(const Placement& placement, const Point& d) {
    return placement.stand == Stand::turned ? rounded_image<Scalar>(turned_back(placement, d)) : d;
}

/// Where a point of the mesh is in the world, within the same bounds but for |x| in place of |p - t|, and one rounding
/// of the sum; not rounded to `Scalar`.
[[nodiscard]] inline Point out_of(const Placement& placement, const Point& x) {
    if (placement.stand == Stand::still) return x;
    Point p = placement.stand == Stand::turned ? turned(placement, x) : x;
    for (std::size_t k = 0; k < 3; ++k) p[k] += placement.translation[k];
    return p;
}

// For the façade, behind a call that is not inlined.
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] Vec3<Scalar> to_mesh(const Placement& placement, const Vec3<Scalar>& point);
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] Vec3<Scalar> to_world(const Placement& placement, const Vec3<Scalar>& point);

template <class Scalar>
[[nodiscard]] Vec3<Scalar> to_vector(const Point& p) {
    return {static_cast<Scalar>(p[0]), static_cast<Scalar>(p[1]), static_cast<Scalar>(p[2])};
}

/// A box in the world that holds Q x + t for all x of `bounds`; infinite where numbers end.
[[nodiscard]] [[gnu::noinline]] Box box_of(const Placement& placement, const Box& bounds);

}  // namespace pierce::detail
