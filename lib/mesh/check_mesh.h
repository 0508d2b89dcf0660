// What a mesh must be before anything is built from it.
#pragma once

#include <pierce/executor.h>
#include <pierce/mesh_view.h>

namespace pierce::detail {

/// Throws `MeshError` naming the first vertex that is not finite or face that names a vertex that does not exist.
template <class Scalar>
void check_mesh(const MeshView<Scalar>& mesh, const Executor& executor);

}  // namespace pierce::detail
