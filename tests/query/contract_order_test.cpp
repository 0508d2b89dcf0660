// Which of several hits is the first, and which count at all: ties, hits closer than a double can tell, `max_fraction`,
// sides, and what `all_hits` leaves out. Small cases that can be checked by eye.
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/expect_hit.h>
#include <support/meshes.h>

namespace pierce::test {
namespace {

using V = Vec3<double>;
using S = Segment<double>;

TEST(ContractOrder, ties_go_to_the_smallest_face) {
    // A fan of four around the origin, with the faces numbered by the caller in another order; the fifth doubles one of
    // them.
    TriangleSoup<double> soup{{V(0, 0, 0), V(1, 0, 0), V(0, 1, 0), V(-1, 0, 0), V(0, -1, 0)},
                              {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {0, 2, 3}},
                              {40, 30, 20, 10, 5}};
    for (const double cell : {1e300, 1.0, 0.25}) {
        const CollisionMesh<double> mesh(soup.view(), {.cell_size = cell});
        const auto face_at = [&](double x, double y) {
            const auto hit = mesh.first_hit({V(x, y, 1), V(x, y, -1)});
            return hit ? static_cast<int>(hit->face) : -1;
        };
        EXPECT_EQ(face_at(0, 0), 5);
        EXPECT_EQ(face_at(0.5, 0), 10);
        EXPECT_EQ(face_at(0, 0.5), 5);
        EXPECT_EQ(face_at(0, -0.5), 10);
        EXPECT_EQ(face_at(-0.25, 0.25), 5);
        EXPECT_EQ(face_at(-0.25, -0.25), 20);
        std::array<Hit<double>, 8> all;
        ASSERT_EQ(mesh.all_hits({V(0, 0, 1), V(0, 0, -1)}, all), 5U);
        EXPECT_EQ(all[0].face, 5U);
        EXPECT_EQ(all[0].triangle, 4U);
        EXPECT_EQ(all[4].face, 40U);
        EXPECT_EQ(mesh.mesh_report().duplicates, 1U);
    }
}

TEST(ContractOrder, order_is_exact_where_doubles_see_a_tie) {
    // Two faces a hair apart: one is tilted so that it comes first at x = 1 by 2^-60 of the way, far below a double's
    // step there.
    const double hair = 0x1p-60;
    TriangleSoup<double> soup{{V(0, 0, 0), V(4, 0, 0), V(0, 4, 0), V(0, 0, 0), V(4, 0, 4 * hair), V(0, 4, 0)},
                              {{0, 1, 2}, {3, 4, 5}},
                              {}};
    const S segment{V(1, 1, 1), V(1, 1, -1)};
    const auto hit = CollisionMesh<double>(soup.view()).first_hit(segment);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->face, 1U);
    std::swap(soup.triangles[0], soup.triangles[1]);
    const auto swapped = CollisionMesh<double>(soup.view()).first_hit(segment);
    ASSERT_TRUE(swapped);
    EXPECT_EQ(swapped->face, 0U);
}

TEST(ContractOrder, max_fraction_is_exact_and_closed) {
    const CollisionMesh<double> mesh(corner_triangle().view());
    const S half{V(1, 1, 1), V(1, 1, -1)};
    EXPECT_TRUE(mesh.any_hit(half, {.max_fraction = 0.5}));
    EXPECT_FALSE(mesh.any_hit(half, {.max_fraction = std::nextafter(0.5, 0.0)}));
    const S third{V(1, 1, 1), V(1, 1, -2)};  // at 1/3, which no double is: the nearest one lies below
    EXPECT_FALSE(mesh.any_hit(third, {.max_fraction = 1.0 / 3}));
    EXPECT_TRUE(mesh.any_hit(third, {.max_fraction = std::nextafter(1.0 / 3, 1.0)}));
    // The same on an edge, which only exact arithmetic decides.
    EXPECT_FALSE(mesh.any_hit({V(1, 0, 1), V(1, 0, -2)}, {.max_fraction = 1.0 / 3}));
    EXPECT_TRUE(mesh.any_hit({V(1, 0, 1), V(1, 0, -2)}, {.max_fraction = std::nextafter(1.0 / 3, 1.0)}));
    const S start{V(1, 1, 0), V(1, 1, -1)};
    EXPECT_TRUE(mesh.any_hit(start, {.max_fraction = 0}));
    EXPECT_FALSE(mesh.any_hit(half, {.max_fraction = 0}));
    EXPECT_FALSE(mesh.any_hit(half, {.max_fraction = -1}));
    EXPECT_FALSE(mesh.any_hit(half, {.max_fraction = std::numeric_limits<double>::denorm_min()}));
    EXPECT_TRUE(mesh.any_hit(half, {.max_fraction = 7}));
    EXPECT_FALSE(mesh.any_hit(start, {.max_fraction = std::numeric_limits<double>::quiet_NaN()}));
}

TEST(ContractOrder, a_nearer_hit_beyond_the_limit_of_sides_does_not_hide_one) {
    // Sides are looked at before the minimum is taken: the back of the first face does not hide the front of the
    // second.
    TriangleSoup<double> soup{{V(0, 0, 2), V(0, 4, 2), V(4, 0, 2), V(0, 0, 1), V(4, 0, 1), V(0, 4, 1)},
                              {{0, 1, 2}, {3, 4, 5}},
                              {}};
    const auto hit = CollisionMesh<double>(soup.view()).first_hit({V(1, 1, 3), V(1, 1, 0)});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->face, 1U);
}

TEST(ContractOrder, all_hits_counts_what_it_leaves_out) {
    TriangleSoup<double> soup;
    for (std::uint32_t i = 0; i < 10; ++i) {
        for (const V& p : {V(0, 0, i), V(4, 0, i), V(0, 4, i)}) soup.positions.push_back(p);
        soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const CollisionMesh<double> mesh(soup.view());
    const S down{V(1, 1, 20), V(1, 1, -20)};
    std::array<Hit<double>, 12> all;
    ASSERT_EQ(mesh.all_hits(down, all), 10U);
    for (std::size_t i = 0; i < 10; ++i) {
        EXPECT_EQ(all[i].face, 9 - i);
        // The way to each point passes the faces before, and no other.
        EXPECT_EQ(mesh.all_hits({down.from, all[i].point}, {}), i);
    }
    std::array<Hit<double>, 3> some;
    EXPECT_EQ(mesh.all_hits(down, some), 10U);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(same_bits(some[i], all[i]));
    EXPECT_EQ(mesh.all_hits(down, {}), 10U);
}

}  // namespace
}  // namespace pierce::test
