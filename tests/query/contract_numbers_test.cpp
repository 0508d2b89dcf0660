// What is not a mesh or not a segment: numbers that are not finite, indices out of range, and nothing at all.
#include <array>
#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/meshes.h>

namespace pierce::test {
namespace {

using V = Vec3<double>;

template <class Scalar>
void expect_nothing_for_bad_numbers() {
    const CollisionMesh<Scalar> mesh(moved<Scalar>(corner_triangle(), 1, V(0, 0, 0)).view());
    std::array<Hit<Scalar>, 2> out;
    std::uint64_t asked = 0;
    for (const Scalar bad : {std::numeric_limits<Scalar>::quiet_NaN(), std::numeric_limits<Scalar>::infinity(),
                             -std::numeric_limits<Scalar>::infinity()})
        for (int end = 0; end < 2; ++end)
            for (int k = 0; k < 3; ++k) {
                Segment<Scalar> s{{1, 1, 1}, {1, 1, -1}};
                (end == 0 ? s.from : s.to)[k] = bad;
                EXPECT_FALSE(mesh.first_hit(s));
                EXPECT_FALSE(mesh.any_hit(s));
                EXPECT_EQ(mesh.all_hits(s, out), 0U);
                EXPECT_FALSE(mesh.sweep(s));
                asked += 4;
            }
    EXPECT_EQ(mesh.statistics().invalid_queries, asked);
    EXPECT_TRUE(mesh.any_hit({{1, 1, 1}, {1, 1, -1}}));
    EXPECT_EQ(mesh.statistics().invalid_queries, asked);
}

TEST(ContractNumbers, queries_that_are_not_finite_have_no_hit_and_are_counted) {
    expect_nothing_for_bad_numbers<float>();
    expect_nothing_for_bad_numbers<double>();
}

TEST(ContractNumbers, an_empty_mesh_is_never_hit) {
    const CollisionMesh<float> mesh(MeshView<float>{});
    EXPECT_FALSE(mesh.any_hit({{0, 0, 1}, {0, 0, -1}}));
    EXPECT_EQ(mesh.statistics().triangles, 0U);
}

std::string error_of(const TriangleSoup<double>& soup) {
    try {
        const CollisionMesh<double> mesh(soup.view());
    } catch (const MeshError& error) {
        return error.what();
    }
    return "none";
}

TEST(ContractNumbers, a_bad_mesh_is_refused_by_name) {
    TriangleSoup<double> soup = corner_triangle();
    soup.triangles.push_back({0, 1, 3});
    EXPECT_EQ(error_of(soup), "face 1: vertex index 3 is out of range (3 vertices)");
    soup.faces = {7, 7};
    EXPECT_EQ(error_of(soup), "face 7: vertex index 3 is out of range (3 vertices)");
    soup.faces = {7};
    EXPECT_EQ(error_of(soup), "the mesh numbers 1 faces, but has 2 triangles");
    soup = corner_triangle();
    soup.positions.push_back(V(0, std::numeric_limits<double>::quiet_NaN(), 0));
    EXPECT_EQ(error_of(soup), "vertex 3: its y coordinate is not finite");
    soup.positions[1][2] = -std::numeric_limits<double>::infinity();
    EXPECT_EQ(error_of(soup), "vertex 1: its z coordinate is not finite");
}

}  // namespace
}  // namespace pierce::test
