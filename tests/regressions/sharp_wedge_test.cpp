// A step ends at a wall, and two edges on its way leave a wedge of 3.3 degrees through which the wall is seen: places
// for the point that are a grain off the wall lie 6 units in the last place from the true point. The search for a point
// of all half-spaces took Hildreth's method for it alone, which comes nearer by (cos a)^2 a sweep where two planes meet
// at an angle a, and was given up after 64 sweeps: below 15 degrees it found nothing. The lattice of one unit that is
// tried then had no place in the wedge either, and the point stayed near the step's start, 4.6 million units away.
//
// Seen once in 10^6 hits of the soak PlaceSoak.points_are_near_the_true_ones on a made building of cubes.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <pierce/pierce.h>
#include <query/half_spaces.h>
#include <query/place.h>
#include <support/meshes.h>

namespace pierce::test {
namespace {

TEST(SharpWedge, has_a_place_near_the_wall) {
    const TriangleSoup<float> soup = moved<float>(polycube(4, 0.5, 1, 3), 0.1, {0, 0, 0});
    const CollisionMesh<float> mesh(soup.view());
    const Segment<float> step{{0x1.9f77b6p-4F, 0x1.32f55cp-4F, 0x1.23aab8p-3F},
                              {0x1.71a8b8p-4F, 0x1.15121ap-2F, 0x1.2f17dcp-1F}};
    const auto hit = mesh.first_hit(step);
    ASSERT_TRUE(hit);
    float largest = 0;
    for (const Vec3<float>& p : soup.positions) largest = std::max(largest, p.cwiseAbs().maxCoeff());
    const double unit = detail::last_place<float>(largest);
    EXPECT_LT((hit->point - hit->position).cast<double>().norm(), (detail::k_reach_units + 1) * unit);
    EXPECT_FALSE(mesh.any_hit({step.from, hit->point}));
}

// Two half-spaces whose planes meet at an angle, and a third one that does not matter: their nearest point is on the
// line that the planes share, 11 away.
TEST(SharpWedge, half_spaces_have_a_nearest_point_at_any_angle) {
    for (const double degrees : {0.2, 1.0, 3.3, 8.0, 14.0, 40.0, 90.0}) {
        const double half = degrees / 360 * std::numbers::pi;
        const double least = 11 * std::sin(half);
        detail::HalfSpaces wedge;
        wedge.push({{0, 0, 1}, -1});
        wedge.push({{std::cos(half), std::sin(half), 0}, least});
        wedge.push({{-std::cos(half), std::sin(half), 0}, least});
        detail::Point x{};
        ASSERT_TRUE(wedge.nearest(12, x)) << degrees;
        EXPECT_NEAR(x[0], 0, 0.02) << degrees;
        EXPECT_NEAR(x[1], 11, 0.12) << degrees;
        EXPECT_NEAR(x[2], 0, 0.02) << degrees;
        EXPECT_FALSE(wedge.nearest(10.5, x)) << degrees;
    }
}

}  // namespace
}  // namespace pierce::test
