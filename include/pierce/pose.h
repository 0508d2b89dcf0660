// Where a mesh stands: turned, then moved.
#pragma once

#include <pierce/types.h>

namespace pierce {

/// A point x of the mesh is at `rotation * x + translation` in the world. Of an Eigen isometry: `{m.linear(),
/// m.translation()}`; of a unit quaternion: `{q.toRotationMatrix(), t}`.
///
/// In a `World` the rotation may be off by rounding, or by drift: the nearest true rotation is taken for it (Newton's
/// iteration for the polar decomposition, in double). It is an error there where an entry of its transpose times itself
/// is further than 2^-14 from the identity's, where it mirrors, and where a number is not finite. A `DeformingMesh`
/// takes any matrix as it is.
template <class Scalar>
struct Pose {
    /// orthogonal, of determinant 1, but for what is said above
    Eigen::Matrix<Scalar, 3, 3> rotation = Eigen::Matrix<Scalar, 3, 3>::Identity();
    Vec3<Scalar> translation = Vec3<Scalar>::Zero();  ///< in units of the world
};

}  // namespace pierce
