// A triangle mesh that somebody else owns: the only kind of mesh that the core knows.
#pragma once

#include <cstdint>
#include <span>

#include <pierce/mesh_error.h>
#include <pierce/types.h>

namespace pierce {

/// Positions and index triples, not owned. It has to stay alive only while a `CollisionMesh` is built from it.
///
/// The mesh may be open, non-manifold, self-intersecting, and may hold zero-area or duplicate triangles: all are kept.
/// `faces`, if it is not empty, gives for each triangle the number that the caller knows it by (the polygon of a file
/// that it was cut from, the handle of a half-edge mesh with holes in its numbering); several triangles may share one.
/// If it is empty, a triangle's number is its place in `triangles`.
template <class Scalar>
struct MeshView {
    static_assert(is_scalar_v<Scalar>, "pierce works in float or double");

    std::span<const Vec3<Scalar>> positions;
    std::span<const IndexTriple> triangles;
    std::span<const std::uint32_t> faces = {};

    [[nodiscard]] std::uint32_t face_of(std::size_t triangle) const {
        return faces.empty() ? static_cast<std::uint32_t>(triangle) : faces[triangle];
    }
};

}  // namespace pierce
