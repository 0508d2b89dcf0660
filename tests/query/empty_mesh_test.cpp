// Meshes that were default-made or moved from are empty meshes. A moved-from one crashed once on its next query, and
// `CollisionMesh m({{}, {}})` did not compile.
#include <utility>

#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/meshes.h>

namespace pierce::test {
namespace {

template <class Scalar>
class EmptyMesh : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(EmptyMesh, Scalars);

template <class Scalar>
void expect_empty(const CollisionMesh<Scalar>& mesh) {
    const Segment<Scalar> s{{0, 0, 5}, {0, 0, -5}};
    const Segment<Scalar> invalid{{0, 0, std::numeric_limits<Scalar>::quiet_NaN()}, {0, 0, -5}};
    std::array<Hit<Scalar>, 3> out;
    const std::vector<Segment<Scalar>> many = {s, invalid, s};
    std::vector<std::uint8_t> any(3, 77);
    for (const Segment<Scalar>& segment : many) {
        EXPECT_FALSE(mesh.first_hit(segment));
        EXPECT_FALSE(mesh.any_hit(segment));
        EXPECT_EQ(mesh.all_hits(segment, out), 0U);
        EXPECT_FALSE(mesh.sweep(segment));
        EXPECT_EQ(mesh.crossings(segment), 0);
        EXPECT_TRUE(mesh.explain(segment).empty());
        EXPECT_EQ(mesh.winding_number(segment.from), 0);
    }
    EXPECT_FALSE(mesh.contains(s.from));
    EXPECT_EQ(mesh.first_hits(many, out), 0U);
    for (const Hit<Scalar>& hit : out) EXPECT_FALSE(static_cast<bool>(hit));
    EXPECT_EQ(mesh.any_hits(many, any), 0U);
    EXPECT_EQ(any, std::vector<std::uint8_t>(3, 0));
    EXPECT_EQ(mesh.mesh_report().components, 0U);
    const MeshStatistics statistics = mesh.statistics();
    EXPECT_EQ(statistics.vertices, 0U);
    EXPECT_EQ(statistics.triangles, 0U);
    EXPECT_EQ(statistics.clusters, 0U);
}

// What all of them share counts for none of them.
template <class Scalar>
void expect_nothing_counted(const CollisionMesh<Scalar>& mesh) {
    expect_empty(mesh);
    EXPECT_EQ(mesh.statistics().bytes, 0U);
    EXPECT_EQ(mesh.statistics().backend, "");
    EXPECT_EQ(mesh.statistics().invalid_queries, 0U);
}

TYPED_TEST(EmptyMesh, is_what_is_made_of_nothing) {
    static_assert(std::is_nothrow_default_constructible_v<CollisionMesh<TypeParam>>);
    expect_nothing_counted(CollisionMesh<TypeParam>());
    expect_nothing_counted(CollisionMesh<TypeParam>{});
    const CollisionMesh<TypeParam> braces({{}, {}});
    expect_nothing_counted(braces);
    expect_nothing_counted(CollisionMesh<TypeParam>({{}, {}, {}}));
    expect_empty(CollisionMesh<TypeParam>(MeshView<TypeParam>{}));
    expect_empty(CollisionMesh<TypeParam>({{}, {}}, {.broadphase = Broadphase::grid}));
}

TYPED_TEST(EmptyMesh, is_what_is_left_of_one_that_was_moved) {
    const TriangleSoup<TypeParam> soup = moved<TypeParam>(bumpy_sphere(4), 1, {0, 0, 0});
    const Segment<TypeParam> down{{0, 0, 5}, {0, 0, TypeParam(0.1)}};
    CollisionMesh<TypeParam> first(soup.view());
    ASSERT_TRUE(first.any_hit(down));
    CollisionMesh<TypeParam> second = std::move(first);
    expect_nothing_counted(first);
    EXPECT_TRUE(second.any_hit(down));
    CollisionMesh<TypeParam> third;
    third = std::move(second);
    expect_nothing_counted(second);
    EXPECT_TRUE(third.any_hit(down));
    // What was there before is gone, not exchanged.
    CollisionMesh<TypeParam> fourth(soup.view());
    third = std::move(fourth);
    expect_nothing_counted(fourth);
    EXPECT_TRUE(third.any_hit(down));
    third = CollisionMesh<TypeParam>();
    expect_nothing_counted(third);
    std::swap(first, second);
    expect_nothing_counted(first);
    first = CollisionMesh<TypeParam>(soup.view());
    EXPECT_TRUE(first.any_hit(down));
}

// Used when everything else is gone.
struct UsedAtTheEnd {
    CollisionMesh<float> mesh;
    ~UsedAtTheEnd() {
        if (mesh.any_hit({{0, 0, 1}, {0, 0, -1}}) || mesh.statistics().triangles != 0) std::abort();
        const CollisionMesh<float> moved = std::move(mesh);
        if (mesh.any_hit({{0, 0, 1}, {0, 0, -1}})) std::abort();
    }
} used_at_the_end;

}  // namespace
}  // namespace pierce::test
