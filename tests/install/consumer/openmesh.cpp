// The same as core.cpp, with the face handle of an OpenMesh mesh.
#include <cstdio>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <pierce/openmesh.h>
#include <pierce/pierce.h>

int main() {
    OpenMesh::TriMesh_ArrayKernelT<> mesh;
    const auto a = mesh.add_vertex({0, 0, 0});
    const auto b = mesh.add_vertex({1, 0, 0});
    const auto c = mesh.add_vertex({0, 1, 0});
    const auto face = mesh.add_face(a, b, c);
    const pierce::CollisionMesh<float> prepared(pierce::from_openmesh(mesh).view());
    const auto hit = prepared.first_hit({pierce::Vec3<float>{0.25F, 0.25F, 1}, pierce::Vec3<float>{0.25F, 0.25F, -1}});
    if (!hit || pierce::face_handle(*hit) != face) {
        std::puts("no hit, or a wrong one");
        return 1;
    }
    return 0;
}
