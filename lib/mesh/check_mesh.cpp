// What a mesh must be before anything is built from it.
#include <mesh/check_mesh.h>

#include <cmath>
#include <limits>
#include <string>

namespace pierce::detail {

namespace {

constexpr std::size_t k_most = std::numeric_limits<std::uint32_t>::max() - 1;

}  // namespace

template <class Scalar>
void check_mesh(const MeshView<Scalar>& mesh) {
    if (mesh.positions.size() > k_most || mesh.triangles.size() > k_most)
        throw MeshError("a mesh can have at most 4294967294 vertices and as many triangles");
    if (!mesh.faces.empty() && mesh.faces.size() != mesh.triangles.size())
        throw MeshError("the mesh numbers " + std::to_string(mesh.faces.size()) + " faces, but has " +
                        std::to_string(mesh.triangles.size()) + " triangles");
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        for (int k = 0; k < 3; ++k)
            if (!std::isfinite(mesh.positions[v][k]))
                throw MeshError("vertex " + std::to_string(v) + ": its " + "xyz"[k] + " coordinate is not finite");
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (const std::uint32_t corner : mesh.triangles[i])
            if (corner >= mesh.positions.size())
                throw MeshError("face " + std::to_string(mesh.face_of(i)) + " (triangle " + std::to_string(i) +
                                "): corner " + std::to_string(corner) + " is out of range: there are " +
                                std::to_string(mesh.positions.size()) + " vertices");
}

template void check_mesh(const MeshView<float>&);
template void check_mesh(const MeshView<double>&);

}  // namespace pierce::detail
