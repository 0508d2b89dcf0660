// What a mesh must be before anything is built from it, and what is only counted.
#pragma once

#include <span>
#include <vector>

#include <pierce/mesh_view.h>
#include <point.h>

namespace pierce::detail {

/// Throws `MeshError` naming the first vertex that is not finite or face that names a vertex that does not exist.
template <class Scalar>
void check_mesh(const MeshView<Scalar>& mesh);

/// How many triangles have the same three corner positions as one before them, in any order and whatever their vertices are
/// called. Linear in time on average.
[[nodiscard]] std::size_t count_duplicates(std::span<const Point> positions, std::span<const IndexTriple> triangles);

}  // namespace pierce::detail
