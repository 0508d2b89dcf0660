// A ray: a point, a direction, and how far.
#pragma once

#include <limits>

#include <pierce/types.h>

namespace pierce {

/// All points `origin + t * direction` with t from 0 to `limit`, taken as the exact real numbers that they are: no
/// direction is normalised, and no end is computed and rounded. So it is not the segment from `origin` to `origin +
/// limit * direction` as a program computes it, but decided by the same rules: what counts is whether the true end lies
/// strictly behind the face's plane; a ray that ends on a face has not hit it yet (`Hit`).
///
/// One exception: where it is 2^1022 or more from the origin to the far side of the mesh along an axis, the ray ends
/// where numbers do, and what lies behind that is not hit.
///
/// `limit` may be infinite, as it is where it is left out. A direction of length zero and a limit of 0 hit nothing. A
/// coordinate that is not finite, and a limit that is negative or NaN, make the ray invalid: it has no hit, and
/// `MeshStatistics::invalid_queries` counts it.
template <class Scalar>
struct Ray {
    Vec3<Scalar> origin;     ///< where it begins
    Vec3<Scalar> direction;  ///< of any length but 0
    /// the largest t: a length only where `direction` has length 1
    Scalar limit = std::numeric_limits<Scalar>::infinity();
};

template <class Scalar>
Ray(Vec3<Scalar>, Vec3<Scalar>) -> Ray<Scalar>;
template <class Scalar>
Ray(Vec3<Scalar>, Vec3<Scalar>, Scalar) -> Ray<Scalar>;

}  // namespace pierce
