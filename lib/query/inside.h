// The scene behind a mesh, for the rooms that stand on the queries.
#pragma once

#include <query/collision_mesh_impl.h>

namespace pierce::detail {

struct Inside {
    template <class Scalar>
    [[nodiscard]] static const typename CollisionMesh<Scalar>::Impl& of(const CollisionMesh<Scalar>& mesh) {
        return *mesh.impl_;
    }
};

}  // namespace pierce::detail
