// The words that everything else is said in: points, segments, and which side of a triangle counts.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include <Eigen/Core>

#include <pierce/sides.h>

namespace pierce {

/// A point or vector. `Scalar` is float or double throughout the library.
template <class Scalar>
using Vec3 = Eigen::Matrix<Scalar, 3, 1>;

/// The path of a point over one step, or a line of sight: every point `from + s (to - from)` with s in [0, 1].
/// The ends are taken as the exact numbers that they are; no direction is normalised and no length is computed.
template <class Scalar>
struct Segment {
    Vec3<Scalar> from;  ///< where the way begins, in the units of the mesh
    Vec3<Scalar> to;    ///< where it ends
};

template <class Scalar>
Segment(Vec3<Scalar>, Vec3<Scalar>) -> Segment<Scalar>;

/// The three corners of a triangle as indices of positions, counter-clockwise seen from its front.
using IndexTriple = std::array<std::uint32_t, 3>;

/// Whether pierce works in this type: float and double.
template <class Scalar>
inline constexpr bool is_scalar_v = std::is_same_v<Scalar, float> || std::is_same_v<Scalar, double>;

}  // namespace pierce
