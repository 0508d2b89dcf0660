// A hit as the caller has it: plain memory that can be sent anywhere, and members that go into Eigen's expressions.
// (Eigen's own fixed vectors are not trivially copyable: an array of hits could not be given to C or NumPy.)
#include <cstring>
#include <sstream>
#include <vector>

#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/meshes.h>
#include <Eigen/Geometry>

namespace pierce::test {
namespace {

template <class Scalar>
class Hits : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Hits, Scalars);

TYPED_TEST(Hits, are_plain_memory) {
    using Found = Hit<TypeParam>;
    static_assert(std::is_trivially_copyable_v<Found> && std::is_standard_layout_v<Found>);
    static_assert(sizeof(Found) == (sizeof(TypeParam) == 4 ? 72 : 128));
    EXPECT_FALSE(static_cast<bool>(no_hit<TypeParam>));
    EXPECT_EQ(no_hit<TypeParam>.face, no_face);
    EXPECT_EQ(no_hit<TypeParam>.triangle, no_face);
    // All but the two numbers is 0.
    std::vector<unsigned char> bytes(sizeof(Found));
    std::memcpy(bytes.data(), &no_hit<TypeParam>, bytes.size());
    EXPECT_EQ(std::count(bytes.begin(), bytes.end(), 0), static_cast<std::ptrdiff_t>(sizeof(Found) - 8));
}

TYPED_TEST(Hits, have_a_face_that_may_bear_any_number) {
    TriangleSoup<TypeParam> soup;
    add_triangle(soup, {0, 0, 0}, {4, 0, 0}, {0, 4, 0});
    soup.faces = {no_face};
    const CollisionMesh<TypeParam> mesh(soup.view());
    std::vector<Hit<TypeParam>> out(1);
    const std::vector<Segment<TypeParam>> down = {{{1, 1, 1}, {1, 1, -1}}};
    EXPECT_EQ(mesh.first_hits(down, out), 1U);
    EXPECT_TRUE(static_cast<bool>(out[0]));
    EXPECT_EQ(out[0].face, no_face);
}

TYPED_TEST(Hits, face_whoever_comes) {
    TriangleSoup<TypeParam> soup;
    add_triangle(soup, {0, 0, 0}, {4, 0, 0}, {0, 4, 0});
    const CollisionMesh<TypeParam> mesh(soup.view());
    using V = Vec3<TypeParam>;
    const auto front = mesh.first_hit({V(1, 1, 1), V(1, 1, -1)}, {.sides = Sides::both});
    const auto back = mesh.first_hit({V(1, 1, -1), V(1, 1, 1)}, {.sides = Sides::both});
    ASSERT_TRUE(front && back);
    EXPECT_EQ(front->normal, V(0, 0, 1));
    EXPECT_EQ(back->normal, V(0, 0, 1));
    EXPECT_EQ(front->facing(), V(0, 0, 1));
    EXPECT_EQ(back->facing(), V(0, 0, -1));
}

// What users write with a hit compiles, and is what it is for Eigen's vectors.
TYPED_TEST(Hits, have_members_for_expressions) {
    using V = Vec3<TypeParam>;
    const V from(1, 2, 3);
    Hit<TypeParam> hit = no_hit<TypeParam>;
    hit.point = V(4, 6, 8);
    hit.normal = V(0, 0, 1);
    const bool is_hit = hit.point.z() > 7;

    V position = from;
    position += hit.point - from;
    EXPECT_EQ(position, V(4, 6, 8));
    position -= hit.point;
    EXPECT_EQ(position, V(0, 0, 0));
    position += hit.point;
    EXPECT_EQ(position, hit.point);
    const V copied = hit.point;
    const V constructed(hit.point);
    EXPECT_EQ(copied, constructed);
    const V target = is_hit ? hit.point : from;
    EXPECT_EQ(target, V(4, 6, 8));

    const V v(5, 6, 7);
    EXPECT_EQ(v - hit.normal.dot(v) * hit.normal, V(5, 6, 0));
    EXPECT_EQ(v - 2 * hit.normal.dot(v) * hit.normal, V(5, 6, -7));
    EXPECT_EQ(v - v.dot(hit.normal.vec()) * hit.normal, V(5, 6, 0));
    EXPECT_EQ(hit.point + TypeParam(0.5) * hit.normal, V(4, 6, 8.5));
    EXPECT_EQ(from + hit.point / 2, V(3, 5, 7));
    EXPECT_EQ(hit.point * 2 - (from + v), V(2, 4, 6));
    EXPECT_EQ(-hit.point, V(-4, -6, -8));
    EXPECT_EQ(hit.normal.cross(v), hit.normal.vec().cross(v));
    EXPECT_EQ((hit.point - from).norm(), std::sqrt(TypeParam(50)));
    EXPECT_EQ(hit.normal.norm(), 1);
    EXPECT_EQ(hit.point.squaredNorm(), 116);
    EXPECT_EQ(hit.point.template cast<double>(), Vec3<double>(4, 6, 8));
    EXPECT_NE(hit.point, from);
    EXPECT_FALSE(from == hit.point);
    EXPECT_EQ(hit.point[0] + hit.point[std::size_t{1}] + hit.point.data()[2], 18);
    const Segment<TypeParam> onwards{hit.point, from};
    EXPECT_EQ(onwards.from, copied);
    std::ostringstream text;
    text << hit.point;
    EXPECT_EQ(text.str(), "4 6 8");
}

}  // namespace
}  // namespace pierce::test
