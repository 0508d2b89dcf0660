// Segments whose one end is as far away as numbers go, or both are, on meshes of any size.
//
// Ends of 1e307 and more were lost on meshes narrower than a half: in units of the mesh, about its width, they
// overflowed. The clipped segment then was its near end alone, or NaN, and no box was touched.
#include <gtest/gtest.h>

#include <pierce/pierce.h>
#include <support/expect_hit.h>
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
            soup.positions.push_back(
                width * V(i / double(k_side) - 0.5, j / double(k_side) - 0.5, 0.001 * (i * j % 3)));
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

}  // namespace
}  // namespace pierce::test
