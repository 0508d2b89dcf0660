// Meshes with poses: every answer is that of the images, decided exactly, and ordered by their fractions; against the
// naive twin, over all kinds of options and after all kinds of changes.
#include <gtest/gtest.h>
#include <pierce/world.h>
#include <rigid/placement.h>
#include <world/made_world.h>

namespace pierce::test {
namespace {

template <class Scalar>
class PosedWorld : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(PosedWorld, Scalars);

TYPED_TEST(PosedWorld, answers_as_the_naive_twin) {
    using Scalar = TypeParam;
    std::size_t hits = 0;
    std::size_t stayed = 0;
    std::size_t near = 0;
    std::size_t lost = 0;
    for (const double offset : {0.0, 1000.0, 1e5}) {
        MadeWorld<Scalar> setup(offset, 5);
        for (int i = 0; i < 14; ++i) setup.add();
        for (int i = 0; i < 700; ++i) {
            setup.change();
            const Segment<Scalar> segment = setup.segment();
            const WorldOptions options = setup.options();
            const auto expected = setup.naive.all_hits(segment, options);
            const auto hit = setup.world.first_hit(segment, options);
            ASSERT_EQ(hit.has_value(), !expected.empty()) << i << ": " << to_text(segment);
            EXPECT_EQ(setup.world.any_hit(segment, options), hit.has_value());
            if (hit) {
                ++hits;
                setup.expect_same(*hit, expected[0]);
                EXPECT_FALSE(setup.naive.stopped({segment.from, hit->hit.point}, options)) << to_text(segment);
                const bool start = hit->hit.point.vec() == segment.from;
                if (start && !hit->hit.at_start) ++stayed;
                EXPECT_TRUE(!start || hit->hit.fraction == 0);
                if (!hit->hit.at_start) {
                    // Half of four units in the last place of such a coordinate at least, or as far as the start.
                    const double before = setup.naive.distance(expected[0], segment.from, segment.from);
                    const double off = setup.naive.distance(expected[0], segment.from, hit->hit.point);
                    const double place =
                        double(std::numeric_limits<Scalar>::epsilon()) *
                        std::exp2(std::floor(std::log2(hit->hit.position.vec().cwiseAbs().maxCoeff())));
                    EXPECT_GE(off, std::min(before, 2 * place) * (1 - 1e-6)) << to_text(segment);
                    if (off < 4 * place * (1 - 1e-6)) ++lost;
                }
                const double unit = double(std::numeric_limits<Scalar>::epsilon()) * (8 + offset);
                const Vec3<Scalar> off = hit->hit.point - hit->hit.position;
                if (off.template cast<double>().norm() < 100 * unit) ++near;
            }
            std::vector<WorldHit<Scalar>> all(expected.size() / 2 + 1);
            ASSERT_EQ(setup.world.all_hits(segment, all, options), expected.size());
            for (std::size_t k = 0; k < std::min(all.size(), expected.size()); ++k) {
                setup.expect_same(all[k], expected[k]);
                EXPECT_LE(all[k > 0 ? k - 1 : 0].hit.exact_fraction, all[k].hit.exact_fraction);
            }
            int crossings = 0;
            int winding = 0;
            for (const auto& member : setup.naive.members) {
                if ((member.layers & options.mask) == 0) continue;
                crossings += member.mesh->crossings(setup.naive.image(member, segment));
                winding += member.mesh->winding_number(setup.world.to_mesh(member.id, segment.from));
            }
            EXPECT_EQ(setup.world.crossings(segment, {.mask = options.mask}), crossings);
            EXPECT_EQ(setup.world.winding_number(segment.from, {.mask = options.mask}), winding);
        }
    }
    std::cout << hits << " hits, " << stayed << " stayed at their start, " << near << " came near, " << lost
              << " less than a grain off\n";
    EXPECT_GT(hits, 800U);
    EXPECT_GT(near, hits * 9 / 10);
}

// From far away an image is off by more than boxes are apart: what is hit beside a box in the world is found.
TYPED_TEST(PosedWorld, far_ends_lose_nothing) {
    using Scalar = TypeParam;
    const double far = sizeof(Scalar) == 4 ? 1e6 : 1e15;
    std::size_t hits = 0;
    std::size_t beside = 0;
    Random random(8);
    for (int round = 0; round < 40; ++round) {
        MadeWorld<Scalar> setup(0, 5);
        // A cube: its own box, and that in the world, have nothing to spare at a corner.
        const TriangleSoup<Scalar> soup = moved<Scalar>(polycube(1, 1, 4, 1), 1, {-2, -2, -2});
        InstanceOptions<Scalar> options;
        options.pose.rotation = rotation_of<Scalar>(2, random.between_ints(-3, 3), random.between_ints(-3, 3), 1);
        options.pose.translation = random.in_cube().template cast<Scalar>();
        const auto mesh = shared_mesh(soup);
        setup.naive.members.push_back({setup.world.add(mesh, options), soup, mesh});
        const MeshId id = setup.naive.members[0].id;
        Vec3<double> low = Vec3<double>::Constant(1e9);
        Vec3<double> high = -low;
        for (const auto& p : soup.positions) {
            const Vec3<double> q = setup.world.to_world(id, p).template cast<double>();
            low = low.cwiseMin(q);
            high = high.cwiseMax(q);
        }
        for (int i = 0; i < 200; ++i) {
            const Vec3<double> way = far * random.direction();
            const Vec3<Scalar> corner = soup.positions[random.below(soup.positions.size())];
            const Vec3<double> through =
                setup.world.to_world(id, corner).template cast<double>() + 0.1 * random.in_cube();
            const Segment<Scalar> segment{(through - way).template cast<Scalar>(),
                                          (through + random.unit() * way).template cast<Scalar>()};
            const WorldOptions both{.sides = Sides::both};
            const auto expected = setup.naive.all_hits(segment, both);
            EXPECT_EQ(setup.world.all_hits(segment, {}, both), expected.size());
            EXPECT_EQ(setup.world.any_hit(segment, both), !expected.empty());
            if (expected.empty()) continue;
            ++hits;
            const Vec3<double> from = segment.from.template cast<double>();
            const Vec3<double> at = from + expected[0].fraction.get_d() * (segment.to.template cast<double>() - from);
            const Vec3<double> out = (low - at).cwiseMax(at - high);
            if (out.maxCoeff() > 0.01) ++beside;
        }
    }
    std::cout << hits << " hits, " << beside << " beside the box in the world\n";
    EXPECT_GT(hits, 1000U);
    EXPECT_GT(beside, 5U);
}

// The later hits' ways have no hit but those that come before.
TYPED_TEST(PosedWorld, points_of_later_hits_are_verified) {
    using Scalar = TypeParam;
    std::size_t later = 0;
    MadeWorld<Scalar> setup(0, 6);
    for (int i = 0; i < 12; ++i) setup.add();
    for (int i = 0; i < 150; ++i) {
        const Segment<Scalar> segment = setup.segment();
        const WorldOptions options{.sides = Sides::both};
        const auto expected = setup.naive.all_hits(segment, options);
        std::vector<WorldHit<Scalar>> all(expected.size());
        setup.world.all_hits(segment, all, options);
        for (std::size_t k = 0; k < all.size(); ++k)
            for (const auto& stop : setup.naive.all_hits({segment.from, all[k].hit.point}, options)) {
                bool before = false;
                for (std::size_t j = 0; j < k; ++j)
                    before = before || (all[j].mesh == stop.member->id && all[j].hit.triangle == stop.local.triangle &&
                                        expected[j].fraction < expected[k].fraction);
                EXPECT_TRUE(before) << k << ": " << to_text(segment);
                ++later;
            }
    }
    EXPECT_GT(later, 100U);
}

// Rays: as the meshes answer the image of the origin and of the direction, the nearest by its parameter.
TYPED_TEST(PosedWorld, rays_are_those_of_the_images) {
    using Scalar = TypeParam;
    std::size_t hits = 0;
    for (const double offset : {0.0, 1000.0}) {
        MadeWorld<Scalar> setup(offset, 7);
        for (int i = 0; i < 10; ++i) setup.add();
        for (int i = 0; i < 600; ++i) {
            if (i % 10 == 0) setup.change();
            const Segment<Scalar> segment = setup.segment();
            const Ray<Scalar> ray{segment.from, segment.to - segment.from};
            const WorldOptions options{.sides = Sides::both};
            double nearest = std::numeric_limits<double>::infinity();
            bool any = false;
            for (const auto& member : setup.naive.members) {
                if (!member.face_layers.empty()) continue;
                const detail::Point way =
                    detail::direction_of<Scalar>(detail::make_placement(member.pose), detail::to_point(ray.direction));
                const Ray<Scalar> local{setup.world.to_mesh(member.id, ray.origin), detail::to_vector<Scalar>(way)};
                const auto hit = member.mesh->first_hit(local, {.sides = Sides::both});
                if (!hit) continue;
                any = true;
                nearest = std::min(nearest, double(hit->exact_fraction));
            }
            WorldOptions plain = options;
            plain.accept = [&setup](MeshId id, const Contact&) { return setup.has_all_faces(id); };
            const auto hit = setup.world.first_hit(ray, plain);
            ASSERT_EQ(hit.has_value(), any);
            EXPECT_EQ(setup.world.any_hit(ray, plain), any);
            if (!hit) continue;
            ++hits;
            EXPECT_EQ(double(hit->hit.exact_fraction), nearest);
            EXPECT_FALSE(setup.world.any_hit(Segment<Scalar>{ray.origin, hit->hit.point}, plain));
        }
    }
    EXPECT_GT(hits, 300U);
}

}  // namespace
}  // namespace pierce::test
