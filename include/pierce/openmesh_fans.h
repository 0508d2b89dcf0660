// Fans of an OpenMesh mesh, for `kernels::triangle_fan`: the one-ring of a vertex, and the whole mesh. Header only;
// needs OpenMeshCore.
#pragma once

#include <pierce/fans.h>
#include <pierce/openmesh.h>

namespace pierce {

/// The triangles around a vertex, counter-clockwise seen from their front: one closed fan inside the mesh, an open one
/// on its border, and several where sheets meet in the vertex (OpenMesh's half-edges list these one after the other);
/// none for a vertex without faces. The numbers are those of vertex and face handles. However many there are: see
/// `k_most_in_fan` for what that costs. O(valence).
template <class Mesh>
[[nodiscard]] std::vector<Fan> one_ring(const Mesh& mesh, OpenMesh::VertexHandle vertex) {
    openmesh_detail::require_triangle_mesh<Mesh>();
    const auto apex = static_cast<std::uint32_t>(vertex.idx());
    std::vector<fans_detail::Wedge> wedges;
    for (const OpenMesh::HalfedgeHandle out : mesh.voh_range(vertex)) {
        const OpenMesh::FaceHandle face = mesh.face_handle(out);
        if (!face.is_valid()) continue;
        const OpenMesh::VertexHandle first = mesh.to_vertex_handle(out);
        const OpenMesh::VertexHandle second = mesh.to_vertex_handle(mesh.next_halfedge_handle(out));
        wedges.push_back({static_cast<std::uint32_t>(first.idx()), static_cast<std::uint32_t>(second.idx()),
                          static_cast<std::uint32_t>(face.idx())});
    }
    std::vector<Fan> fans;
    fans_detail::chain(apex, wedges, fans);
    return fans;
}

/// The stored form of a fan of `mesh`. Throws as `TriangleFan::prepare` and `from_openmesh` do.
template <class Mesh>
[[nodiscard]] kernels::TriangleFan::Stored<OpenMeshScalar<Mesh>> prepare(const Mesh& mesh, const Fan& fan) {
    using Scalar = OpenMeshScalar<Mesh>;
    const auto position = [&mesh](std::uint32_t v) {
        const auto& point = mesh.point(OpenMesh::VertexHandle(static_cast<int>(v)));
        using openmesh_detail::exact_coordinate;
        return Vec3<Scalar>(exact_coordinate<Scalar>(point[0], v, 'x'), exact_coordinate<Scalar>(point[1], v, 'y'),
                            exact_coordinate<Scalar>(point[2], v, 'z'));
    };
    std::vector<Vec3<Scalar>> ring;
    for (const std::uint32_t v : fan.ring) ring.push_back(position(v));
    return kernels::triangle_fan.prepare<Scalar>(position(fan.apex), ring);
}

/// A decomposition of the faces that are not deleted: `Fan::triangles` holds the numbers of face handles. As `fans_of`
/// for a `MeshView`.
template <class Mesh>
[[nodiscard]] std::vector<Fan> fans_of_openmesh(const Mesh& mesh, std::size_t most = k_most_in_fan) {
    const auto soup = from_openmesh(mesh);
    std::vector<Fan> fans = fans_of(soup.view(), most);
    if (!soup.faces.empty())
        for (Fan& fan : fans)
            for (std::uint32_t& triangle : fan.triangles) triangle = soup.faces[triangle];
    return fans;
}

}  // namespace pierce
