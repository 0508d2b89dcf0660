// What sphere.h says, one sentence after the other.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <pierce/collision_mesh.h>
#include <support/meshes.h>

namespace pierce::test {
namespace {

template <class Scalar>
class SphereContract : public ::testing::Test {
  public:
    using Vec = Vec3<Scalar>;
    using Mesh = CollisionMesh<Scalar>;
    using Step = Segment<Scalar>;

    static Mesh mesh_of(const TriangleSoup<double>& soup) { return Mesh(moved<Scalar>(soup, 1, {0, 0, 0}).view()); }
    /// A right angle at the origin in z = 0, legs of 4.
    const Mesh floor = mesh_of(corner_triangle());
    static constexpr Scalar half = Scalar(0.5);
    static Scalar below(Scalar x) { return std::nextafter(x, -std::numeric_limits<Scalar>::infinity()); }
    static Scalar above(Scalar x) { return std::nextafter(x, std::numeric_limits<Scalar>::infinity()); }
};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SphereContract, Scalars);

TYPED_TEST(SphereContract, DropsOntoAFace) {
    for (const int side : {1, -1}) {
        const TypeParam z = static_cast<TypeParam>(side);
        const auto hit = this->floor.sweep_sphere({{1, 1, 2 * z}, {1, 1, -2 * z}}, this->half);
        ASSERT_TRUE(hit);
        EXPECT_LE(hit->fraction, TypeParam(0.375));
        EXPECT_NEAR(hit->fraction, 0.375, 1e-7);
        EXPECT_EQ(hit->feature, Feature::face);
        EXPECT_EQ(hit->side, side > 0 ? Sides::front : Sides::back);
        EXPECT_EQ(hit->normal, Vec3<TypeParam>(0, 0, z));
        EXPECT_EQ(hit->contact, Vec3<TypeParam>(1, 1, 0));
        EXPECT_GT(hit->center[2] * z, this->half);
        EXPECT_LT(hit->center[2] * z, this->half + 2048 * std::numeric_limits<TypeParam>::epsilon());
        EXPECT_FALSE(hit->at_start);
        EXPECT_EQ(hit->overlap, 0);
    }
}

TYPED_TEST(SphereContract, DropsOntoAnEdgeAndACorner) {
    // Half a radius beside the edge y = 0, so that the normal rises by 60 degrees.
    const auto edge = this->floor.sweep_sphere({{1, TypeParam(-0.25), 2}, {1, TypeParam(-0.25), -2}}, this->half);
    ASSERT_TRUE(edge);
    EXPECT_EQ(edge->feature, Feature::edge);
    EXPECT_EQ(edge->feature_index, 0);
    EXPECT_NEAR(edge->fraction, (2 - std::sqrt(0.1875)) / 4, 1e-6);
    EXPECT_NEAR(edge->normal[1], -0.5, 1e-6);
    EXPECT_NEAR(edge->normal[2], std::sqrt(0.75), 1e-6);
    const auto corner = this->floor.sweep_sphere(
        {{TypeParam(-0.25), TypeParam(-0.25), 2}, {TypeParam(-0.25), TypeParam(-0.25), -2}}, this->half);
    ASSERT_TRUE(corner);
    EXPECT_EQ(corner->feature, Feature::vertex);
    EXPECT_EQ(corner->feature_index, 0);
    EXPECT_NEAR(corner->fraction, (2 - std::sqrt(0.125)) / 4, 1e-6);
    EXPECT_EQ(corner->contact, Vec3<TypeParam>(0, 0, 0));
}

TYPED_TEST(SphereContract, ToTouchIsNoHit) {
    const TypeParam r = this->half;
    // Ends in contact, slides in contact, leaves from contact.
    EXPECT_FALSE(this->floor.sweep_sphere({{1, 1, 2}, {1, 1, r}}, r));
    EXPECT_FALSE(this->floor.sweep_sphere({{1, 1, r}, {2, 1, r}}, r));
    EXPECT_FALSE(this->floor.sweep_sphere({{-1, 1, r}, {9, 1, r}}, r));
    EXPECT_FALSE(this->floor.sweep_sphere({{1, 1, r}, {1, 1, 2}}, r));
    // Grazes an edge, and a corner.
    EXPECT_FALSE(this->floor.sweep_sphere({{1, -r, -3}, {1, -r, 3}}, r));
    EXPECT_FALSE(this->floor.sweep_sphere({{-r, -3, 0}, {-r, 3, 0}}, r));
    // One step of the last place further each of these is a hit.
    EXPECT_TRUE(this->floor.sweep_sphere({{1, 1, 2}, {1, 1, this->below(r)}}, r));
    EXPECT_TRUE(this->floor.sweep_sphere({{1, 1, r}, {2, 1, this->below(r)}}, r));
    EXPECT_TRUE(this->floor.sweep_sphere({{-1, 1, r}, {9, 1, r}}, this->above(r)));
    EXPECT_TRUE(this->floor.sweep_sphere({{1, -this->below(r), -3}, {1, -this->below(r), 3}}, r));
    EXPECT_TRUE(this->floor.sweep_sphere({{-this->below(r), -3, 0}, {-this->below(r), 3, 0}}, r));
}

TYPED_TEST(SphereContract, FromContactIntoTheSurfaceIsAHitAtZero) {
    const TypeParam r = this->half;
    const auto hit = this->floor.sweep_sphere({{1, 1, r}, {2, 1, 0}}, r);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->fraction, 0);
    EXPECT_TRUE(hit->at_start);
    EXPECT_EQ(hit->overlap, 0);
    EXPECT_EQ(hit->center, Vec3<TypeParam>(1, 1, r));
    EXPECT_EQ(hit->normal, Vec3<TypeParam>(0, 0, 1));
}

TYPED_TEST(SphereContract, OneThatOverlapsMayLeaveButNotSinkDeeper) {
    const TypeParam r = this->half, quarter = TypeParam(0.25);
    EXPECT_FALSE(this->floor.sweep_sphere({{1, 1, quarter}, {1, 1, 2}}, r));
    EXPECT_FALSE(this->floor.sweep_sphere({{1, 1, quarter}, {2, 1, quarter}}, r));
    const auto hit = this->floor.sweep_sphere({{1, 1, quarter}, {1, 1, -2}}, r);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->fraction, 0);
    EXPECT_TRUE(hit->at_start);
    EXPECT_EQ(hit->overlap, quarter);
    EXPECT_EQ(hit->center, Vec3<TypeParam>(1, 1, quarter));
    // Over an edge, sideways: away from it, and towards it.
    EXPECT_FALSE(this->floor.sweep_sphere({{1, -quarter, 0}, {1, -2, 0}}, r));
    EXPECT_TRUE(this->floor.sweep_sphere({{1, -quarter, 0}, {2, -this->below(quarter), 0}}, r));
    // With the center on the triangle to either side.
    EXPECT_FALSE(this->floor.sweep_sphere({{1, 1, 0}, {1, 1, 2}}, r));
    EXPECT_FALSE(this->floor.sweep_sphere({{1, 1, 0}, {1, 1, -2}}, r));
    EXPECT_FALSE(this->floor.sweep_sphere({{1, 1, 0}, {2, 1, 0}}, r));
}

TYPED_TEST(SphereContract, TheDeepestOverlapIsNamed) {
    // Three sheets at z = 0, -0.25 and 0.1, around a ball at z = 0.5 of radius 1: all are too near.
    TriangleSoup<double> soup;
    for (const double z : {0.0, -0.25, 0.125}) add_triangle(soup, {0, 0, z}, {4, 0, z}, {0, 4, z});
    const auto mesh = this->mesh_of(soup);
    const auto hit = mesh.sweep_sphere({{1, 1, TypeParam(0.5)}, {1, 1, -3}}, 1);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->face, 2U);
    EXPECT_EQ(hit->overlap, TypeParam(0.625));
}

TYPED_TEST(SphereContract, TiesGoToTheSmallestFace) {
    TriangleSoup<double> soup = corner_triangle();
    soup.triangles.push_back({0, 1, 2});
    soup.triangles.push_back({1, 2, 0});
    soup.faces = {7, 3, 5};
    const auto mesh = this->mesh_of(soup);
    const auto hit = mesh.sweep_sphere({{1, 1, 2}, {1, 1, -2}}, this->half);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->face, 3U);
    EXPECT_EQ(hit->triangle, 1U);
}

TYPED_TEST(SphereContract, WhatHasNoMeaningIsCounted) {
    using Limits = std::numeric_limits<TypeParam>;
    const Segment<TypeParam> step{{1, 1, 2}, {1, 1, -2}};
    std::uint64_t invalid = 0;
    for (const TypeParam r :
         {TypeParam(0), TypeParam(-1), Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()}) {
        EXPECT_FALSE(this->floor.sweep_sphere(step, r));
        EXPECT_EQ(this->floor.sphere_hits(step, r, {}), 0U);
        EXPECT_EQ(this->floor.sphere_contacts(step.from, r, {}), 0U);
        invalid += 3;
        EXPECT_EQ(this->floor.statistics().invalid_queries, invalid);
    }
    EXPECT_FALSE(this->floor.sweep_sphere({{1, 1, 2}, {1, Limits::quiet_NaN(), -2}}, 1));
    EXPECT_FALSE(this->floor.sweep_sphere({{1, 1, Limits::infinity()}, {1, 1, -2}}, 1));
    EXPECT_EQ(this->floor.statistics().invalid_queries, invalid + 2);
    // A step of length zero has a meaning, and no hit; so have the least and the largest radius.
    EXPECT_FALSE(this->floor.sweep_sphere({{1, 1, 0}, {1, 1, 0}}, 1));
    EXPECT_TRUE(this->floor.sweep_sphere(step, Limits::denorm_min()));
    EXPECT_TRUE(this->floor.sweep_sphere(step, Limits::max()));
    EXPECT_EQ(this->floor.statistics().invalid_queries, invalid + 2);
    EXPECT_FALSE(CollisionMesh<TypeParam>().sweep_sphere(step, 1));
    EXPECT_EQ(CollisionMesh<TypeParam>().sphere_contacts(step.from, 1, {}), 0U);
}

TYPED_TEST(SphereContract, OptionsChooseWhatCounts) {
    TriangleSoup<double> soup;
    for (const double z : {0.0, -1.0}) add_triangle(soup, {0, 0, z}, {4, 0, z}, {0, 4, z});
    const auto mesh = this->mesh_of(soup);
    const Segment<TypeParam> step{{1, 1, 2}, {1, 1, -2}};
    const std::array<std::uint8_t, 2> second = {0, 1};
    const auto masked = mesh.sweep_sphere(step, this->half, {.face_mask = second});
    ASSERT_TRUE(masked);
    EXPECT_EQ(masked->face, 1U);
    EXPECT_NEAR(masked->center[2], -0.5, 1e-5);
    EXPECT_FALSE(mesh.sweep_sphere(step, this->half, {.face_mask = std::span(second).first(1)}));
    int asked = 0;
    const auto accept = [&asked](const Contact& contact) {
        ++asked;
        EXPECT_NEAR(contact.barycentric.sum(), 1, 1e-12);
        EXPECT_EQ(contact.side, Sides::front);
        return contact.face == 1;
    };
    const auto accepted = mesh.sweep_sphere(step, this->half, {.accept = accept});
    ASSERT_TRUE(accepted);
    EXPECT_GT(asked, 1);
    EXPECT_EQ(accepted->face, 1U);
    EXPECT_TRUE(mesh.sweep_sphere(step, this->half, {.max_fraction = 0.5}));
    EXPECT_FALSE(mesh.sweep_sphere(step, this->half, {.max_fraction = 0.25}));
    EXPECT_FALSE(mesh.sweep_sphere(step, this->half, {.max_fraction = -1}));
    EXPECT_FALSE(mesh.sweep_sphere(step, this->half, {.max_fraction = std::numeric_limits<double>::quiet_NaN()}));
    // Sides say nothing.
    EXPECT_TRUE(mesh.sweep_sphere(step, this->half, {.sides = Sides::back}));
    QueryCounters counters;
    EXPECT_TRUE(mesh.sweep_sphere(step, this->half, {.counters = &counters}));
    EXPECT_EQ(counters.queries, 1U);
    EXPECT_GT(counters.triangles, 0U);
}

TYPED_TEST(SphereContract, NoStepIsTooLongAndNoMeshTooFar) {
    using Limits = std::numeric_limits<TypeParam>;
    const TypeParam far = Limits::max();
    for (const TypeParam height : {TypeParam(2), TypeParam(1e6), far}) {
        for (const TypeParam depth : {TypeParam(-1), TypeParam(-1e6), -far}) {
            const auto hit = this->floor.sweep_sphere({{1, 1, height}, {1, 1, depth}}, this->half);
            ASSERT_TRUE(hit) << height << ' ' << depth;
            EXPECT_GT(hit->center[2], this->half);
            EXPECT_TRUE(height > 10 || hit->center[2] < TypeParam(0.51));
        }
    }
    for (const double scale :
         {std::sqrt(static_cast<double>(Limits::max())), std::sqrt(static_cast<double>(Limits::min()))}) {
        const CollisionMesh<TypeParam> mesh(moved<TypeParam>(corner_triangle(), scale, {0, 0, 0}).view());
        const auto s = static_cast<TypeParam>(scale);
        const auto hit = mesh.sweep_sphere({{s, s, 2 * s}, {s, s, -2 * s}}, s / 2);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->fraction, 0.375, 1e-6);
        EXPECT_NEAR(hit->center[2] / s, 0.5, 1e-5);
        EXPECT_FALSE(mesh.sweep_sphere({{s, s, 2 * s}, {s, s, s / 2}}, s / 2));
    }
}

// A ball that rests and is pushed into the floor does not shake; one that slides along it keeps its way.
TYPED_TEST(SphereContract, AtRestItStaysAndAlongThePlaneItSlides) {
    for (const double offset : {0.0, 1000.0}) {
        TriangleSoup<double> soup;
        add_triangle(soup, {-40, -40, -16}, {60, -50, 14}, {10, 70, 5});
        const CollisionMesh<TypeParam> mesh(moved<TypeParam>(soup, 1, {offset, offset, offset}).view());
        const auto x = static_cast<TypeParam>(offset);
        const TypeParam r = this->half;
        const auto landed = mesh.sweep_sphere({{x + 1, x + 2, x + 20}, {x + 2, x + 1, x - 20}}, r);
        ASSERT_TRUE(landed);
        Vec3<TypeParam> at = landed->center;
        for (int i = 0; i < 20; ++i) {
            const auto rest = mesh.sweep_sphere({at, at - Vec3<TypeParam>(0, 0, TypeParam(0.01))}, r);
            ASSERT_TRUE(rest);
            EXPECT_EQ(rest->center, at);
        }
        const Vec3<TypeParam> n = landed->normal;
        Vec3<TypeParam> d(1, TypeParam(0.3), 0);
        d -= n * n.dot(d);
        int stopped = 0;
        for (int i = 0; i < 200; ++i) {
            const Vec3<TypeParam> to = at + d * TypeParam(0.02);
            const auto hit = mesh.sweep_sphere({at, to}, r);
            stopped += hit ? 1 : 0;
            at = hit ? hit->center.vec() : to;
        }
        EXPECT_LT(stopped, 100);
        EXPECT_NEAR((at - landed->center).norm(), d.norm() * 4, d.norm() * 0.4);
    }
}

}  // namespace
}  // namespace pierce::test
