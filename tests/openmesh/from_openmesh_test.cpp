// Meshes of any point type are taken exactly as they are, without what is deleted in them.
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>

#include <gtest/gtest.h>

#include <openmesh/meshes.h>

namespace pierce::test {
namespace {

using MeshF = MeshOf<OpenMesh::Vec3f>;
using MeshD = MeshOf<OpenMesh::Vec3d>;
using Int64Mesh = MeshOf<OpenMesh::VectorT<std::int64_t, 3>>;
using LongDoubleMesh = MeshOf<OpenMesh::VectorT<long double, 3>>;

template <class Mesh>
std::string message_of(const Mesh& mesh) {
    try {
        (void)from_openmesh(mesh);
    } catch (const MeshError& error) {
        return error.what();
    }
    return "no error";
}

/// One triangle at the origin's corner; vertex 2 is (1, value, 3).
template <class Mesh, class Coordinate>
Mesh mesh_with(Coordinate value) {
    Mesh mesh;
    using Point = typename Mesh::Point;
    const auto u = mesh.add_vertex(point_of<Point>(0, 0, 0));
    const auto v = mesh.add_vertex(point_of<Point>(4, 0, 0));
    const auto w = mesh.add_vertex(point_of<Point, Coordinate>(1, value, 3));
    mesh.add_face(u, v, w);
    return mesh;
}

template <class Scalar, class Point>
constexpr bool works_in = std::is_same_v<OpenMeshScalar<MeshOf<Point>>, Scalar>;

static_assert(works_in<float, OpenMesh::Vec3f> && works_in<float, Eigen::RowVector3f>);
static_assert(works_in<float, Eigen::Matrix<std::int8_t, 3, 1>> && works_in<float, Eigen::Matrix<std::uint16_t, 1, 3>>);
static_assert(works_in<double, OpenMesh::Vec3d> && works_in<double, OwnVector> && works_in<double, OpenMesh::Vec3i>);
static_assert(works_in<double, OpenMesh::VectorT<long double, 3>> && works_in<double, Eigen::Vector3i>);

template <class Point>
class AnyPoint : public testing::Test {};

using Points =
    testing::Types<OpenMesh::Vec3f, OpenMesh::Vec3d, OpenMesh::Vec3i, OpenMesh::Vec3ui,
                   OpenMesh::VectorT<std::int64_t, 3>, OpenMesh::VectorT<long double, 3>, Eigen::Vector3f,
                   Eigen::Vector3d, Eigen::RowVector3f, Eigen::RowVector3d, Eigen::Vector3i,
                   Eigen::Matrix<std::int16_t, 3, 1>, Eigen::Matrix<long double, 1, 3>, OwnVector>;
TYPED_TEST_SUITE(AnyPoint, Points);

TYPED_TEST(AnyPoint, GivesItsPositionsAndFaces) {
    using Mesh = MeshOf<TypeParam>;
    using Scalar = OpenMeshScalar<Mesh>;
    for (const Shape& shape : {tetrahedron(), grid(3), cube()}) {
        const auto soup = from_openmesh(mesh_of<Mesh>(shape));
        EXPECT_EQ(soup.positions, soup_of<Scalar>(shape).positions);
        EXPECT_EQ(soup.triangles, shape.faces);
        EXPECT_TRUE(soup.faces.empty());
    }
}

TYPED_TEST(AnyPoint, ListsCornersAsTheCirculatorDoes) {
    using Mesh = MeshOf<TypeParam>;
    Mesh mesh = mesh_of<Mesh>(cube());
    for (const OpenMesh::FaceHandle face : mesh.faces())  // begin some faces elsewhere
        for (int k = 0; k < face.idx() % 3; ++k)
            mesh.set_halfedge_handle(face, mesh.next_halfedge_handle(mesh.halfedge_handle(face)));
    const auto soup = from_openmesh(mesh);
    for (std::size_t i = 0; i < mesh.n_faces(); ++i) {
        const OpenMesh::FaceHandle face(static_cast<int>(i));
        std::size_t k = 0;
        for (auto it = mesh.fv_ccwiter(face); it.is_valid(); ++it, ++k)
            EXPECT_EQ(soup.triangles[i].at(k), static_cast<std::uint32_t>(it->idx()));
        EXPECT_EQ(k, 3U);
    }
}

TYPED_TEST(AnyPoint, GoesToAMeshAndBack) {
    using Mesh = MeshOf<TypeParam>;
    const auto soup = from_openmesh(mesh_of<Mesh>(cube()));
    Mesh mesh;
    EXPECT_TRUE(to_openmesh(soup, mesh).refused.empty());
    const auto again = from_openmesh(mesh);
    EXPECT_EQ(again.positions, soup.positions);
    EXPECT_EQ(again.triangles, soup.triangles);
}

TEST(FromOpenMesh, EmptyMesh) {
    const auto soup = from_openmesh(MeshF());
    EXPECT_TRUE(soup.positions.empty());
    EXPECT_TRUE(soup.triangles.empty());
    EXPECT_TRUE(soup.faces.empty());
}

TEST(FromOpenMesh, DeletedFacesAreLeftOutAndTheOthersKeepTheirNumbers) {
    MeshD mesh = mesh_of<MeshD>(grid(2));
    mesh.request_vertex_status();
    mesh.request_edge_status();
    mesh.request_face_status();
    EXPECT_TRUE(from_openmesh(mesh).faces.empty());
    for (const int i : {0, 1, 4}) mesh.delete_face(OpenMesh::FaceHandle(i), false);
    auto soup = from_openmesh(mesh);
    EXPECT_EQ(soup.faces, (std::vector<std::uint32_t>{2, 3, 5, 6, 7}));
    EXPECT_EQ(soup.triangles.front(), grid(2).faces[2]);
    EXPECT_EQ(soup.positions.size(), 9U);

    mesh.garbage_collection();
    soup = from_openmesh(mesh);
    EXPECT_TRUE(soup.faces.empty());
    EXPECT_EQ(soup.triangles.size(), 5U);
    for (const OpenMesh::FaceHandle face : mesh.faces()) mesh.delete_face(face);
    EXPECT_TRUE(from_openmesh(mesh).triangles.empty());
}

TEST(FromOpenMesh, OnlyFacesWithStatus) {
    MeshF mesh = mesh_of<MeshF>(tetrahedron());
    mesh.request_face_status();
    mesh.status(OpenMesh::FaceHandle(1)).set_deleted(true);
    EXPECT_EQ(from_openmesh(mesh).faces, (std::vector<std::uint32_t>{0, 2, 3}));
}

TEST(FromOpenMesh, StatusFromTheTraits) {
    struct WithStatus : Traits<Eigen::Vector3d> {
        VertexAttributes(OpenMesh::Attributes::Status);
        EdgeAttributes(OpenMesh::Attributes::Status);
        FaceAttributes(OpenMesh::Attributes::Status);
    };
    auto mesh = mesh_of<OpenMesh::TriMesh_ArrayKernelT<WithStatus>>(tetrahedron());
    mesh.delete_vertex(OpenMesh::VertexHandle(3));
    EXPECT_EQ(from_openmesh(mesh).faces, (std::vector<std::uint32_t>{0}));
}

TEST(FromOpenMesh, IsolatedVerticesKeepTheirPlaces) {
    MeshD mesh;
    mesh.add_vertex({7, 7, 7});
    const auto u = mesh.add_vertex({0, 0, 0});
    mesh.add_vertex({8, 8, 8});
    const auto v = mesh.add_vertex({1, 0, 0});
    const auto w = mesh.add_vertex({0, 1, 0});
    mesh.add_face(u, v, w);
    const auto soup = from_openmesh(mesh);
    EXPECT_EQ(soup.positions.size(), 5U);
    EXPECT_EQ(soup.triangles.front(), (IndexTriple{1, 3, 4}));
}

TEST(FromOpenMesh, ADeletedVertexMayBeNaNAndAnIsolatedOneMayNot) {
    MeshD mesh = mesh_of<MeshD>(tetrahedron());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto isolated = mesh.add_vertex({0, nan, 0});
    try {
        const CollisionMesh<double> level(from_openmesh(mesh).view());
        ADD_FAILURE() << "taken";
    } catch (const MeshError& error) {
        EXPECT_NE(std::string(error.what()).find("vertex 4"), std::string::npos) << error.what();
    }
    mesh.request_vertex_status();
    mesh.request_edge_status();
    mesh.request_face_status();
    mesh.delete_vertex(isolated);
    const auto soup = from_openmesh(mesh);
    EXPECT_EQ(soup.positions[4], Vec3<double>(0, 0, 0));
    EXPECT_NO_THROW(const CollisionMesh<double> level(soup.view()));
}

TEST(FromOpenMesh, Int64ThatIsNoDoubleIsRefused) {
    constexpr std::int64_t odd = (std::int64_t{1} << 53) + 1;
    EXPECT_EQ(message_of(mesh_with<Int64Mesh>(odd)),
              "vertex 2: its y coordinate, 9007199254740993, is not exactly representable in double");
    using Limits = std::numeric_limits<std::int64_t>;
    EXPECT_NE(message_of(mesh_with<Int64Mesh>(-odd)), "no error");
    EXPECT_NE(message_of(mesh_with<Int64Mesh>(Limits::max())), "no error");
    EXPECT_EQ(message_of(mesh_with<Int64Mesh>(Limits::min())), "no error");
    EXPECT_EQ(from_openmesh(mesh_with<Int64Mesh>(2 * odd - 2)).positions[2].y(), std::ldexp(1.0, 54));
    using Uint64Mesh = MeshOf<Eigen::Matrix<std::uint64_t, 3, 1>>;
    EXPECT_NE(message_of(mesh_with<Uint64Mesh>(std::numeric_limits<std::uint64_t>::max())), "no error");
    EXPECT_EQ(message_of(mesh_with<Uint64Mesh>(std::uint64_t{1} << 63)), "no error");
}

TEST(FromOpenMesh, EveryIntIsADouble) {
    using Mesh = MeshOf<OpenMesh::Vec3i>;
    for (const int value : {std::numeric_limits<int>::min(), std::numeric_limits<int>::max()})
        EXPECT_EQ(from_openmesh(mesh_with<Mesh>(value)).positions[2].y(), value);
}

TEST(FromOpenMesh, LongDoubleThatIsNoDoubleIsRefused) {
    EXPECT_EQ(from_openmesh(mesh_with<LongDoubleMesh>(0.1)).positions[2].y(), 0.1);
    const long double inf = std::numeric_limits<long double>::infinity();
    EXPECT_EQ(from_openmesh(mesh_with<LongDoubleMesh>(inf)).positions[2].y(), std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(from_openmesh(mesh_with<LongDoubleMesh>(std::nanl(""))).positions[2].y()));
    EXPECT_TRUE(std::signbit(from_openmesh(mesh_with<LongDoubleMesh>(-0.0L)).positions[2].y()));
    if (std::numeric_limits<long double>::digits == std::numeric_limits<double>::digits)
        GTEST_SKIP() << "long double is double here";
    using Limits = std::numeric_limits<long double>;
    for (const long double value : {0.1L, Limits::max(), -Limits::max(), Limits::min(), Limits::denorm_min()})
        EXPECT_EQ(message_of(mesh_with<LongDoubleMesh>(value)).rfind("vertex 2: its y coordinate, ", 0), 0U) << value;
}

TEST(FromOpenMesh, WhatIsDeletedNeedNotBeRepresentable) {
    auto mesh = mesh_with<Int64Mesh>(std::numeric_limits<std::int64_t>::max());
    mesh.request_vertex_status();
    mesh.request_edge_status();
    mesh.request_face_status();
    mesh.delete_vertex(OpenMesh::VertexHandle(2));
    EXPECT_EQ(message_of(mesh), "no error");
}

TEST(FromOpenMesh, BrokenConnectivityIsRefused) {
    MeshF mesh;
    mesh.resize(3, 3, 2);
    EXPECT_EQ(message_of(mesh), "face 0 is not a triangle");
    mesh = mesh_of<MeshF>(tetrahedron());
    mesh.request_vertex_status();
    mesh.status(OpenMesh::VertexHandle(3)).set_deleted(true);
    EXPECT_EQ(message_of(mesh), "face 1: its vertex 3 is deleted");
}

}  // namespace
}  // namespace pierce::test
