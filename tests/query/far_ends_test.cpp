// Segments whose one end is as far away as numbers go, or both are, on meshes of any size.
//
// Ends of 1e307 and more were lost on meshes narrower than a half: in units of the mesh, about its width, they
// overflowed. The clipped segment then was its near end alone, or NaN, and no box was touched.
#include <gtest/gtest.h>

#include <pierce/pierce.h>
#include <support/expect_hit.h>
#include <support/meshes.h>
#include <support/naive.h>
#include <support/random.h>

namespace pierce::test {
namespace {

using V = Vec3<double>;

TriangleSoup<double> sheet(double width) {
    TriangleSoup<double> soup;
    constexpr int k_side = 10;
    for (int i = 0; i <= k_side; ++i)
        for (int j = 0; j <= k_side; ++j)
            soup.positions.push_back(width *
                                     V(i / double(k_side) - 0.5, j / double(k_side) - 0.5, 0.001 * (i * j % 3)));
    for (std::uint32_t i = 0; i < k_side; ++i)
        for (std::uint32_t j = 0; j < k_side; ++j) {
            const std::uint32_t a = i * (k_side + 1) + j;
            soup.triangles.push_back({a, a + k_side + 1, a + 1});
            soup.triangles.push_back({a + 1, a + k_side + 1, a + k_side + 2});
        }
    return soup;
}

TEST(FarEnds, are_as_good_as_near_ones) {
    Random random(71);
    int hits = 0;
    for (const double width : {1e-300, 1e-30, 0.01, 0.4, 2.0, 1e10})
        for (const Broadphase broadphase : {Broadphase::tree, Broadphase::grid}) {
            const TriangleSoup<double> soup = sheet(width);
            const CollisionMesh<double> mesh(soup.view(), {.broadphase = broadphase});
            const NaiveMesh<double> naive(soup.view());
            for (int i = 0; i < 400; ++i) {
                const double far = std::ldexp(random.between(0.5, 1), random.between_ints(980, 1023));
                const V target = 0.4 * width * random.in_cube();
                V way = random.direction();
                if (random.chance(0.3)) way = V(0, 0, 1);
                const V there = target + far * way;
                const V other = random.chance(0.2) ? V(target - 0.7 * far * way) : V(target - width * way);
                const Segment<double> segment =
                    random.chance(0.5) ? Segment<double>{there, other} : Segment<double>{other, there};
                QueryOptions options;
                options.sides = Sides::both;
                const auto expected = naive.first_hit(segment, options);
                ASSERT_TRUE(same_answer(mesh.first_hit(segment, options), expected)) << width << ' ' << far;
                std::array<std::optional<Hit<double>>, 1> batch;
                mesh.first_hits(std::span(&segment, 1), batch, options);
                ASSERT_TRUE(same_answer(batch[0], expected)) << width << ' ' << far;
                ASSERT_EQ(mesh.any_hit(segment, options), expected.has_value());
                hits += expected ? 1 : 0;
            }
        }
    EXPECT_GT(hits, 1500);
}

// Both ends far away: from 2^30 mesh sizes on boxes used to be told apart less and less well, as the point where the
// segment enters the box was computed in double, and from 2^46 on everything was visited.
TEST(FarEnds, both_ends_cost_what_the_part_in_the_box_costs) {
    const TriangleSoup<double> soup = bumpy_sphere(40);
    const CollisionMesh<double> mesh(soup.view());
    Random random(72);
    for (int exponent = 4; exponent <= 46; exponent += 6) {
        QueryCounters far;
        QueryCounters near;
        QueryCounters of_rays;
        for (int i = 0; i < 200; ++i) {
            // Through points near the middle, within what doubles that far away are apart.
            const V d = std::ldexp(1.0, exponent) * random.direction();
            const V by = 0.5 * random.in_cube();
            const V from = by - d;
            const V to = by + random.between(1, 3) * d;
            const auto hit = mesh.first_hit({from, to}, {.counters = &far});
            const V in = -2 * d.normalized() + by;
            const V out = 2 * d.normalized() + by;
            ASSERT_EQ(mesh.first_hit({in, out}, {.counters = &near}).has_value(), hit.has_value());
            ASSERT_EQ(mesh.first_hit(Ray<double>{from, d}, {.counters = &of_rays}).has_value(), hit.has_value());
        }
        EXPECT_LE(far.nodes, near.nodes * 2) << exponent;
        EXPECT_LE(far.clusters, near.clusters * 2) << exponent;
        EXPECT_LE(of_rays.nodes, near.nodes * 2) << exponent;
        EXPECT_LE(of_rays.clusters, near.clusters * 2) << exponent;
    }
}

}  // namespace
}  // namespace pierce::test
