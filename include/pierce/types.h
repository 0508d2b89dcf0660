// The words that everything else is said in: points, segments, and which side of a triangle counts.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include <Eigen/Core>

namespace pierce {

/// A point or vector. `Scalar` is float or double throughout the library.
template <class Scalar>
using Vec3 = Eigen::Matrix<Scalar, 3, 1>;

/// The path of a point over one step, or a line of sight: every point `from + s (to - from)` with s in [0, 1].
/// The ends are taken as the exact numbers that they are; no direction is normalised and no length is computed.
template <class Scalar>
struct Segment {
    Vec3<Scalar> from;
    Vec3<Scalar> to;
};

template <class Scalar>
Segment(Vec3<Scalar>, Vec3<Scalar>) -> Segment<Scalar>;

/// The three corners of a triangle as indices of positions, counter-clockwise seen from its front.
using IndexTriple = std::array<std::uint32_t, 3>;

/// Which side of a triangle a segment may come from. A query takes any of the three; a hit is `front` or `back`.
///
/// `front`: from in front of the plane or on it, to strictly behind. `back` is the same mirrored: from behind or on the
/// plane, to strictly in front. `both` is a change of side, where on the plane counts as in front: as `front`, or from
/// strictly behind to in front or onto the plane. So a point on the plane can leave it to the front, and a chain of
/// steps passes unseen in neither direction.
enum class Sides : std::uint8_t { front, back, both };

/// What a hit lies on, decided exactly: the open face, an open edge, or a corner.
enum class Feature : std::uint8_t { face, edge, vertex };

template <class Scalar>
inline constexpr bool is_scalar_v = std::is_same_v<Scalar, float> || std::is_same_v<Scalar, double>;

}  // namespace pierce
