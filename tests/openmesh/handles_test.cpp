// A hit on an OpenMesh mesh names the handles that it lies on.
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include <gtest/gtest.h>

#include <openmesh/meshes.h>

namespace pierce::test {
namespace {

template <class Point>
class AnyHit : public testing::Test {
  public:
    using Mesh = MeshOf<Point>;
    using Scalar = OpenMeshScalar<Mesh>;

    /// The first hit straight down at x, y.
    static std::optional<Hit<Scalar>> down(const CollisionMesh<Scalar>& level, double at_x, double at_y) {
        const auto x = static_cast<Scalar>(at_x);
        const auto y = static_cast<Scalar>(at_y);
        return level.first_hit({{x, y, 5}, {x, y, -5}});
    }
};

using Points = testing::Types<OpenMesh::Vec3f, OpenMesh::Vec3d, OpenMesh::Vec3i, OpenMesh::VectorT<long double, 3>,
                              Eigen::Vector3f, Eigen::Vector3d, Eigen::RowVector3d, OwnVector>;
TYPED_TEST_SUITE(AnyHit, Points);

TYPED_TEST(AnyHit, InsideOfAFace) {
    const auto mesh = mesh_of<typename TestFixture::Mesh>(grid(3));
    const CollisionMesh level(from_openmesh(mesh).view());
    for (int i = 0; i < 18; ++i) {
        const int square = i / 2;
        const double x = 2 * (square % 3) + (i % 2 == 0 ? 1.5 : 0.5);
        const double y = 2 * (square / 3) + (i % 2 == 0 ? 0.5 : 1.5);
        const auto hit = this->down(level, x, y);
        ASSERT_TRUE(hit) << i;
        EXPECT_EQ(face_handle(*hit), OpenMesh::FaceHandle(i));
        EXPECT_FALSE(halfedge_handle(mesh, *hit).is_valid());
        EXPECT_FALSE(edge_handle(mesh, *hit).is_valid());
        EXPECT_FALSE(vertex_handle(mesh, *hit).is_valid());
        const auto corners = corner_handles(mesh, *hit);
        double at_x = 0;
        double at_y = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(static_cast<std::uint32_t>(corners[k].idx()), grid(3).faces[static_cast<std::size_t>(i)][k]);
            const double weight = static_cast<double>(hit->barycentric[static_cast<int>(k)]);
            at_x += weight * static_cast<double>(mesh.point(corners[k])[0]);
            at_y += weight * static_cast<double>(mesh.point(corners[k])[1]);
        }
        EXPECT_NEAR(at_x, x, 1e-5);
        EXPECT_NEAR(at_y, y, 1e-5);
    }
}

TYPED_TEST(AnyHit, OnEachVertex) {
    const auto mesh = mesh_of<typename TestFixture::Mesh>(grid(3));
    const CollisionMesh level(from_openmesh(mesh).view());
    for (int i = 0; i < 16; ++i) {
        const auto hit = this->down(level, 2 * (i % 4), 2 * (i / 4));
        ASSERT_TRUE(hit) << i;
        EXPECT_EQ(vertex_handle(mesh, *hit), OpenMesh::VertexHandle(i));
        EXPECT_FALSE(edge_handle(mesh, *hit).is_valid());
        EXPECT_FALSE(halfedge_handle(mesh, *hit).is_valid());
    }
}

TYPED_TEST(AnyHit, OnEachEdgeWhereverTheFacesBegin) {
    auto mesh = mesh_of<typename TestFixture::Mesh>(grid(3));
    for (int turn = 0; turn < 3; ++turn) {
        const CollisionMesh level(from_openmesh(mesh).view());
        for (const OpenMesh::EdgeHandle edge : mesh.edges()) {
            const auto one = mesh.halfedge_handle(edge, 0);
            const auto& p = mesh.point(mesh.from_vertex_handle(one));
            const auto& q = mesh.point(mesh.to_vertex_handle(one));
            const auto hit =
                this->down(level, static_cast<double>(p[0] + q[0]) / 2, static_cast<double>(p[1] + q[1]) / 2);
            ASSERT_TRUE(hit) << edge.idx();
            EXPECT_EQ(edge_handle(mesh, *hit), edge);
            const OpenMesh::HalfedgeHandle halfedge = halfedge_handle(mesh, *hit);
            EXPECT_EQ(mesh.edge_handle(halfedge), edge);
            EXPECT_EQ(mesh.face_handle(halfedge), face_handle(*hit));
            EXPECT_EQ(mesh.from_vertex_handle(halfedge), corner_handles(mesh, *hit)[hit->feature_index]);
            EXPECT_EQ(mesh.to_vertex_handle(halfedge), corner_handles(mesh, *hit)[(hit->feature_index + 1U) % 3]);
            EXPECT_FALSE(vertex_handle(mesh, *hit).is_valid());
        }
        for (const OpenMesh::FaceHandle face : mesh.faces())
            mesh.set_halfedge_handle(face, mesh.next_halfedge_handle(mesh.halfedge_handle(face)));
    }
}

TYPED_TEST(AnyHit, BehindAHoleInTheNumbering) {
    auto mesh = mesh_of<typename TestFixture::Mesh>(grid(2));
    mesh.request_vertex_status();
    mesh.request_edge_status();
    mesh.request_face_status();
    for (const int i : {0, 1, 3}) mesh.delete_face(OpenMesh::FaceHandle(i));
    const CollisionMesh level(from_openmesh(mesh).view());
    EXPECT_EQ(level.statistics().faces, 5U);
    EXPECT_FALSE(this->down(level, 1.5, 0.5));
    EXPECT_FALSE(this->down(level, 2.5, 1.5));
    const auto hit = this->down(level, 2.5, 3.5);
    ASSERT_TRUE(hit);
    EXPECT_EQ(face_handle(*hit), OpenMesh::FaceHandle(7));
    EXPECT_EQ(hit->triangle, 4U);
    const auto corner = this->down(level, 4, 0);
    ASSERT_TRUE(corner);
    EXPECT_EQ(face_handle(*corner), OpenMesh::FaceHandle(2));
    EXPECT_EQ(vertex_handle(mesh, *corner), OpenMesh::VertexHandle(2));
}

TYPED_TEST(AnyHit, NothingIsLeft) {
    auto mesh = mesh_of<typename TestFixture::Mesh>(grid(2));
    const CollisionMesh empty(from_openmesh(typename TestFixture::Mesh()).view());
    EXPECT_FALSE(this->down(empty, 1.5, 0.5));
    mesh.request_vertex_status();
    mesh.request_edge_status();
    mesh.request_face_status();
    for (const OpenMesh::FaceHandle face : mesh.faces()) mesh.delete_face(face, false);
    const CollisionMesh level(from_openmesh(mesh).view());
    EXPECT_FALSE(this->down(level, 1.5, 0.5));
}

TEST(Handles, OfASweep) {
    const auto mesh = mesh_of<MeshOf<Eigen::Vector3d>>(cube());
    const CollisionMesh level(from_openmesh(mesh).view());
    const auto hit = level.sweep({{1, 3, 1}, {1, 1, 1}});
    ASSERT_TRUE(hit);
    EXPECT_EQ(face_handle(*hit), OpenMesh::FaceHandle(8));
    const OpenMesh::HalfedgeHandle halfedge = halfedge_handle(mesh, *hit);
    ASSERT_TRUE(halfedge.is_valid());
    EXPECT_EQ(mesh.from_vertex_handle(halfedge).idx(), 7);
    EXPECT_EQ(mesh.to_vertex_handle(halfedge).idx(), 2);
}

TEST(Handles, OfAMeshThatWasMadeOfASoup) {
    TriangleSoup<float> soup = soup_of<float>(grid(2));
    soup.triangles.insert(soup.triangles.begin() + 2, soup.triangles[0]);
    MeshOf<OpenMesh::Vec3f> mesh;
    const OpenMeshFaces faces = to_openmesh(soup, mesh);
    EXPECT_EQ(faces.refused, std::vector<std::uint32_t>{2});
    const CollisionMesh level(from_openmesh(mesh).view());
    const auto hit = AnyHit<OpenMesh::Vec3f>::down(level, 2.5, 3.5);
    ASSERT_TRUE(hit);
    EXPECT_EQ(faces.triangles[static_cast<std::size_t>(face_handle(*hit).idx())], 8U);
}

}  // namespace
}  // namespace pierce::test
