// What is asked of a step: against every triangle one by one, against what a mesh that stands still says, and on
// lattices, where the motion of a mesh can be taken from the point instead.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <deform/deformations.h>
#include <deform/naive_step.h>
#include <pierce/deforming_mesh.h>
#include <support/executors.h>
#include <support/expect_hit.h>
#include <support/hard_segments.h>

namespace pierce::test {
namespace {

template <class Scalar>
void expect_same(const std::optional<SweepHit<Scalar>>& hit,
                 const std::optional<typename NaiveStep<Scalar>::Found>& expected, const Segment<Scalar>& way) {
    ASSERT_EQ(hit.has_value(), expected.has_value()) << to_text(way);
    if (!hit) return;
    ASSERT_EQ(hit->triangle, expected->triangle) << to_text(way);
    ASSERT_EQ(hit->side, expected->impact.side);
    ASSERT_EQ(hit->feature, expected->impact.feature);
    ASSERT_EQ(hit->feature_index, expected->impact.feature_index);
    ASSERT_EQ(hit->at_start, expected->impact.at_start);
    ASSERT_LE(double(hit->time), expected->impact.latest);
    ASSERT_GE(double(hit->time), expected->impact.earliest * (1 - 2e-7) - 1e-18);
    ASSERT_NEAR(hit->barycentric[0] + hit->barycentric[1] + hit->barycentric[2], 1, 1e-6);
}

template <class Scalar>
class Sweeps : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Sweeps, Scalars);

// A way for a point over a step: as for a mesh that stands still, or with a vertex, or from one end's face to the
// other's.
template <class Scalar>
Segment<Scalar> way_over(const NaiveStep<Scalar>& step, const MeshView<Scalar>& before, const Extent<Scalar>& extent,
                         Random& random) {
    switch (random.below(4)) {
        case 0:
            return mixed_segment(before, extent, random);
        case 1:
            return hard_segment(before, extent, extent.diagonal() / 16 + 1e-30, random);
        case 2: {
            const IndexTriple& t = before.triangles[random.below(before.triangles.size())];
            return {before.positions[t[0]], step.after[t[random.below(3)]]};
        }
        default: {
            const IndexTriple t = before.triangles[random.below(before.triangles.size())];
            Vec3<double> from = Vec3<double>::Zero(), to = from;
            const Vec3<double> v = random.weights(), w = random.weights();
            for (std::size_t k = 0; k < 3; ++k) {
                from += v[static_cast<int>(k)] * before.positions[t[k]].template cast<double>();
                to += w[static_cast<int>(k)] * step.after[t[k]].template cast<double>();
            }
            const double off = extent.diagonal() * std::exp(-10 * random.unit());
            return {(from + off * random.in_cube()).template cast<Scalar>(),
                    (to + off * random.in_cube()).template cast<Scalar>()};
        }
    }
}

template <class Scalar>
void compare_steps(const TriangleSoup<double>& rest, int steps, int queries, std::uint64_t seed) {
    Random random(seed);
    TriangleSoup<Scalar> soup = moved<Scalar>(rest, 1, {0, 0, 0});
    DeformingMesh<Scalar> mesh(soup.view(), {.rebuild_above = random.chance(0.5) ? 1.5 : 100});
    std::vector<std::uint8_t> mask(soup.triangles.size());
    int hits = 0;
    int unverified = 0;
    for (int i = 0; i < steps; ++i) {
        NaiveStep<Scalar> naive{soup, deformed<Scalar>(rest, random)};
        if (i == 0) naive.after = soup.positions;
        if (i > 0) mesh.begin_step(naive.after);
        const DeformationStep<Scalar> step = mesh.step();
        const Extent<Scalar> extent(soup.view());
        for (int q = 0; q < queries; ++q) {
            const Segment<Scalar> way = way_over(naive, soup.view(), extent, random);
            QueryOptions options;
            options.sides = std::array{Sides::front, Sides::back, Sides::both}[random.below(3)];
            if (random.chance(0.2)) options.max_fraction = random.unit();
            if (random.chance(0.2)) {
                for (std::uint8_t& m : mask) m = random.chance(0.5) ? 1 : 0;
                options.face_mask = mask;
            }
            SCOPED_TRACE(testing::Message() << "step " << i << ", query " << q);
            const auto hit = step.sweep(way, options);
            expect_same(hit, naive.first(way, options), way);
            if (testing::Test::HasFatalFailure()) return;
            ASSERT_EQ(step.any_hit(way, options), hit.has_value());
            if (!hit) continue;
            ++hits;
            const auto refuse = [&](const Contact& contact) { return contact.face != hit->face; };
            QueryOptions others = options;
            others.accept = Accept(refuse);
            const auto other = step.sweep(way, others);
            ASSERT_TRUE(!other || other->face != hit->face);
            options.max_fraction = 1;
            if (hit->place_verified) {
                ASSERT_FALSE(naive.first({way.from, hit->place.vec()}, options).has_value()) << to_text(way);
            } else {
                unverified += hit->at_start ? 0 : 1;
            }
        }
        soup.positions = naive.after;
    }
    EXPECT_GT(hits, steps * queries / 20);
    // Some of these steps fold the mesh up, or press it flat, and leave no room for a point that was inside.
    EXPECT_LE(unverified, hits / 8);
}

TYPED_TEST(Sweeps, AsEveryTriangleByItself) {
    std::uint64_t seed = 11;
    for (const TriangleSoup<double>& rest : deforming_meshes()) {
        SCOPED_TRACE(testing::Message() << "mesh of " << rest.triangles.size());
        compare_steps<TypeParam>(rest, 12, 60, ++seed);
        if (testing::Test::HasFatalFailure()) return;
    }
}

TYPED_TEST(Sweeps, AsEveryTriangleByItselfSoak) {
    for (std::uint64_t seed = 200; seed < 208; ++seed)
        for (const TriangleSoup<double>& rest : deforming_meshes()) {
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", mesh of " << rest.triangles.size());
            compare_steps<TypeParam>(rest, 30, 200, seed);
            if (testing::Test::HasFatalFailure()) return;
        }
}

// A mesh that stands still, or is moved by whole numbers in a box of whole numbers: all sums are exact.
TYPED_TEST(Sweeps, OfATranslatedMeshAreThoseOfTheRelativeMotion) {
    using Scalar = TypeParam;
    Random random(31);
    const TriangleSoup<Scalar> soup = moved<Scalar>(polycube(4, 0.5, 2, 9), 1, {0, 0, 0});
    DeformingMesh<Scalar> mesh(soup.view());
    const CollisionMesh<Scalar> still(soup.view());
    const auto lattice = [&](int size) {
        const auto one = [&] { return static_cast<Scalar>(random.between_ints(-size, size)); };
        const Scalar x = one();
        const Scalar y = one();
        return Vec3<Scalar>(x, y, one());
    };
    int hits = 0;
    for (int i = 0; i < 60; ++i) {
        const Vec3<Scalar> by = i % 4 == 0 ? Vec3<Scalar>(0, 0, 0) : lattice(i % 4 == 1 ? 2 : 40);
        std::vector<Vec3<Scalar>> there = soup.positions;
        for (Vec3<Scalar>& p : there) p += by;
        mesh.begin_step(soup.positions);
        mesh.begin_step(there);
        for (int q = 0; q < 100; ++q) {
            const Vec3<Scalar> from = lattice(8);
            const Vec3<Scalar> to = from + by + lattice(q % 2 == 0 ? 2 : 12);
            QueryOptions options;
            options.sides = std::array{Sides::front, Sides::back, Sides::both}[random.below(3)];
            const auto hit = mesh.sweep({from, to}, options);
            const auto expected = still.first_hit(Segment<Scalar>{from, to - by}, options);
            ASSERT_EQ(hit.has_value(), expected.has_value()) << from.transpose() << " to " << to.transpose();
            if (!hit) continue;
            ++hits;
            ASSERT_TRUE(hit->place_verified || hit->at_start);
            ASSERT_EQ(hit->face, expected->face);
            ASSERT_EQ(hit->side, expected->side);
            ASSERT_EQ(hit->feature, expected->feature);
            ASSERT_EQ(hit->feature_index, expected->feature_index);
            ASSERT_NEAR(double(hit->time), double(expected->exact_fraction), 1e-6);
            ASSERT_LE(double(hit->time), double(expected->exact_fraction) * (1 + 3e-7));
            ASSERT_LT((hit->surface_motion - by).norm(), 1e-5);
            ASSERT_LT((hit->normal - expected->normal.vec()).norm(), 1e-6);
            ASSERT_LT((hit->barycentric - expected->barycentric.vec()).norm(), 1e-5);
        }
    }
    EXPECT_GT(hits, 500);
}

// A contact at a third of the step, which is between two doubles.
TYPED_TEST(Sweeps, LimitsAreComparedExactly) {
    using Scalar = TypeParam;
    const TriangleSoup<Scalar> soup = moved<Scalar>(corner_triangle(), 1, {0, 0, 0});
    const DeformingMesh<Scalar> mesh(soup.view());
    const Segment<Scalar> down{{1, 1, 1}, {1, 1, -2}};
    const double third = 1.0 / 3;  // below the true one
    EXPECT_FALSE(mesh.sweep(down, {.max_fraction = third}));
    EXPECT_TRUE(mesh.sweep(down, {.max_fraction = std::nextafter(third, 1.0)}));
    const Segment<Scalar> half{{1, 1, 1}, {1, 1, -1}};
    EXPECT_TRUE(mesh.sweep(half, {.max_fraction = 0.5}));
    EXPECT_FALSE(mesh.sweep(half, {.max_fraction = std::nextafter(0.5, 0.0)}));
}

// On edges and vertices that are valleys from inside, several faces are to be kept off.
TYPED_TEST(Sweeps, PlacesInCornersAreNearTheContact) {
    using Scalar = TypeParam;
    Random random(51);
    TriangleSoup<double> flat = bumpy_sphere(2);
    for (Vec3<double>& p : flat.positions) p[2] *= 0.15;  // sharp edges around
    const TriangleSoup<Scalar> soup = moved<Scalar>(flat, 1, {0, 0, 0});
    const DeformingMesh<Scalar> mesh(soup.view());
    for (int i = 0; i < 400; ++i) {
        const IndexTriple& t = soup.triangles[random.below(soup.triangles.size())];
        const Scalar w = random.chance(0.3) ? Scalar(0) : static_cast<Scalar>(random.unit());
        const std::size_t k = random.below(3);
        const Vec3<Scalar> one = soup.positions[t[k]], other = soup.positions[t[(k + 1) % 3]];
        const Vec3<Scalar> target = one + w * (other - one);
        const auto hit = mesh.sweep({Scalar(0.25) * target, Scalar(1.5) * target}, {.sides = Sides::back});
        ASSERT_TRUE(hit);
        ASSERT_TRUE(hit->place_verified);
        ASSERT_LT((hit->place - hit->position.vec()).norm(), 1000 * std::numeric_limits<Scalar>::epsilon());
    }
}

TYPED_TEST(Sweeps, BatchesHaveTheSameBits) {
    using Scalar = TypeParam;
    Random random(41);
    const TriangleSoup<double> rest = bumpy_sphere(6);
    TriangleSoup<Scalar> soup = moved<Scalar>(rest, 1, {0, 0, 0});
    DeformingMesh<Scalar> mesh(soup.view());
    const std::vector<Vec3<Scalar>> after = deformed<Scalar>(rest, random);
    const Threads threads;
    DeformingMesh<Scalar> parallel(soup.view(), {.build = {.executor = std::cref(threads)}});
    mesh.begin_step(after);
    parallel.begin_step(after, std::cref(threads));
    const Extent<Scalar> extent(soup.view());
    std::vector<Segment<Scalar>> ways;
    for (int i = 0; i < 3000; ++i) ways.push_back(mixed_segment(soup.view(), extent, random));
    ways[7].from[0] = std::numeric_limits<Scalar>::quiet_NaN();
    ways[8].to[2] = std::numeric_limits<Scalar>::infinity();
    std::vector<std::optional<SweepHit<Scalar>>> hits(ways.size()), others(ways.size());
    QueryCounters counters;
    const std::size_t count = mesh.sweeps(ways, hits, {.sides = Sides::both, .counters = &counters});
    EXPECT_EQ(parallel.sweeps(ways, others, {.sides = Sides::both}, std::cref(threads)), count);
    EXPECT_GT(count, 300U);
    EXPECT_EQ(counters.queries, ways.size());
    EXPECT_EQ(mesh.step().before().statistics().invalid_queries, 2U);
    const auto same = [](const std::optional<SweepHit<Scalar>>& x, const std::optional<SweepHit<Scalar>>& y) {
        if (!x || !y) return x.has_value() == y.has_value();
        return bits(x->time) == bits(y->time) && same_bits(x->place, y->place) && same_bits(x->position, y->position) &&
               same_bits(x->normal, y->normal) && same_bits(x->barycentric, y->barycentric) &&
               same_bits(x->surface_motion, y->surface_motion) && x->triangle == y->triangle && x->side == y->side &&
               x->place_verified == y->place_verified;
    };
    for (std::size_t i = 0; i < ways.size(); ++i) {
        ASSERT_TRUE(same(hits[i], others[i])) << i;
        ASSERT_TRUE(same(hits[i], mesh.sweep(ways[i], {.sides = Sides::both}))) << i;
    }
    EXPECT_FALSE(hits[7]);
    EXPECT_FALSE(mesh.sweep(ways[0], {.max_fraction = std::numeric_limits<double>::quiet_NaN()}));
    others.pop_back();
    EXPECT_THROW(mesh.sweeps(ways, others), std::invalid_argument);
}

TYPED_TEST(Sweeps, BadInputLeavesTheStep) {
    using Scalar = TypeParam;
    const TriangleSoup<Scalar> soup = moved<Scalar>(bumpy_sphere(3), 1, {0, 0, 0});
    DeformingMesh<Scalar> mesh(soup.view());
    std::vector<Vec3<Scalar>> there = soup.positions;
    for (Vec3<Scalar>& p : there) p[2] += 4;
    mesh.begin_step(there);
    const Segment<Scalar> up{{0, 0, Scalar(3.5)}, {0, 0, Scalar(3.5)}};
    const auto before = mesh.sweep(up);
    ASSERT_TRUE(before);
    there[5][1] = std::numeric_limits<Scalar>::infinity();
    EXPECT_THROW(mesh.begin_step(there), MeshError);
    there.pop_back();
    EXPECT_THROW(mesh.begin_step(there), std::invalid_argument);
    EXPECT_EQ(bits(mesh.sweep(up)->time), bits(before->time));
    std::vector<Vec3<Scalar>> wrong = soup.positions;
    wrong[0][0] = std::numeric_limits<Scalar>::quiet_NaN();
    EXPECT_THROW(DeformingMesh<Scalar>(MeshView<Scalar>{wrong, soup.triangles}), MeshError);
    mesh.begin_step(soup.positions);  // and back
    EXPECT_TRUE(mesh.step().after().contains({0, 0, 0}));
    EXPECT_FALSE(mesh.step().before().contains({0, 0, 0}));

    DeformingMesh<Scalar> other = std::move(mesh);
    EXPECT_FALSE(mesh.sweep(up));
    EXPECT_THROW(mesh.begin_step(soup.positions), std::invalid_argument);
    EXPECT_FALSE(DeformationStep<Scalar>().sweep(up));
    EXPECT_FALSE(DeformationStep<Scalar>().before().any_hit(up));
    DeformingMesh<Scalar> none(MeshView<Scalar>{});
    none.begin_step(PointsView<Scalar>{});
    EXPECT_FALSE(none.sweep(up));
}

// A wheel that is turned and moved: positions are those of its pose, and what is met moves with it.
TYPED_TEST(Sweeps, OfARigidBody) {
    using Scalar = TypeParam;
    const TriangleSoup<Scalar> soup = moved<Scalar>(polycube(3, 0.6, 2, 12), 1, {0, 0, 0});
    DeformingMesh<Scalar> mesh(soup.view());
    const auto pose = [](double angle, double up) {
        Pose<double> at;
        at.rotation << std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle), 0, 0, 0, 1;
        at.translation = {0, 0, up};
        return at;
    };
    mesh.begin_step(pose(0, 0));
    EXPECT_EQ(mesh.step().after().winding_number({0.5, 0.5, 0.5}),
              mesh.step().before().winding_number({0.5, 0.5, 0.5}));
    mesh.begin_step(pose(0.1, 2));
    const Extent<Scalar> extent(soup.view());
    Random random(4);
    int hits = 0;
    for (int i = 0; i < 300; ++i) {
        const Segment<Scalar> way = mixed_segment(soup.view(), extent, random);
        const auto hit = mesh.sweep({way.from, way.from});
        if (!hit || hit->at_start) continue;
        ++hits;
        EXPECT_TRUE(hit->place_verified);
        const IndexTriple& t = soup.triangles[hit->triangle];
        Vec3<double> x = Vec3<double>::Zero();
        for (std::size_t k = 0; k < 3; ++k)
            x += double(hit->barycentric[k]) * soup.positions[t[k]].template cast<double>();
        const Pose<double> there = pose(0.1, 2);
        EXPECT_LT((hit->surface_motion.template cast<double>() - (there.rotation * x + there.translation - x)).norm(),
                  1e-5);
        EXPECT_LT((hit->place.template cast<double>() - (there.rotation * x + there.translation)).norm(), 1e-5);
    }
    EXPECT_GT(hits, 20);
}

// Triangles that are points, or lie far away beside their size, have no lattice: all of them are looked at.
TYPED_TEST(Sweeps, ScenesWithoutExtent) {
    using Scalar = TypeParam;
    std::vector<Vec3<Scalar>> p(3, Vec3<Scalar>(1, 1, 1));
    const std::vector<IndexTriple> triangle{{0, 1, 2}};
    DeformingMesh<Scalar> mesh(MeshView<Scalar>{p, triangle});
    EXPECT_FALSE(mesh.sweep({{0, 0, 0}, {3, 3, 3}}, {.max_fraction = 0.1}));
    EXPECT_FALSE(mesh.step().before().any_hit(Segment<Scalar>{{0, 0, 0}, {2, 2, 2}}));
    p = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    mesh.begin_step(p);
    mesh.begin_step(p);
    EXPECT_TRUE(mesh.sweep({{1, 1, 1}, {1, 1, -1}}));
    p.assign(3, Vec3<Scalar>(0, 0, 0));
    mesh.begin_step(p);
    EXPECT_TRUE(mesh.sweep({{Scalar(0.25), Scalar(0.25), 1}, {Scalar(0.25), Scalar(0.25), -9}}));
}

}  // namespace
}  // namespace pierce::test
