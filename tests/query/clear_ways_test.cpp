// The way to a hit's point has no hit, and the point keeps to the start's side, where places are hard to find: in thin
// wedges, with starts nearer to the faces than a grain, at both ends of the number range. Asked of the mesh and of
// rationals, not of the naive twin, which chooses places by the same code.
#include <gtest/gtest.h>
#include <pierce/pierce.h>
#include <support/meshes.h>
#include <support/oracles.h>
#include <support/random.h>

namespace pierce::test {
namespace {

using V = Vec3<double>;
using Q = RationalOracle::Q;

V in_cube(Random& random) { return random.in_cube(); }

// Two faces that meet in an edge, some units in the last place to a part of their size apart, and segments that end on
// the edge, or a little beyond it, from starts between the faces. In some 0.3 % of these no near place is clear, and
// points back along the way are taken: their rounding led behind the hit's own face, which nothing else asks about: 373
// of 112,000 ways were hit.
template <class Scalar>
void check_wedges(double offset) {
    Random random(41);
    int hits = 0;
    int back = 0;
    for (const Sides sides : {Sides::front, Sides::back, Sides::both}) {
        for (int i = 0; i < 4'000; ++i) {
            const V shift(offset, offset, -offset);
            const std::array<V, 3> first = {in_cube(random), in_cube(random), in_cube(random)};
            const double wide = std::pow(std::numeric_limits<Scalar>::epsilon(), random.between(0.1, 1));
            const std::array<V, 4> corners = {first[0], first[1], first[2], first[2] + wide * in_cube(random)};
            TriangleSoup<Scalar> soup;
            for (const V& corner : corners) soup.positions.push_back((corner + shift).cast<Scalar>());
            soup.triangles = {{0, 1, 2}, {1, 0, 3}};
            if (random.chance(0.5)) soup.triangles = {{0, 2, 1}, {1, 3, 0}};
            const CollisionMesh<Scalar> mesh(soup.view());
            for (int k = 0; k < 4; ++k) {
                const double share = random.unit();
                const V inside =
                    first[0] + random.between(0.05, 0.45) * (first[2] - first[0]) + 0.3 * (first[1] - first[0]);
                const V from = inside + 0.7 * wide * in_cube(random);
                V to = share * first[0] + (1 - share) * first[1];
                if (random.chance(0.5)) to += 0.3 * (to - from);
                const Segment<Scalar> segment{(from + shift).cast<Scalar>(), (to + shift).cast<Scalar>()};
                const auto hit = mesh.first_hit(segment, {.sides = sides});
                if (!hit) continue;
                ++hits;
                back += (hit->point - hit->position).norm() > (hit->position - segment.from).norm() / 4 ? 1 : 0;
                ASSERT_FALSE(mesh.any_hit({segment.from, hit->point}, {.sides = sides})) << i;
                if (hit->at_start) continue;
                const auto corner_at = [&](std::size_t c) {
                    return detail::to_point(soup.positions[soup.triangles[hit->triangle][c]]);
                };
                const detail::Corners face = {corner_at(0), corner_at(1), corner_at(2)};
                const RationalOracle way({detail::to_point(segment.from), detail::to_point(hit->point.vec())}, face);
                ASSERT_FALSE(way.hit(Sides::both)) << i;
            }
        }
    }
    EXPECT_GT(hits, 20'000);
    EXPECT_GT(back, 15) << "none that the test is for";
}

TEST(ClearWays, of_thin_wedges_in_float) {
    check_wedges<float>(0);
    check_wedges<float>(1000);
}
TEST(ClearWays, of_thin_wedges_in_double) {
    check_wedges<double>(0);
    check_wedges<double>(1000);
}

// Above 2^200 nothing is known but by exact arithmetic. From 1e78 to 1e154 the square of a normal is infinite, and so
// was its error: the normal was 0.
TEST(ClearWays, normals_are_unit_vectors_at_any_size) {
    for (int exponent = -1000; exponent < 1020; exponent += 7) {
        const double size = std::ldexp(1.0, exponent);
        const TriangleSoup<double> soup{{{0, 0, 0}, {size, 0, 0}, {0, size, size / 2}}, {{0, 1, 2}}, {}};
        const auto hit =
            CollisionMesh<double>(soup.view()).first_hit({{size / 4, size / 4, size}, {size / 4, size / 4, -size}});
        ASSERT_TRUE(hit) << exponent;
        const V expected = V(0, -1, 2).normalized();
        EXPECT_LT((hit->normal - expected).norm(), 8 * std::numeric_limits<double>::epsilon()) << exponent;
    }
}

// A flat face, and clear places straight off it: at 2^1014 and above units were counted by way of 2^60 of them, which
// is infinite, and among subnormal numbers a grain was asked for and a little more.
TEST(ClearWays, places_are_near_at_any_size) {
    for (const int exponent : {-1030, -1022, -1021, -1020, -900, 0, 900, 1013, 1014, 1015, 1016, 1020, 1022}) {
        const double size = std::ldexp(1.0, exponent);
        const TriangleSoup<double> soup{{{0, 0, 0}, {size, 0, 0}, {0, size, 0}}, {{0, 1, 2}}, {}};
        const CollisionMesh<double> mesh(soup.view());
        const Segment<double> segment{{size / 8, size / 4, size / 1024}, {3 * size / 8, size / 4, -size / 1024}};
        const auto hit = mesh.first_hit(segment);
        ASSERT_TRUE(hit) << exponent;
        const double unit = std::max(std::ldexp(1.0, exponent - 52), std::numeric_limits<double>::denorm_min());
        const auto units = [&](int k) { return (hit->point[k] - hit->position[k]) / unit; };
        EXPECT_LT(std::hypot(units(0), units(1), units(2)), 12) << exponent;
        EXPECT_GE(units(2), 4) << exponent;
        EXPECT_FALSE(mesh.any_hit({segment.from, hit->point})) << exponent;
    }
}

}  // namespace
}  // namespace pierce::test
