// Fans of OpenMesh meshes: one-rings, closed and open, and whole meshes with deleted faces.
#include <gtest/gtest.h>

#include <openmesh/meshes.h>
#include <pierce/openmesh_fans.h>
#include <support/meshes.h>

namespace pierce::test {
namespace {

using Mesh = MeshOf<OpenMesh::Vec3d>;

Mesh mesh_of(const TriangleSoup<double>& soup) {
    Mesh mesh;
    const OpenMeshFaces faces = to_openmesh(soup, mesh);
    EXPECT_TRUE(faces.refused.empty());
    return mesh;
}

TEST(OpenMeshFans, AOneRingIsOneClosedFanInsideAndOneOpenFanOnTheBorder) {
    const Mesh mesh = mesh_of(terrain(6, 0.2, 1));
    for (const auto vertex : mesh.vertices()) {
        const std::vector<Fan> fans = one_ring(mesh, vertex);
        ASSERT_EQ(fans.size(), 1U);
        const Fan& fan = fans[0];
        EXPECT_EQ(fan.closed(), !mesh.is_boundary(vertex));
        EXPECT_EQ(fan.apex, static_cast<std::uint32_t>(vertex.idx()));
        std::set<std::uint32_t> faces(fan.triangles.begin(), fan.triangles.end());
        EXPECT_EQ(faces.size(), fan.triangles.size());
        EXPECT_EQ(faces.size(), mesh.valence(vertex) - (mesh.is_boundary(vertex) ? 1U : 0U));
        const auto stored = prepare(mesh, fan);
        EXPECT_EQ(stored.triangles(), fan.triangles.size());
        // A triangle's middle is hit from above, on that triangle.
        for (std::size_t k = 0; k < fan.triangles.size(); ++k) {
            Vec3<double> middle = Vec3<double>::Zero();
            for (const auto corner : mesh.fv_range(OpenMesh::FaceHandle(static_cast<int>(fan.triangles[k]))))
                for (int axis = 0; axis < 3; ++axis)
                    middle[axis] += mesh.point(corner)[static_cast<std::size_t>(axis)] / 3;
            const auto hit =
                kernels::triangle_fan.test(stored, middle + Vec3<double>(0, 0, 1), middle - Vec3<double>(0, 0, 1));
            ASSERT_TRUE(hit);
            EXPECT_EQ(hit->triangle, k);
            EXPECT_NEAR(hit->u, 1.0 / 3, 1e-12);
            EXPECT_NEAR(hit->v, 1.0 / 3, 1e-12);
        }
    }
}

TEST(OpenMeshFans, AVertexWithoutFacesHasNone) {
    Mesh mesh;
    EXPECT_TRUE(one_ring(mesh, mesh.add_vertex({0, 0, 0})).empty());
}

TEST(OpenMeshFans, CoverEachFaceThatIsNotDeletedOnce) {
    Mesh mesh = mesh_of(bumpy_sphere(6));
    mesh.request_face_status();
    mesh.request_edge_status();
    mesh.request_vertex_status();
    for (int face = 0; face < static_cast<int>(mesh.n_faces()); face += 7)
        mesh.delete_face(OpenMesh::FaceHandle(face), false);
    std::vector<int> covered(mesh.n_faces());
    for (const Fan& fan : fans_of_openmesh(mesh)) {
        for (const std::uint32_t face : fan.triangles) ++covered[face];
        EXPECT_EQ(prepare(mesh, fan).triangles(), fan.triangles.size());
    }
    for (int face = 0; face < static_cast<int>(mesh.n_faces()); ++face)
        EXPECT_EQ(covered[static_cast<std::size_t>(face)], mesh.status(OpenMesh::FaceHandle(face)).deleted() ? 0 : 1);
}

}  // namespace
}  // namespace pierce::test
