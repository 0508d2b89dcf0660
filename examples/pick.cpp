// Picks a face of an OpenMesh mesh by a ray, as a click of the mouse does: its handle comes back, with the vertex that
// counts most there, and the vertex normals interpolated.
//   pick [MESH X Y Z DX DY DZ]      without arguments: a cube, from above
#include <cstdlib>
#include <iostream>
#include <string_view>

#include <pierce/openmesh.h>
#include <pierce/pierce.h>
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

namespace {

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
    VertexAttributes(OpenMesh::Attributes::Normal);
    FaceAttributes(OpenMesh::Attributes::Normal);
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

Mesh cube() {
    Mesh mesh;
    Mesh::VertexHandle corners[8];
    for (int k = 0; k < 8; ++k) corners[k] = mesh.add_vertex({k & 1 ? 1.0 : 0.0, k & 2 ? 1.0 : 0.0, k & 4 ? 1.0 : 0.0});
    constexpr int faces[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                  {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    for (const auto& face : faces) mesh.add_face(corners[face[0]], corners[face[1]], corners[face[2]]);
    return mesh;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 1 && argc != 8) {
        const bool asks_for_help = argc == 2 && std::string_view(argv[1]) == "--help";
        (asks_for_help ? std::cout : std::cerr)
            << "usage: pick [MESH X Y Z DX DY DZ]\n"
               "MESH: a file that OpenMesh reads; the ray goes from (X Y Z) into the direction (DX DY DZ).\n"
               "Without arguments: a cube, from above.\n";
        return asks_for_help ? 0 : 2;
    }
    Mesh mesh = cube();
    pierce::Ray<double> ray = {{0.25, 0.5, 3}, {0.1, 0.05, -1}};
    if (argc == 8) {
        if (!OpenMesh::IO::read_mesh(mesh, argv[1])) {
            std::cerr << "pick: " << argv[1] << " can't be read\n";
            return 2;
        }
        for (int k = 0; k < 6; ++k) {
            char* end = nullptr;
            (k < 3 ? ray.origin[k] : ray.direction[k - 3]) = std::strtod(argv[2 + k], &end);
            if (end == argv[2 + k] || *end != 0) {
                std::cerr << "pick: " << argv[2 + k] << " is no number\n";
                return 2;
            }
        }
    }
    mesh.update_normals();

    // Copies what it needs: the mesh may change or go away, and this one goes on answering for what it was.
    const pierce::CollisionMesh<double> queries(pierce::from_openmesh(mesh).view());
    const auto hit = queries.first_hit(ray);
    if (!hit) {
        std::cout << "nothing there\n";
        return 1;
    }

    const Mesh::FaceHandle face = mesh.face_handle(hit->face);
    // The weights belong to the corners in the order of fv_ccw_range.
    Mesh::VertexHandle nearest;
    Mesh::Normal normal(0, 0, 0);
    double most = -1;
    int k = 0;
    for (const auto vertex : mesh.fv_ccw_range(face)) {
        const double weight = hit->barycentric[k++];
        normal += mesh.normal(vertex) * weight;
        if (weight > most) {
            most = weight;
            nearest = vertex;
        }
    }
    std::cout << "face " << face.idx() << " at (" << hit->position << "), its corner of the largest weight: vertex "
              << nearest.idx() << "\nnormal of the face (" << mesh.normal(face) << "), interpolated ("
              << normal.normalized() << ")\n";
    return 0;
}
