// What is behind a mesh and a step, for the rooms that stand on the queries.
#pragma once

#include <query/collision_mesh_impl.h>
#include <query/deformation_step_impl.h>

namespace pierce::detail {

struct Inside {
    template <class Scalar>
    [[nodiscard]] static const typename CollisionMesh<Scalar>::Impl& of(const CollisionMesh<Scalar>& mesh) {
        return *mesh.impl_;
    }
    /// Null: it has no triangles.
    template <class Scalar>
    [[nodiscard]] static const typename DeformationStep<Scalar>::Impl* of(const DeformationStep<Scalar>& step) {
        return step.impl_.get();
    }
};

}  // namespace pierce::detail
