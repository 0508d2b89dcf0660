// OpenMesh triangle meshes: their faces for a `CollisionMesh`, the handles that a hit stands for, and a half-edge mesh
// made of a soup. Needs OpenMeshCore. Of a point type it uses only `vector_traits` and `[]`. Compiles with
// -fno-exceptions and -fno-rtti, but OpenMesh's own meshes (9.0) need both, exceptions and type information.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include <OpenMesh/Core/Mesh/Handles.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <OpenMesh/Core/Utils/vector_traits.hh>

#include <pierce/hit.h>
#include <pierce/mesh_view.h>
#include <pierce/triangle_soup.h>
#include <pierce/types.h>

namespace pierce {

/// What pierce works in for a type of mesh: float where that holds every coordinate the mesh can have (float itself and
/// integers of 8 or 16 bits), otherwise double.
template <class Mesh>
using OpenMeshScalar =
    std::conditional_t<std::numeric_limits<typename Mesh::Scalar>::digits <= std::numeric_limits<float>::digits, float,
                       double>;

/// The faces of a mesh that are not deleted, in the order of their handles; garbage need not have been collected.
///
/// Positions are numbered like the vertex handles; that of a deleted vertex is (0, 0, 0), whatever the mesh has there.
/// `faces` holds the numbers of the face handles; it is empty if no face is deleted, as they are the places in
/// `triangles` then. The corners a, b, c of a triangle are those that `fv_ccwiter` lists, from the face's own halfedge
/// on: in a face made by `add_face(u, v, w)`, and not changed since, u, v, w.
///
/// Throws `MeshError` when a coordinate is finite and not exactly a number of the scalar type (64-bit integers, long
/// double), naming the vertex; and when a face is not a triangle or has a deleted corner, naming the face.
template <class Mesh>
[[nodiscard]] TriangleSoup<OpenMeshScalar<Mesh>> from_openmesh(const Mesh& mesh);

/// What became of the triangles of a soup; numbers are places in `TriangleSoup::triangles`.
struct OpenMeshFaces {
    std::vector<std::uint32_t> triangles;  ///< for each face handle of the mesh, the triangle that it was made of
    std::vector<std::uint32_t> refused;    ///< triangles that a half-edge mesh can't hold: they are not in it
};

/// Fills an empty mesh. Vertex handles are numbered like the soup's positions, and faces keep the soup's order. Refused
/// are triangles that name a vertex twice and those that OpenMesh can't connect, such as the third on an edge, one that
/// runs along an edge in the same direction as its neighbour, or one at a vertex that its neighbours have closed.
///
/// Throws `MeshError`, with the mesh still empty, when an index is out of range or a coordinate is not exactly a number
/// of the mesh's type, naming the triangle or vertex; and when the mesh was not empty. OpenMesh's `omerr()`, which all
/// threads share, is silent in the meantime.
template <class Scalar, class Mesh>
[[nodiscard]] OpenMeshFaces to_openmesh(const TriangleSoup<Scalar>& soup, Mesh& mesh);

namespace openmesh_detail {

/// Whether `value` is in the range of `Integer`: otherwise a cast is undefined.
template <class Integer, class Real>
bool in_range(Real value) {
    using Limits = std::numeric_limits<Integer>;  // max() may not be a `Real`; the power of two above it is
    return value >= static_cast<Real>(Limits::lowest()) && value < std::ldexp(Real{1}, Limits::digits);
}

/// `value` as a `To`, if that is the same number. NaN and infinities stay what they are: `CollisionMesh` refuses them.
template <class To, class From>
std::optional<To> exactly(From value) {
    if constexpr (std::is_integral_v<To>)
        if (!in_range<To>(value)) return std::nullopt;
    const To result = static_cast<To>(value);
    if constexpr (std::is_integral_v<From>)
        if (!in_range<From>(result)) return std::nullopt;
    if (static_cast<From>(result) == value || value != value) return result;
    return std::nullopt;
}

template <class To, class From>
To exact_coordinate(From value, std::size_t vertex, char axis) {
    static_assert(std::is_arithmetic_v<To> && std::is_arithmetic_v<From>,
                  "pierce takes meshes whose coordinates are of a built-in floating-point or integer type");
    if (const std::optional<To> exact = exactly<To>(value)) return *exact;
    std::ostringstream text;
    text.precision(std::numeric_limits<From>::max_digits10);
    text << "vertex " << vertex << ": its " << axis << " coordinate, " << value << ", is not exactly representable in "
         << (std::is_same_v<To, double>  ? "double"
             : std::is_same_v<To, float> ? "float"
                                         : "the type of the mesh");
    throw_mesh_error(text.str());
}

template <class Mesh>
constexpr void require_triangle_mesh() {
    static_assert(Mesh::IsTriMesh, "pierce takes OpenMesh triangle meshes: make a TriMesh of a PolyMesh first");
    static_assert(static_cast<int>(OpenMesh::vector_traits<typename Mesh::Point>::size_) == 3,
                  "pierce takes meshes whose points have three coordinates");
}

template <class Mesh, class Handle>
bool is_deleted(const Mesh& mesh, Handle handle) {
    constexpr bool is_face = std::is_same_v<Handle, OpenMesh::FaceHandle>;
    return (is_face ? mesh.has_face_status() : mesh.has_vertex_status()) && mesh.status(handle).deleted();
}

/// From corner k to corner k+1. `fv_ccwiter` lists what halfedges lead to, so the face's own one leads from c to a.
template <class Mesh>
std::array<OpenMesh::HalfedgeHandle, 3> halfedges(const Mesh& mesh, OpenMesh::FaceHandle face) {
    const OpenMesh::HalfedgeHandle ca = mesh.halfedge_handle(face);
    const OpenMesh::HalfedgeHandle ab = mesh.next_halfedge_handle(ca);
    return {ab, mesh.next_halfedge_handle(ab), ca};
}

/// A face of a mesh that was resized and not filled in, or whose halfedges were set by hand, may not be one.
template <class Mesh>
bool is_triangle(const Mesh& mesh, OpenMesh::FaceHandle face) {
    OpenMesh::HalfedgeHandle halfedge = mesh.halfedge_handle(face);
    for (int k = 0; k < 3 && halfedge.is_valid(); ++k) halfedge = mesh.next_halfedge_handle(halfedge);
    return halfedge.is_valid() && halfedge == mesh.halfedge_handle(face);
}

template <class Mesh>
std::array<OpenMesh::VertexHandle, 3> corners(const Mesh& mesh, OpenMesh::FaceHandle face) {
    const auto [ab, bc, ca] = halfedges(mesh, face);
    return {mesh.to_vertex_handle(ca), mesh.to_vertex_handle(ab), mesh.to_vertex_handle(bc)};
}

/// `omerr()` switched off for a scope; what was written to it before still comes out.
class SilentErrors {
  public:
    SilentErrors() {
        omerr().flush();
        omerr().disable();
    }
    ~SilentErrors() {
        omerr().flush();
        if (was_enabled_) omerr().enable();
    }
    SilentErrors(const SilentErrors&) = delete;

  private:
    bool was_enabled_ = omerr().is_enabled();
};

}  // namespace openmesh_detail

// The handles that a hit stands for.

/// The face that was hit. Here and below the mesh is the one that was given to `from_openmesh`, its connectivity
/// unchanged.
template <class Scalar>
[[nodiscard]] OpenMesh::FaceHandle face_handle(const Hit<Scalar>& hit) {
    return OpenMesh::FaceHandle(static_cast<int>(hit.face));
}

/// The corners a, b, c of the face that was hit.
template <class Mesh, class Scalar>
[[nodiscard]] std::array<OpenMesh::VertexHandle, 3> corner_handles(const Mesh& mesh, const Hit<Scalar>& hit) {
    return openmesh_detail::corners(mesh, face_handle(hit));
}

/// Of a hit on an edge, the halfedge of the face that was hit; else a handle that is not valid.
template <class Mesh, class Scalar>
[[nodiscard]] OpenMesh::HalfedgeHandle halfedge_handle(const Mesh& mesh, const Hit<Scalar>& hit) {
    return hit.feature == Feature::edge ? openmesh_detail::halfedges(mesh, face_handle(hit))[hit.feature_index]
                                        : OpenMesh::HalfedgeHandle();
}

/// Of a hit on an edge, that edge; else a handle that is not valid.
template <class Mesh, class Scalar>
[[nodiscard]] OpenMesh::EdgeHandle edge_handle(const Mesh& mesh, const Hit<Scalar>& hit) {
    return hit.feature == Feature::edge ? mesh.edge_handle(halfedge_handle(mesh, hit)) : OpenMesh::EdgeHandle();
}

/// Of a hit at a corner, that vertex; else a handle that is not valid.
template <class Mesh, class Scalar>
[[nodiscard]] OpenMesh::VertexHandle vertex_handle(const Mesh& mesh, const Hit<Scalar>& hit) {
    return hit.feature == Feature::vertex ? corner_handles(mesh, hit)[hit.feature_index] : OpenMesh::VertexHandle();
}

template <class Mesh>
TriangleSoup<OpenMeshScalar<Mesh>> from_openmesh(const Mesh& mesh) {
    openmesh_detail::require_triangle_mesh<Mesh>();
    using Scalar = OpenMeshScalar<Mesh>;
    TriangleSoup<Scalar> soup;
    soup.positions.assign(mesh.n_vertices(), Vec3<Scalar>::Zero());
    for (std::size_t i = 0; i < soup.positions.size(); ++i) {
        const OpenMesh::VertexHandle vertex(static_cast<int>(i));
        if (openmesh_detail::is_deleted(mesh, vertex)) continue;
        const auto& point = mesh.point(vertex);
        using openmesh_detail::exact_coordinate;
        soup.positions[i] = {exact_coordinate<Scalar>(point[0], i, 'x'), exact_coordinate<Scalar>(point[1], i, 'y'),
                             exact_coordinate<Scalar>(point[2], i, 'z')};
    }

    soup.triangles.reserve(mesh.n_faces());
    soup.faces.reserve(mesh.n_faces());
    for (std::size_t i = 0; i < mesh.n_faces(); ++i) {
        const OpenMesh::FaceHandle face(static_cast<int>(i));
        if (openmesh_detail::is_deleted(mesh, face)) continue;
        if (!openmesh_detail::is_triangle(mesh, face))
            throw_mesh_error("face " + std::to_string(i) + " is not a triangle");
        IndexTriple triple{};
        for (std::size_t k = 0; const OpenMesh::VertexHandle corner : openmesh_detail::corners(mesh, face)) {
            triple[k++] = static_cast<std::uint32_t>(corner.idx());
            if (openmesh_detail::is_deleted(mesh, corner))
                throw_mesh_error("face " + std::to_string(i) + ": its vertex " + std::to_string(corner.idx()) +
                                 " is deleted");
        }
        soup.triangles.push_back(triple);
        soup.faces.push_back(static_cast<std::uint32_t>(i));
    }
    if (soup.triangles.size() == mesh.n_faces()) soup.faces = {};
    return soup;
}

template <class Scalar, class Mesh>
OpenMeshFaces to_openmesh(const TriangleSoup<Scalar>& soup, Mesh& mesh) {
    openmesh_detail::require_triangle_mesh<Mesh>();
    if (mesh.n_vertices() != 0) throw_mesh_error("the mesh to be filled is not empty");
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        for (const std::uint32_t index : soup.triangles[t]) {
            if (index >= soup.positions.size())
                throw_mesh_error("triangle " + std::to_string(t) + ": vertex index " + std::to_string(index) +
                                 " is out of range (" + std::to_string(soup.positions.size()) + " vertices)");
        }
    }
    using Coordinate = typename Mesh::Scalar;
    std::vector<typename Mesh::Point> points(soup.positions.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3<Scalar>& position = soup.positions[i];
        points[i][0] = openmesh_detail::exact_coordinate<Coordinate>(position[0], i, 'x');
        points[i][1] = openmesh_detail::exact_coordinate<Coordinate>(position[1], i, 'y');
        points[i][2] = openmesh_detail::exact_coordinate<Coordinate>(position[2], i, 'z');
    }

    mesh.reserve(points.size(), points.size() + soup.triangles.size(), soup.triangles.size());
    for (const auto& point : points) mesh.add_vertex(point);
    OpenMeshFaces result;
    result.triangles.reserve(soup.triangles.size());
    const openmesh_detail::SilentErrors silence;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        const auto [u, v, w] = soup.triangles[t];
        const auto handle = [](std::uint32_t index) { return OpenMesh::VertexHandle(static_cast<int>(index)); };
        const bool is_added = u != v && v != w && w != u &&  // OpenMesh would make a loop of an edge
                              mesh.add_face(handle(u), handle(v), handle(w)).is_valid();
        (is_added ? result.triangles : result.refused).push_back(static_cast<std::uint32_t>(t));
    }
    return result;
}

}  // namespace pierce
