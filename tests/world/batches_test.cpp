// Batches of a world, and the caller's arithmetic: the same bits whatever either is like.
#include <gtest/gtest.h>
#include <pierce/world.h>
#include <support/executors.h>
#include <support/expect_hit.h>
#include <support/meshes.h>
#include <support/setting.h>
#include <world/naive_world.h>

namespace pierce::test {
namespace {

template <class Scalar>
class WorldBatches : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(WorldBatches, Scalars);

TYPED_TEST(WorldBatches, batches_give_what_single_calls_give) {
    using Scalar = TypeParam;
    Random random(5);
    World<Scalar> world;
    const auto mesh = shared_mesh(moved<Scalar>(polycube(1, 1, 2, 1), 1, {-1, -1, -1}));
    for (int i = 0; i < 50; ++i) {
        InstanceOptions<Scalar> options;
        options.pose.translation = (9 * random.in_cube()).template cast<Scalar>();
        options.pose.rotation = rotation_of<Scalar>(1, random.between_ints(-3, 3), random.between_ints(-3, 3), 1);
        (void)world.add(mesh, options);
    }
    std::vector<Segment<Scalar>> segments;
    std::vector<Ray<Scalar>> rays;
    std::vector<Vec3<Scalar>> points;
    for (int i = 0; i < 5000; ++i) {
        const Vec3<double> from = 10 * random.in_cube();
        const Vec3<double> to = 10 * random.in_cube();
        segments.push_back({from.cast<Scalar>(), to.cast<Scalar>()});
        rays.push_back({from.cast<Scalar>(), to.cast<Scalar>()});
        points.push_back(from.cast<Scalar>());
    }
    segments[17].from[0] = std::numeric_limits<Scalar>::infinity();
    const Threads threads;
    for (const Executor& executor : {Executor(), Executor(Reversed()), Executor(std::cref(threads))}) {
        std::vector<std::optional<WorldHit<Scalar>>> first(segments.size());
        std::vector<WorldHit<Scalar>> plain(segments.size());
        std::vector<std::optional<WorldHit<Scalar>>> of_rays(segments.size());
        std::vector<std::uint8_t> any(segments.size());
        std::vector<std::uint8_t> any_of_rays(segments.size());
        std::vector<std::uint8_t> inside(segments.size());
        std::vector<int> crossings(segments.size());
        std::vector<int> crossings_of_rays(segments.size());
        std::vector<int> winding(segments.size());
        QueryCounters counters;
        const WorldOptions options{.sides = Sides::both, .counters = &counters};
        const std::size_t count = world.first_hits(segments, first, options, executor);
        EXPECT_EQ(counters.queries, segments.size());
        EXPECT_EQ(world.first_hits(segments, plain, options, executor), count);
        EXPECT_EQ(world.any_hits(segments, any, options, executor), count);
        world.first_hits(rays, of_rays, options, executor);
        world.any_hits(rays, any_of_rays, options, executor);
        world.crossings(segments, crossings, {}, executor);
        world.crossings(rays, crossings_of_rays, {}, executor);
        world.winding_numbers(points, winding, {}, executor);
        world.contains_points(points, inside, {}, executor);
        EXPECT_GT(count, 1000U);
        for (std::size_t i = 0; i < segments.size(); ++i) {
            const auto hit = world.first_hit(segments[i], options);
            ASSERT_EQ(hit.has_value(), first[i].has_value());
            EXPECT_EQ(static_cast<bool>(plain[i]), hit.has_value());
            if (hit) {
                EXPECT_TRUE(same_bits(hit->hit, first[i]->hit) && hit->mesh == first[i]->mesh);
                EXPECT_TRUE(same_bits(hit->hit, plain[i].hit) && hit->mesh == plain[i].mesh);
            } else {
                EXPECT_EQ(plain[i].mesh, MeshId{});
                EXPECT_EQ(plain[i].hit.triangle, no_face);
            }
            EXPECT_EQ(any[i], hit ? 1 : 0);
            const auto of_ray = world.first_hit(rays[i], options);
            ASSERT_EQ(of_ray.has_value(), of_rays[i].has_value());
            EXPECT_TRUE(!of_ray || same_bits(of_ray->hit, of_rays[i]->hit));
            EXPECT_EQ(any_of_rays[i], of_ray ? 1 : 0);
            EXPECT_EQ(crossings[i], world.crossings(segments[i]));
            EXPECT_EQ(crossings_of_rays[i], world.crossings(rays[i]));
            EXPECT_EQ(winding[i], world.winding_number(points[i]));
            EXPECT_EQ(inside[i], world.contains(points[i]) ? 1 : 0);
        }
    }
    std::vector<std::uint8_t> few(3);
    WorldHitArrays<Scalar> short_arrays;
    short_arrays.hits.count = 3;
    EXPECT_THROW(world.sweep_spheres(segments, Scalar(1), {}), std::invalid_argument);
    EXPECT_THROW(world.locate_points(points, {}), std::invalid_argument);
    EXPECT_THROW(world.first_hits(segments, short_arrays), std::invalid_argument);
    EXPECT_THROW(world.any_hits(segments, few), std::invalid_argument);
    EXPECT_THROW(world.contains_points(points, few), std::invalid_argument);
}

TYPED_TEST(WorldBatches, balls_places_arrays_and_rows_give_what_single_calls_give) {
    using Scalar = TypeParam;
    Random random(6);
    World<Scalar> world;
    const auto mesh = shared_mesh(moved<Scalar>(polycube(1, 1, 2, 1), 1, {-1, -1, -1}));
    for (int i = 0; i < 50; ++i) {
        InstanceOptions<Scalar> options;
        options.pose.translation = (5 * random.in_cube()).template cast<Scalar>();
        options.pose.rotation = rotation_of<Scalar>(1, random.between_ints(-3, 3), random.between_ints(-3, 3), 1);
        if (i % 5 == 0) options.pose = {};
        (void)world.add(mesh, options);
    }
    std::vector<Segment<Scalar>> steps;
    std::vector<Ray<Scalar>> rays;
    std::vector<Vec3<Scalar>> points;
    std::vector<Scalar> radii;
    for (int i = 0; i < 1500; ++i) {
        const Vec3<double> from = 6 * random.in_cube();
        const Vec3<double> to = from + random.in_cube();
        steps.push_back({from.cast<Scalar>(), to.cast<Scalar>()});
        rays.push_back({from.cast<Scalar>(), to.cast<Scalar>()});
        const Vec3<double> even = (to / 4).array().round();
        points.push_back((i % 2 == 0 ? to : even).cast<Scalar>());
        radii.push_back(static_cast<Scalar>(random.between(0.01, 0.2)));
    }
    steps[7].to[1] = std::numeric_limits<Scalar>::quiet_NaN();
    radii[8] = -1;
    points[9][2] = std::numeric_limits<Scalar>::infinity();
    const WorldOptions options{.sides = Sides::both};
    const Threads threads;
    for (const Executor& executor : {Executor(), Executor(std::cref(threads))}) {
        const std::size_t n = steps.size();
        std::vector<std::optional<WorldSphereHit<Scalar>>> balls(n);
        std::vector<std::optional<WorldSphereHit<Scalar>>> alike(n);
        std::vector<Location> places(n);
        std::vector<std::uint8_t> is_hit(n, 7);
        std::vector<std::uint32_t> triangles(n);
        std::vector<Scalar> spots(3 * n);
        std::vector<MeshId> meshes(n);
        WorldHitArrays<Scalar> arrays;
        arrays.hits.count = n;
        arrays.hits.hit = is_hit.data();
        arrays.hits.triangle = triangles.data();
        arrays.hits.point = spots.data();
        arrays.mesh = meshes.data();
        const auto before = world.statistics().invalid_queries;
        const std::size_t hits = world.sweep_spheres(steps, std::span<const Scalar>(radii), balls, options, executor);
        EXPECT_EQ(world.statistics().invalid_queries, before + 2);
        world.sweep_spheres(steps, Scalar(0.1), alike, options, executor);
        const std::size_t on = world.locate_points(points, places, {}, executor);
        EXPECT_EQ(world.statistics().invalid_queries, before + 4);
        world.sweeps(steps, arrays, options, executor);
        std::vector<std::size_t> offsets(n + 1);
        std::vector<std::size_t> ray_offsets(n + 1);
        std::vector<WorldHit<Scalar>> rows(world.all_hits(steps, offsets, {}, options, executor));
        EXPECT_EQ(world.all_hits(steps, offsets, rows, options, executor), rows.size());
        std::vector<WorldHit<Scalar>> ray_rows(world.all_hits(rays, ray_offsets, {}, options, executor));
        world.all_hits(rays, ray_offsets, ray_rows, options, executor);
        EXPECT_GT(hits, 300U);
        EXPECT_GT(on, 20U);
        std::size_t found = 0;
        std::size_t found_on = 0;
        const auto expect_row = [&](std::span<const WorldHit<Scalar>> row, const auto& way) {
            std::vector<WorldHit<Scalar>> expected(row.size());
            ASSERT_EQ(world.all_hits(way, expected, options), row.size());
            for (std::size_t k = 0; k < row.size(); ++k)
                EXPECT_TRUE(same_bits(row[k].hit, expected[k].hit) && row[k].mesh == expected[k].mesh);
        };
        const auto expect_ball = [](const auto& x, const auto& y) {
            ASSERT_EQ(x.has_value(), y.has_value());
            if (!x) return;
            EXPECT_TRUE(std::memcmp(&x->hit, &y->hit, sizeof x->hit) == 0 && x->mesh == y->mesh);
        };
        for (std::size_t i = 0; i < n; ++i) {
            expect_ball(balls[i], world.sweep_sphere(steps[i], radii[i], options));
            expect_ball(alike[i], world.sweep_sphere(steps[i], Scalar(0.1), options));
            found += std::size_t{balls[i].has_value()};
            const Location place = world.locate(points[i]);
            EXPECT_TRUE(place.place == places[i].place && place.winding_number == places[i].winding_number &&
                        place.face_count == places[i].face_count);
            if (place.place == Place::on_surface) ++found_on;
            const auto hit = world.sweep(steps[i], options);
            EXPECT_EQ(is_hit[i], hit ? 1 : 0);
            EXPECT_EQ(triangles[i], hit ? hit->hit.triangle : no_face);
            EXPECT_EQ(meshes[i], hit ? hit->mesh : MeshId{});
            for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(spots[3 * i + k], hit ? hit->hit.point[int(k)] : Scalar(0));
            expect_row(std::span(rows).subspan(offsets[i], offsets[i + 1] - offsets[i]), steps[i]);
            expect_row(std::span(ray_rows).subspan(ray_offsets[i], ray_offsets[i + 1] - ray_offsets[i]), rays[i]);
        }
        EXPECT_EQ(found, hits);
        EXPECT_EQ(found_on, on);
    }
}

// Other rounding modes and flushed denormals of the caller's change no bit, of poses neither.
TYPED_TEST(WorldBatches, the_callers_arithmetic_does_not_matter) {
    using Scalar = TypeParam;
    const auto mesh = shared_mesh(moved<Scalar>(bumpy_sphere(3), 1, {0, 0, 0}));
    InstanceOptions<Scalar> options;
    options.pose.translation = Vec3<double>(0.1, 0.2, 0.3).cast<Scalar>();
    options.pose.rotation = rotation_of<Scalar>(1, 2, 3, 4);
    const auto asked = [&] {
        World<Scalar> world;
        const MeshId id = world.add(mesh, options);
        const Vec3<Scalar> from(Scalar(2.3), Scalar(0.7), Scalar(0.1));
        const auto hit = world.first_hit({from, Vec3<Scalar>(Scalar(-2), Scalar(0.1), Scalar(0.2))});
        return std::pair{hit, world.to_mesh(id, from)};
    };
    const auto expected = asked();
    ASSERT_TRUE(expected.first);
    for_each_setting([&](int rounding, bool flush) {
        const Setting setting(rounding, flush);
        const auto got = asked();
        setting.expect_given_back();
        ASSERT_TRUE(got.first);
        EXPECT_TRUE(same_bits(got.first->hit, expected.first->hit)) << rounding << flush;
        EXPECT_EQ(got.second, expected.second);
    });
}

}  // namespace
}  // namespace pierce::test
