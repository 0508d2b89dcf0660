// A soup becomes a half-edge mesh as far as it can, and what can't is named.
#include <algorithm>
#include <cstdint>
#include <iostream>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <openmesh/meshes.h>

namespace pierce::test {
namespace {

using MeshF = MeshOf<OpenMesh::Vec3f>;
using MeshD = MeshOf<Eigen::Vector3d>;
using Numbers = std::vector<std::uint32_t>;

/// What OpenMesh says, caught while this lives, and not shown.
class Listener {
  public:
    Listener() = default;
    ~Listener() { std::cerr.rdbuf(buffer_); }
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;
    std::string text() {
        omerr().flush();
        return text_.str();
    }

  private:
    std::ostringstream text_;
    std::streambuf* buffer_ = std::cerr.rdbuf(text_.rdbuf());  // where omerr() writes to
};

template <class Mesh, class Scalar>
std::string message_of(const TriangleSoup<Scalar>& soup) {
    Mesh mesh;
    try {
        (void)to_openmesh(soup, mesh);
    } catch (const MeshError& error) {
        EXPECT_EQ(mesh.n_vertices(), 0U);
        return error.what();
    }
    return "no error";
}

/// A quad of two triangles, 0 and 2, with a third on the edge between them.
Shape fin() {
    return {{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 2}}, {{0, 1, 2}, {0, 2, 4}, {0, 2, 3}}};
}

TEST(ToOpenMesh, FacesKeepTheirOrder) {
    MeshD mesh;
    const OpenMeshFaces faces = to_openmesh(soup_of<double>(cube()), mesh);
    EXPECT_TRUE(faces.refused.empty());
    ASSERT_EQ(faces.triangles.size(), 12U);
    for (std::uint32_t i = 0; i < 12; ++i) EXPECT_EQ(faces.triangles[i], i);
    EXPECT_EQ(from_openmesh(mesh).triangles, cube().faces);
}

TEST(ToOpenMesh, TheThirdFaceOnAnEdgeIsRefused) {
    const auto soup = soup_of<double>(fin());
    MeshD mesh;
    const OpenMeshFaces faces = to_openmesh(soup, mesh);
    EXPECT_EQ(faces.refused, Numbers{2});
    EXPECT_EQ(faces.triangles, (Numbers{0, 1}));
    EXPECT_EQ(mesh.n_faces(), 2U);
    EXPECT_EQ(mesh.n_vertices(), 5U);
}

TEST(ToOpenMesh, ARefusedFaceInTheMiddleShiftsTheHandlesButNotTheMapping) {
    Shape shape = fin();
    shape.faces = {{0, 1, 2}, {0, 1, 3}, {2, 2, 4}, {0, 2, 3}};  // 1: the same direction as 0; 2: a vertex twice
    MeshD mesh;
    const OpenMeshFaces faces = to_openmesh(soup_of<float>(shape), mesh);
    EXPECT_EQ(faces.refused, (Numbers{1, 2}));
    EXPECT_EQ(faces.triangles, (Numbers{0, 3}));
    EXPECT_EQ(from_openmesh(mesh).triangles, (std::vector<IndexTriple>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(ToOpenMesh, AFaceOnAClosedVertexIsRefused) {
    Shape shape = tetrahedron();
    shape.vertices.push_back({9, 9, 9});
    shape.vertices.push_back({9, 9, 8});
    shape.faces.push_back({3, 4, 5});
    MeshF mesh;
    EXPECT_EQ(to_openmesh(soup_of<float>(shape), mesh).refused, Numbers{4});
}

TEST(ToOpenMesh, ZeroAreaFacesAreKept) {
    Shape shape;
    shape.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}};
    shape.faces = {{0, 1, 2}, {0, 3, 1}};
    MeshF mesh;
    EXPECT_TRUE(to_openmesh(soup_of<float>(shape), mesh).refused.empty());
    EXPECT_EQ(from_openmesh(mesh).triangles, shape.faces);
}

TEST(ToOpenMesh, IsSilentAndLeavesTheStreamAsItWas) {
    const auto soup = soup_of<double>(fin());
    Listener listener;
    ASSERT_TRUE(omerr().is_enabled());
    omerr() << "not ended";
    {
        MeshD mesh;
        (void)to_openmesh(soup, mesh);
    }
    EXPECT_TRUE(omerr().is_enabled());
    EXPECT_EQ(listener.text(), "not ended");
    {
        MeshD mesh;
        omerr().disable();
        (void)to_openmesh(soup, mesh);
        EXPECT_FALSE(omerr().is_enabled());
        omerr().enable();
    }
    omerr() << ", now it is";
    EXPECT_EQ(listener.text(), "not ended, now it is");
    MeshD mesh = mesh_of<MeshD>(fin());  // refused faces are remarked on again
    EXPECT_GT(listener.text().size(), std::string("not ended, now it is").size());
}

TEST(ToOpenMesh, EmptySoup) {
    MeshF mesh;
    const OpenMeshFaces faces = to_openmesh(TriangleSoup<float>(), mesh);
    EXPECT_TRUE(faces.triangles.empty() && faces.refused.empty());
    EXPECT_EQ(mesh.n_vertices(), 0U);
}

TEST(ToOpenMesh, OnlyAnEmptyMeshIsFilled) {
    MeshF mesh = mesh_of<MeshF>(tetrahedron());
    EXPECT_THROW((void)to_openmesh(soup_of<float>(cube()), mesh), MeshError);
    EXPECT_EQ(mesh.n_faces(), 4U);
}

TEST(ToOpenMesh, IndicesOutOfRangeAreRefused) {
    auto soup = soup_of<float>(tetrahedron());
    soup.triangles[2][1] = 4;
    EXPECT_EQ(message_of<MeshF>(soup), "triangle 2: vertex index 4 is out of range (4 vertices)");
    soup.triangles[2][1] = std::numeric_limits<std::uint32_t>::max();
    EXPECT_EQ(message_of<MeshF>(soup), "triangle 2: vertex index 4294967295 is out of range (4 vertices)");
}

TEST(ToOpenMesh, CoordinatesAreNotRounded) {
    using MeshI = MeshOf<OpenMesh::Vec3i>;
    using MeshU = MeshOf<OpenMesh::Vec3ui>;
    auto soup = soup_of<double>(tetrahedron());
    soup.positions[3].x() = 0.1;
    EXPECT_EQ(message_of<MeshF>(soup),
              "vertex 3: its x coordinate, 0.10000000000000001, is not exactly representable in float");
    EXPECT_EQ(message_of<MeshI>(soup),
              "vertex 3: its x coordinate, 0.10000000000000001, is not exactly representable in the type of the mesh");
    EXPECT_EQ(message_of<MeshD>(soup), "no error");
    const double inf = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double value : {2147483648.0, -2147483649.0, 1e300, inf, -inf, nan}) {
        soup.positions[3].x() = value;
        EXPECT_NE(message_of<MeshI>(soup), "no error") << value;
    }
    soup.positions[3].x() = -2147483648.0;
    EXPECT_EQ(message_of<MeshI>(soup), "no error");
    EXPECT_NE(message_of<MeshU>(soup), "no error");
    soup.positions[3].x() = 4294967295.0;
    EXPECT_EQ(message_of<MeshU>(soup), "no error");
    soup.positions[3].x() = 1e300;
    EXPECT_NE(message_of<MeshF>(soup), "no error");
    soup.positions[3].x() = inf;
    EXPECT_EQ(message_of<MeshF>(soup), "no error");
}

// Few vertices and many triangles: most are refused, for every reason there is. The others come back as they were.
TEST(ToOpenMesh, RandomSoupsComeBackWhole) {
    std::mt19937 random(1);
    std::size_t kept = 0;
    std::size_t refused = 0;
    for (int round = 0; round < 20000; ++round) {
        const auto vertices = 3 + random() % 8;
        TriangleSoup<float> soup;
        for (std::uint32_t i = 0; i < vertices; ++i) soup.positions.emplace_back(static_cast<float>(i), 0.0F, 1.0F);
        const auto count = random() % 30;
        for (std::uint32_t t = 0; t < count; ++t) {
            IndexTriple triple{};
            for (std::uint32_t& index : triple) index = static_cast<std::uint32_t>(random() % vertices);
            soup.triangles.push_back(triple);
        }
        MeshF mesh;
        const OpenMeshFaces faces = to_openmesh(soup, mesh);
        ASSERT_EQ(faces.triangles.size(), mesh.n_faces());
        Numbers all = faces.triangles;
        all.insert(all.end(), faces.refused.begin(), faces.refused.end());
        std::sort(all.begin(), all.end());
        ASSERT_EQ(all.size(), soup.triangles.size());
        for (std::uint32_t t = 0; t < count; ++t) ASSERT_EQ(all[t], t);
        const auto again = from_openmesh(mesh);
        ASSERT_EQ(again.triangles.size(), faces.triangles.size());
        for (std::size_t i = 0; i < faces.triangles.size(); ++i)
            ASSERT_EQ(again.triangles[i], soup.triangles[faces.triangles[i]]);
        kept += faces.triangles.size();
        refused += faces.refused.size();
    }
    EXPECT_GT(kept, 10000U);
    EXPECT_GT(refused, 10000U);
}

}  // namespace
}  // namespace pierce::test
