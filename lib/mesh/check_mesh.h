// What a mesh must be before anything is built from it.
#pragma once

#include <pierce/executor.h>
#include <plain_mesh.h>

namespace pierce::detail {

/// Throws `MeshError` naming the first vertex that is not finite or face that names a vertex that does not exist.
template <class Scalar>
void check_mesh(const PlainMesh<Scalar>& mesh, const Executor& executor);

/// The part of it that new positions need.
template <class Scalar>
void check_positions(std::span<const Vec3<Scalar>> positions, const Executor& executor);
template <class Scalar>
void check_position(std::size_t vertex, const Vec3<Scalar>& position);

}  // namespace pierce::detail
