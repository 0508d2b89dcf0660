// The way from a segment's start to the point of its hit is free, rounded as that point is, of triangles that the
// segment itself misses.
//
// What the wide kernels refused for the segment is not asked again for the way to the point: their bounds have to allow
// for its rounding.
// With no room for it, or where a start that lies on a plane was taken to be on one side of it because the segment's
// end is, every other test passed: random meshes have no triangles within a rounding of a segment. Here there are
// blades, planes through two points that are within some roundings of the segment, and planes through its start. The
// judge is the naive twin.
#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <pierce/triangle_soup.h>
#include <support/expect_hit.h>
#include <support/meshes.h>
#include <support/naive.h>
#include <support/random.h>
#include <Eigen/Geometry>

namespace pierce::test {
namespace {

template <class Scalar>
struct Blades {
    TriangleSoup<Scalar> soup;
    Segment<Scalar> segment;

    Blades(Random& random, double offset) {
        const Vec3<double> center = offset * random.direction();
        const Vec3<double> from = center + random.in_cube();
        const Vec3<double> to = center + random.in_cube();
        const Vec3<double> way = to - from;
        segment = {from.cast<Scalar>(), to.cast<Scalar>()};
        // A few units in the last place of the coordinates.
        const double noise = 4 * (offset + 1) * static_cast<double>(std::numeric_limits<Scalar>::epsilon());
        const Vec3<double> across = way.cross(random.direction()).normalized();
        const Vec3<double> hit = from + random.between(0.01, 1) * way;
        add(hit + across + random.in_cube() * 0.3, hit - across, hit + way.cross(across).normalized());
        add(hit - way.cross(across).normalized(), hit + across, hit - across);
        for (int i = 0; i < 12; ++i) {
            const double first = random.chance(0.5) ? 0 : random.unit();
            const Vec3<double> a = from + first * way + noise * random.in_cube();
            const Vec3<double> b = from + random.between(0, 1.2) * way + noise * random.in_cube();
            const Vec3<double> side = way.cross(random.direction()).normalized();
            const double width = std::exp(random.between(-8, 0));
            if (i % 3 == 0) {
                const Vec3<double> start =
                    segment.from.template cast<double>() + (random.chance(0.5) ? noise : 0) * random.in_cube();
                add(start + width * side, start - width * side,
                    start + random.between(-0.5, 0.5) * way + random.in_cube());
            } else {
                add(a, b, a + width * side + random.between(-0.3, 0.3) * way);
            }
        }
    }

  private:
    void add(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c) { add_triangle(soup, a, b, c); }
};

template <class Scalar>
void compare() {
    Random random(7);
    std::uint64_t retreats = 0;
    int hits = 0;
    constexpr int k_rounds = 20000;
    for (int i = 0; i < k_rounds; ++i) {
        const Blades<Scalar> blades(random, std::array{0.0, 10.0, 1e3, 1e5}[random.below(4)]);
        const CollisionMesh<Scalar> mesh(blades.soup.view(),
                                         {.cell_size = random.chance(0.5) ? 0 : std::exp(random.between(-6, 1))});
        const NaiveMesh<Scalar> naive(blades.soup.view());
        QueryCounters counters;
        QueryOptions options;
        options.sides = std::array{Sides::front, Sides::back, Sides::both}[random.below(3)];
        options.counters = &counters;
        const auto expected = naive.first_hit(blades.segment, options);
        ASSERT_TRUE(same_answer(mesh.first_hit(blades.segment, options), expected)) << i;
        retreats += counters.retreats;
        std::array<std::optional<Hit<Scalar>>, 1> of_batch;
        mesh.first_hits(std::span(&blades.segment, 1), of_batch, options);
        ASSERT_TRUE(same_answer(of_batch[0], expected)) << i;
        hits += expected ? 1 : 0;
    }
    EXPECT_GT(hits, k_rounds / 2);
    EXPECT_GT(retreats, 100U);
    std::cout << hits << " hits, " << retreats << " points were not free\n";
}

// A large wall across the way, in a level of its own, and in front of it a row of small triangles that begins right
// beside the segment; a cell of theirs is six units in the last place of the coordinates. The segment passes by the box
// of their level, the way to its rounded point does not. That level was not asked at all, and the other one's triangles
// were taken for all that could be in the way: one point of twenty was behind the row.
template <class Scalar>
void pass_by_a_level(double far, double unit) {
    Random random(3);
    int hits = 0;
    for (int i = 0; i < 1000; ++i) {
        TriangleSoup<Scalar> soup;
        const auto point = [&](const Vec3<double>& p) -> Vec3<Scalar> {
            return ((p * unit).array() + far).matrix().template cast<Scalar>();
        };
        const auto add = [&](const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c) {
            const auto first = static_cast<std::uint32_t>(soup.positions.size());
            for (const Vec3<double>& p : {a, b, c}) soup.positions.push_back(point(p));
            soup.triangles.push_back({first, first + 1, first + 2});
        };
        add({0, 0, -3}, {0, 0, 3}, {4, 4, 0});
        add({0, 0, 3}, {0, 0, -3}, {4, 4, 0});
        for (int x = 4; x <= 100; x += 4) add({x * 1.0, x * 1.0, -3}, {x * 1.0, x * 1.0, 3}, {x + 4.0, x + 4.0, 0});
        const double w = random.between_ints(2, 7);
        add({w - 400, -400, -300}, {w + 400, 400, -300}, {w + 1, 1, 500});
        add({w + 400, 400, -300}, {w - 400, -400, -300}, {w + 1, 1, 500});
        const CollisionMesh<Scalar> mesh(soup.view(), {.cell_size = 6 * unit});
        const NaiveMesh<Scalar> naive(soup.view());
        for (int q = 0; q < 8; ++q) {
            const double a = random.between_ints(20, 90);
            const double b = random.between_ints(50, 90);
            const Segment<Scalar> segment = {
                point({-a, a - random.between_ints(0, 3), random.between_ints(-2, 2) * 1.0}),
                point({b, -b - random.between_ints(0, 3), random.between_ints(-2, 2) * 1.0})};
            QueryOptions options;
            options.sides = Sides::both;
            const auto expected = naive.first_hit(segment, options);
            ASSERT_TRUE(same_answer(mesh.first_hit(segment, options), expected)) << i;
            std::array<std::optional<Hit<Scalar>>, 1> of_batch;
            mesh.first_hits(std::span(&segment, 1), of_batch, options);
            ASSERT_TRUE(same_answer(of_batch[0], expected)) << i;
            hits += expected ? 1 : 0;
        }
    }
    EXPECT_GT(hits, 4000);
}

TEST(VerifiedPoint, is_free_of_a_level_that_the_segment_passes_by) {
    pass_by_a_level<float>(9e6, 1);
    pass_by_a_level<float>(1e6, 0.125);
}

TEST(VerifiedPoint, is_free_of_blades_in_float) { compare<float>(); }
TEST(VerifiedPoint, is_free_of_blades_in_double) { compare<double>(); }

}  // namespace
}  // namespace pierce::test
