// The decision contract in small cases that can be checked by eye; see include/pierce/hit.h for its words.
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/meshes.h>

namespace pierce::test {
namespace {

using V = Vec3<double>;
using S = Segment<double>;

struct Case {
    const char* what;
    V from;
    V to;
    bool front;
    bool back;
    bool both;  // a change of side, on the plane counting as in front
};

TEST(Contract, sides_ends_and_planes) {
    //   z                        The triangle lies in the plane z = 0 and faces up; (1, 1) is inside.
    //   |  from
    //   |   \       front
    //   +----\------------- x
    //         to    back
    const CollisionMesh<double> mesh(corner_triangle().view());
    const Case cases[] = {
        {"from the front through the face", {1, 1, 1}, {1, 1, -1}, true, false, true},
        {"from the back through the face", {1, 1, -1}, {1, 1, 1}, false, true, true},
        {"starts on the face, goes in", {1, 1, 0}, {1, 1, -1}, true, false, true},
        {"starts on the face, goes out", {1, 1, 0}, {1, 1, 1}, false, true, false},
        {"ends on the face, from the front", {1, 1, 1}, {1, 1, 0}, false, false, false},
        {"ends on the face, from the back", {1, 1, -1}, {1, 1, 0}, false, false, true},
        {"stays in front", {1, 1, 2}, {1, 1, 1}, false, false, false},
        {"stays behind", {1, 1, -1}, {1, 1, -2}, false, false, false},
        {"in the plane, across", {-1, 1, 0}, {5, 1, 0}, false, false, false},
        {"in the plane, along an edge", {0, 0, 0}, {4, 0, 0}, false, false, false},
        {"of length zero, on the face", {1, 1, 0}, {1, 1, 0}, false, false, false},
        {"of length zero, in space", {1, 1, 1}, {1, 1, 1}, false, false, false},
        {"through an edge, from the front", {1, 0, 1}, {1, 0, -1}, true, false, true},
        {"through the slanted edge, from the back", {1, 3, -1}, {3, 1, 1}, false, true, true},
        {"through a corner, from the front", {0, 0, 1}, {0, 0, -1}, true, false, true},
        {"starts on a corner, goes in", {4, 0, 0}, {4, 1, -1}, true, false, true},
        {"past an edge", {1, -1e-300, 1}, {1, -1e-300, -1}, false, false, false},
        {"past a corner by the least there is", {4, 0, 1}, {std::nextafter(4.0, 5.0), 0, -1}, false, false, false},
    };
    for (const Case& c : cases) {
        const S segment{c.from, c.to};
        EXPECT_EQ(mesh.any_hit(segment), c.front) << c.what;
        EXPECT_EQ(mesh.any_hit(segment, {.sides = Sides::back}), c.back) << c.what;
        EXPECT_EQ(mesh.any_hit(segment, {.sides = Sides::both}), c.both) << c.what;
        const auto hit = mesh.first_hit(segment, {.sides = Sides::both});
        ASSERT_EQ(hit.has_value(), c.both) << c.what;
        EXPECT_TRUE(!hit || hit->side == (c.front ? Sides::front : Sides::back)) << c.what;
    }
}

// A hit from the back on a plane that the exact fraction rounds to: a point on that plane is in front of it already.
TEST(Contract, from_both_sides_the_point_stays_on_its_own) {
    const CollisionMesh<double> mesh(corner_triangle().view());
    for (const double to : {0.0, 1e-300, 1e-9, 1.0, 3.0}) {
        const S up{V(1, 1, -1), V(1.25, 1, to)};
        const auto hit = mesh.first_hit(up, {.sides = Sides::both});
        ASSERT_TRUE(hit) << to;
        EXPECT_EQ(hit->side, Sides::back);
        EXPECT_LT(hit->point[2], 0) << to;
        EXPECT_FALSE(mesh.any_hit({up.from, hit->point}, {.sides = Sides::both})) << to;
        EXPECT_TRUE(mesh.any_hit({hit->point, up.to}, {.sides = Sides::both})) << to;
    }
}

// A point that rests on the plane, in the face, on an edge and on a corner, leaves it to the front and stops at it to
// the back.
TEST(Contract, from_both_sides_a_resting_point_leaves_to_the_front) {
    const CollisionMesh<double> mesh(corner_triangle().view());
    for (const V& at : {V(1, 1, 0), V(2, 0, 0), V(2, 2, 0), V(0, 0, 0), V(4, 0, 0)})
        for (const double dx : {-1.0, 0.0, 1e-3}) {
            EXPECT_FALSE(mesh.any_hit({at, at + V(dx, 0, 1e-300)}, {.sides = Sides::both})) << at.transpose();
            EXPECT_FALSE(mesh.any_hit({at, at + V(dx, 0, 0)}, {.sides = Sides::both})) << at.transpose();
            EXPECT_TRUE(mesh.any_hit({at, at + V(dx, 0, -1e-300)}, {.sides = Sides::both})) << at.transpose();
            EXPECT_TRUE(mesh.any_hit({at + V(dx, 0, -1e-300), at}, {.sides = Sides::both})) << "back onto it";
        }
}

TEST(Contract, features_and_values) {
    const CollisionMesh<double> mesh(corner_triangle().view());
    const auto at = [&](double x, double y) { return mesh.first_hit({V(x, y, 1), V(x, y, -3)}); };
    const auto face = at(1, 2);
    ASSERT_TRUE(face);
    EXPECT_EQ(face->feature, Feature::face);
    EXPECT_EQ(face->exact_fraction, 0.25);
    EXPECT_LT(face->fraction, 0.25);
    EXPECT_GT(face->fraction, 0.25 - 1e-15);
    EXPECT_EQ(face->normal, V(0, 0, 1));
    EXPECT_EQ(face->barycentric, V(0.25, 0.25, 0.5));
    EXPECT_FALSE(face->at_start);
    EXPECT_GE(face->point[2], 0);
    EXPECT_LT(face->point[2], 1e-14);

    const auto expect_feature = [&](double x, double y, Feature feature, int index) {
        const auto hit = at(x, y);
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->feature, feature) << x << ' ' << y;
        EXPECT_EQ(hit->feature_index, index) << x << ' ' << y;
    };
    expect_feature(1, 0, Feature::edge, 0);  // from corner 0 to corner 1
    expect_feature(2, 2, Feature::edge, 1);
    expect_feature(0, 3, Feature::edge, 2);
    expect_feature(0, 0, Feature::vertex, 0);
    expect_feature(4, 0, Feature::vertex, 1);
    expect_feature(0, 4, Feature::vertex, 2);

    const auto back = mesh.first_hit({V(1, 1, -1), V(1, 1, 1)}, {.sides = Sides::back});
    ASSERT_TRUE(back);
    EXPECT_EQ(back->normal, V(0, 0, 1)) << "the normal is not turned round";

    const auto start = mesh.first_hit({V(1, 1, 0), V(1, 2, -1)});
    ASSERT_TRUE(start);
    EXPECT_TRUE(start->at_start);
    EXPECT_EQ(start->fraction, 0);
    EXPECT_EQ(start->exact_fraction, 0);
    EXPECT_EQ(start->point, V(1, 1, 0));
}

TEST(Contract, degenerate_triangles_never_hit) {
    for (const auto& corners : {std::array<V, 3>{V(0, 0, 0), V(0, 0, 0), V(1, 0, 0)},
                                {V(0, 0, 0), V(1, 1, 1), V(3, 3, 3)},
                                {V(2, 2, 2), V(2, 2, 2), V(2, 2, 2)}}) {
        const TriangleSoup<double> soup{{corners[0], corners[1], corners[2]}, {{0, 1, 2}}, {}};
        const CollisionMesh<double> mesh(soup.view());
        EXPECT_EQ(mesh.statistics().degenerate, 1U);
        EXPECT_EQ(mesh.statistics().faces, 1U);
        for (const V& target : corners)
            EXPECT_FALSE(mesh.any_hit({target + V(1, 2, 3), target - V(1, 2, 3)}, {.sides = Sides::both}));
    }
}

TEST(Contract, coordinates_at_both_ends_of_the_range) {
    for (const double size : {1e300, 1e-300, 1e-310, 4 * std::numeric_limits<double>::denorm_min()}) {
        const CollisionMesh<double> mesh(moved<double>(corner_triangle(), size / 4, V(0, 0, 0)).view());
        const S through{size * V(0.25, 0.25, 0.25), size * V(0.25, 0.25, -0.25)};
        const auto hit = mesh.first_hit(through);
        ASSERT_TRUE(hit) << size;
        EXPECT_EQ(hit->exact_fraction, 0.5) << size;
        EXPECT_EQ(hit->barycentric, V(0.5, 0.25, 0.25)) << size;
        EXPECT_FALSE(mesh.any_hit({through.from, hit->point})) << size;
        EXPECT_GT(hit->fraction, size > 1e-320 ? 0.49 : -1) << size;
        EXPECT_FALSE(mesh.any_hit({size * V(0.75, 0.5, 0.25), size * V(0.75, 0.5, -0.25)})) << size;
        EXPECT_EQ(mesh.first_hit({size * V(0.5, 0.5, 0.25), size * V(0.5, 0.5, -0.25)}).value().feature, Feature::edge);
    }
}

}  // namespace
}  // namespace pierce::test
