// Meshes without poses: the world answers as one mesh of all their triangles does, exactly.
#include <gtest/gtest.h>
#include <pierce/world.h>
#include <support/expect_hit.h>
#include <support/meshes.h>
#include <support/segments.h>
#include <world/naive_world.h>

namespace pierce::test {
namespace {

template <class Scalar>
class StillWorld : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(StillWorld, Scalars);

template <class Scalar>
struct Both {
    World<Scalar> world;
    TriangleSoup<Scalar> soup;
    std::optional<CollisionMesh<Scalar>> merged;
    std::vector<std::uint32_t> first;  ///< of each mesh, its first triangle in the merged one

    explicit Both(const std::vector<TriangleSoup<Scalar>>& soups) {
        for (const TriangleSoup<Scalar>& part : soups) {
            first.push_back(static_cast<std::uint32_t>(soup.triangles.size()));
            append(soup, part);
            EXPECT_EQ(world.add(shared_mesh(part)).index, first.size() - 1);
        }
        merged.emplace(soup.view());
    }

    /// What was hit, as the merged mesh calls it; the point is left to itself: its grain is that of another mesh.
    [[nodiscard]] Hit<Scalar> as_merged(const WorldHit<Scalar>& x, const Hit<Scalar>& like) const {
        Hit<Scalar> hit = x.hit;
        hit.face += first[x.mesh.index];
        hit.triangle += first[x.mesh.index];
        hit.point = like.point;
        hit.fraction = like.fraction;
        return hit;
    }
};

template <class Scalar>
std::vector<TriangleSoup<Scalar>> parts(std::uint64_t seed, double offset) {
    const Vec3<double> shift(offset, -offset, offset);
    std::vector<TriangleSoup<Scalar>> out;
    // On one lattice: faces that coincide, edges on faces, vertices on edges. The same mesh twice. One that is smooth.
    for (std::uint64_t i = 0; i < 4; ++i) out.push_back(moved<Scalar>(polycube(3, 0.4, 2, seed + i % 3), 1, shift));
    out.push_back(moved<Scalar>(polycube(2, 0.7, 4, seed), 1, shift - Vec3<double>(2, 1, 0)));
    out.push_back(moved<Scalar>(bumpy_sphere(3), 3, shift + Vec3<double>(3, 3, 3)));
    out.push_back({});
    out.push_back(moved<Scalar>(terrain(6, 0.2, seed), 4, shift + Vec3<double>(3, 3, 2)));
    return out;
}

template <class Scalar>
Segment<Scalar> lattice_segment(double offset, Random& random) {
    const auto point = [&] {
        const double x = random.between_ints(-4, 20) * 0.5 + offset;
        const double y = random.between_ints(-4, 20) * 0.5 - offset;
        return Vec3<double>(x, y, random.between_ints(-4, 20) * 0.5 + offset).template cast<Scalar>().eval();
    };
    const Vec3<Scalar> from = point();
    return {from, point()};
}

TYPED_TEST(StillWorld, answers_as_one_mesh) {
    using Scalar = TypeParam;
    std::size_t hits = 0;
    std::size_t ties = 0;
    for (const double offset : {0.0, 1024.0, 1e6})
        for (const std::uint64_t seed : {1U, 2U, 3U}) {
            const Both<Scalar> both(parts<Scalar>(seed, offset));
            const Extent<Scalar> extent(both.soup.view());
            Random random(seed);
            for (int i = 0; i < 400; ++i) {
                const bool lattice = i % 2 == 0;
                const Segment<Scalar> segment =
                    lattice ? lattice_segment<Scalar>(offset, random) : mixed_segment(both.soup.view(), extent, random);
                const Sides sides = static_cast<Sides>(i % 3);
                const double most = i % 5 == 0 ? random.unit() : std::numeric_limits<double>::infinity();
                const WorldOptions options{.sides = sides, .max_fraction = most};
                const QueryOptions merged{.sides = sides, .max_fraction = most};
                const auto one = both.world.first_hit(segment, options);
                const auto other = both.merged->first_hit(segment, merged);
                ASSERT_EQ(one.has_value(), other.has_value()) << to_text(segment);
                EXPECT_EQ(both.world.any_hit(segment, options), other.has_value());
                if (one) {
                    ++hits;
                    EXPECT_TRUE(same_answer<Scalar>(both.as_merged(*one, *other), other)) << to_text(segment);
                    EXPECT_FALSE(both.merged->any_hit({segment.from, one->hit.point}, {.sides = sides}))
                        << to_text(segment);
                }
                std::array<WorldHit<Scalar>, 24> found;
                std::array<Hit<Scalar>, 24> expected;
                const std::size_t count = both.merged->all_hits(segment, expected, merged);
                ASSERT_EQ(both.world.all_hits(segment, found, options), count);
                for (std::size_t k = 0; k < std::min<std::size_t>(count, 24); ++k) {
                    const auto hit = both.as_merged(found[k], expected[k]);
                    EXPECT_TRUE(same_answer<Scalar>(hit, expected[k])) << to_text(segment);
                    if (k > 0 && found[k].hit.exact_fraction == found[k - 1].hit.exact_fraction &&
                        found[k].mesh != found[k - 1].mesh)
                        ++ties;
                }
                EXPECT_EQ(both.world.crossings(segment), both.merged->crossings(segment));
            }
        }
    EXPECT_GT(hits, 1000U);
    EXPECT_GT(ties, 1000U) << "meshes are hit in the same place";
}

TYPED_TEST(StillWorld, answers_rays_as_one_mesh) {
    using Scalar = TypeParam;
    std::size_t hits = 0;
    for (const double offset : {0.0, 1e6}) {
        const Both<Scalar> both(parts<Scalar>(4, offset));
        const Extent<Scalar> extent(both.soup.view());
        Random random(7);
        for (int i = 0; i < 600; ++i) {
            const Segment<Scalar> segment =
                i % 2 == 0 ? lattice_segment<Scalar>(offset, random) : mixed_segment(both.soup.view(), extent, random);
            Ray<Scalar> ray{segment.from, segment.to - segment.from};
            if (i % 3 == 0) ray.limit = static_cast<Scalar>(0.25 * random.between_ints(0, 8));
            const WorldOptions options{.sides = Sides::both};
            const auto one = both.world.first_hit(ray, options);
            const auto other = both.merged->first_hit(ray, {.sides = Sides::both});
            ASSERT_EQ(one.has_value(), other.has_value()) << i;
            EXPECT_EQ(both.world.any_hit(ray, options), other.has_value());
            EXPECT_EQ(both.world.crossings(ray), both.merged->crossings(ray));
            std::array<WorldHit<Scalar>, 16> found;
            std::array<Hit<Scalar>, 16> expected;
            const std::size_t count = both.merged->all_hits(ray, expected, {.sides = Sides::both});
            ASSERT_EQ(both.world.all_hits(ray, found, options), count);
            for (std::size_t k = 0; k < std::min<std::size_t>(count, 16); ++k)
                EXPECT_TRUE(same_answer<Scalar>(both.as_merged(found[k], expected[k]), expected[k]));
            if (!one) continue;
            ++hits;
            EXPECT_TRUE(same_answer<Scalar>(both.as_merged(*one, *other), other));
            EXPECT_FALSE(both.merged->any_hit({ray.origin, one->hit.point}, {.sides = Sides::both}));
        }
    }
    EXPECT_GT(hits, 300U);
}

TYPED_TEST(StillWorld, winds_as_one_mesh) {
    using Scalar = TypeParam;
    std::vector<TriangleSoup<Scalar>> soups;
    for (std::uint64_t i = 0; i < 5; ++i)
        soups.push_back(moved<Scalar>(polycube(3, 0.5, 2, i), 1, Vec3<double>(double(i), 0, 0)));
    const Both<Scalar> both(soups);
    Random random(3);
    int inside = 0;
    std::vector<Vec3<Scalar>> points;
    for (int i = 0; i < 2000; ++i) points.push_back(lattice_segment<Scalar>(0, random).from);
    std::vector<int> numbers(points.size());
    std::vector<std::uint8_t> contained(points.size());
    both.world.winding_numbers(points, numbers);
    const std::size_t count = both.world.contains_points(points, contained);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const int expected = both.merged->winding_number(points[i]);
        EXPECT_EQ(both.world.winding_number(points[i]), expected);
        EXPECT_EQ(both.world.contains(points[i]), expected != 0);
        EXPECT_EQ(numbers[i], expected);
        EXPECT_EQ(contained[i], expected != 0 ? 1 : 0);
        inside += expected != 0 ? 1 : 0;
    }
    EXPECT_EQ(count, static_cast<std::size_t>(inside));
    EXPECT_GT(inside, 200);
}

// The same square in three meshes: the lowest id is hit, then what is left.
TYPED_TEST(StillWorld, equal_fractions_go_to_the_lowest_id) {
    using Scalar = TypeParam;
    World<Scalar> world;
    const auto mesh = shared_mesh(moved<Scalar>(corner_triangle(), 1, Vec3<double>(0, 0, 0)));
    std::array<MeshId, 3> ids{world.add(mesh), world.add(mesh), world.add(mesh)};
    const Segment<Scalar> segment{{1, 1, 1}, {1, 1, -1}};
    EXPECT_EQ(world.first_hit(segment)->mesh, ids[0]);
    world.remove(ids[0]);
    EXPECT_EQ(world.first_hit(segment)->mesh, ids[1]);
    const MeshId again = world.add(mesh);
    EXPECT_EQ(again.index, ids[0].index) << "its place is used again";
    EXPECT_EQ(world.first_hit(segment)->mesh, again);
    std::array<WorldHit<Scalar>, 3> hits;
    EXPECT_EQ(world.all_hits(segment, hits), 3U);
    for (std::uint32_t i = 0; i < 3; ++i) EXPECT_EQ(hits[i].mesh.index, i);
}

}  // namespace
}  // namespace pierce::test
