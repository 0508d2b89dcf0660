// Sweeps against a mesh that turns: chords against the true curve in long double, what the tolerance promises about a
// turning cube, riders, batches, and what is no motion.
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include <pierce/collision_mesh.h>
#include <pierce/world.h>
#include <rigid/true_turn.h>
#include <rigid/turn.h>
#include <support/executors.h>
#include <support/meshes.h>
#include <support/random.h>

namespace pierce::test {
namespace {

template <class Scalar>
class Turns : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Turns, Scalars);

Pose<double> any_pose(Random& random, double offset) {
    const Screw screw{Vec3<double>::Zero(), random.direction(), random.between(-3, 3)};
    Pose<double> pose = moved_by(screw, {});
    pose.translation = offset * random.in_cube();
    return pose;
}
Screw any_screw(Random& random, const Pose<double>& pose) {
    const double angle = std::exp(random.between(-8, 1.14)) * (random.chance(0.5) ? 1 : -1);
    return {pose.translation + 2 * random.in_cube(), random.direction(), angle, random.between(-0.5, 0.5)};
}

// At each time the chord is within the tolerance of the curve, rounding included; and there are no more chords than the
// bound asks for.
TYPED_TEST(Turns, ChordsAreWithinTheTolerance) {
    using Scalar = TypeParam;
    Random random(1);
    double closest = 0;  // the largest part of the tolerance that is used
    for (int i = 0; i < 1500; ++i) {
        const Pose<double> pose = any_pose(random, i % 3 == 0 ? 30 : 0);
        const Screw screw = any_screw(random, pose);
        const double tolerance = std::exp(random.between(-9, 0));
        detail::Turn turn;
        turn.before = detail::make_placement(pose);
        turn.after = detail::make_placement(moved_by(screw, pose));
        turn.pivot = detail::image_of<double>(turn.before, detail::to_point(screw.point));
        turn.tolerance = tolerance;
        detail::set_parts(turn);
        ASSERT_GE(turn.angle, std::abs(screw.angle) * (1 - 1e-9));
        ASSERT_LE(turn.angle, std::abs(screw.angle) * 1.01 + 1e-9);
        const Segment<Scalar> way{(pose.translation + 3 * random.in_cube()).template cast<Scalar>(),
                                  (pose.translation + 3 * random.in_cube()).template cast<Scalar>()};
        const detail::Curve curve =
            detail::Curve::between<Scalar>(turn, detail::image_of<Scalar>(turn.before, detail::to_point(way.from)),
                                           detail::image_of<Scalar>(turn.after, detail::to_point(way.to)));
        const RigidMotion motion(pose, screw, tolerance);
        const int chords = 1 << curve.level;
        ASSERT_EQ(motion.chords(way), static_cast<std::size_t>(chords));
        ASSERT_TRUE(curve.level == 0 || std::ldexp(curve.bend, -2 * curve.level + 2) > tolerance / 2);
        const TrueTurn truth(pose, screw);
        const auto corner = [&](int k) -> Long3 {
            detail::Point p = k == 0 ? curve.end[0] : curve.end[1];
            if (k > 0 && k < chords) {
                // The parts whose bits are set: those of the walk.
                detail::Quaternion q;
                for (int level = 1; level <= curve.level; ++level)
                    if ((k >> (curve.level - level) & 1) != 0)
                        q = detail::product(q, turn.part[static_cast<std::size_t>(level)]);
                p = curve.at<Scalar>(turn, static_cast<double>(k) / chords, q);
            }
            return Long3(p[0], p[1], p[2]);
        };
        Long3 left = corner(0);
        for (int k = 0; k < std::min(chords, 64); ++k) {
            const Long3 right = corner(k + 1);
            for (int part = 0; part <= 8; ++part) {
                const long double within = part / 8.0L;
                const long double time = (k + within) / chords;
                const Long3 p =
                    way.from.template cast<long double>() * (1 - time) + way.to.template cast<long double>() * time;
                const Long3 chord = left * (1 - within) + right * within;
                const auto off = static_cast<double>((chord - truth.in_mesh(p, time)).norm());
                ASSERT_LE(off, tolerance) << "case " << i << ", chord " << k << " of " << chords;
                closest = std::max(closest, off / tolerance);
            }
            left = right;
        }
    }
    EXPECT_GT(closest, 0.5);
}

// A cube, of which it is plain how deep a point is in it.
template <class Scalar>
void expect_promised(int count, std::uint64_t seed) {
    const TriangleSoup<Scalar> soup = moved<Scalar>(Polycube(1, 1, 2, 1).soup, 1, {-1, -1, -1});
    ASSERT_EQ(soup.triangles.size(), 12U);
    const CollisionMesh<Scalar> mesh(soup.view());
    Random random(seed);
    int hits = 0;
    int deep = 0;
    int shallow = 0;
    int many_chords = 0;
    for (int i = 0; i < count; ++i) {
        const Pose<double> pose = any_pose(random, i % 3 == 0 ? 20 : 0);
        const Screw screw = any_screw(random, pose);
        const double tolerance = std::exp(random.between(-9, -1));
        const RigidMotion motion(pose, screw, tolerance);
        const TrueTurn truth(pose, screw);
        Segment<Scalar> way{(pose.translation + 2.5 * random.in_cube()).template cast<Scalar>(),
                            (pose.translation + 2.5 * random.in_cube()).template cast<Scalar>()};
        const auto outside = [](const auto& x) { return x.cwiseAbs().maxCoeff() >= 1; };
        if (!outside(motion.start_in_mesh(way.from))) continue;
        const auto hit = mesh.sweep(way, motion);
        const auto where = [&](long double time) {
            const Long3 p =
                way.from.template cast<long double>() * (1 - time) + way.to.template cast<long double>() * time;
            return truth.in_mesh(p, time);
        };
        const auto depth_at = [&](long double time) {
            return 1 - static_cast<double>(where(time).cwiseAbs().maxCoeff());
        };
        double deepest = -1;
        double since = 1;
        for (int s = 0; s <= 128; ++s) {
            const double depth = depth_at(s / 128.0L);
            if (depth > tolerance && deepest <= tolerance) since = s / 128.0;
            deepest = std::max(deepest, depth);
        }
        if (motion.chords(way) > 1) ++many_chords;
        if (deepest > tolerance) {
            ++deep;
            ASSERT_TRUE(hit) << "case " << i << ": " << deepest << " deep, tolerance " << tolerance;
            ASSERT_LE(hit->time, since);
        }
        if (!hit) {
            ASSERT_TRUE(outside(motion.end_in_mesh(way.to)));
            continue;
        }
        ++hits;
        if (deepest <= tolerance) ++shallow;
        const double slack = sizeof(Scalar) == 4 ? 1e-4 : 1e-10;
        ASSERT_LE(static_cast<double>((where(hit->time) - hit->local_position.template cast<long double>()).norm()),
                  tolerance + slack);
        const Long3 place = hit->local_position.template cast<long double>();
        ASSERT_LE((truth.in_world(place, hit->time) - hit->position.template cast<long double>()).norm(), slack);
        const Long3 normal = hit->local_normal.template cast<long double>();
        ASSERT_LE((truth.direction(normal, hit->time) - hit->normal.template cast<long double>()).norm(), slack);
        const Long3 moved = truth.in_world(place, 1) - truth.in_world(place, 0);
        ASSERT_LE((moved - hit->surface_motion.template cast<long double>()).norm(), slack);
        ASSERT_TRUE(hit->place_verified);
        ASSERT_EQ(hit->local.vec(), motion.end_in_mesh(hit->place.vec()));
        ASSERT_TRUE(outside(hit->local.vec()));
        ASSERT_LE((hit->local - hit->local_position.vec()).norm(), slack);
        // It is a time, also where it is a limit.
        QueryOptions options{.max_fraction = static_cast<double>(hit->time) * (1 - 1e-5)};
        ASSERT_TRUE(hit->time == 0 || !mesh.sweep(way, motion, options));
        options.max_fraction = static_cast<double>(hit->time) * (1 + 1e-5) + 1e-12;
        ASSERT_TRUE(mesh.sweep(way, motion, options));
        const auto accept = [&](const Contact& c) {
            return std::abs(c.fraction - static_cast<double>(hit->time)) > slack;
        };
        const auto next = mesh.sweep(way, motion, {.accept = accept});
        ASSERT_TRUE(!next || next->time > hit->time);
    }
    EXPECT_GT(hits, count / 10);
    EXPECT_GT(deep, count / 10);
    EXPECT_GT(shallow, 0);
    EXPECT_GT(many_chords, count / 3);
}

TYPED_TEST(Turns, NothingDeeperThanTheToleranceIsMissed) { expect_promised<TypeParam>(4000, 2); }
TYPED_TEST(Turns, NothingDeeperThanTheToleranceIsMissedSoak) { expect_promised<TypeParam>(300'000, 3); }

// With no turn there is one chord, between the images: the decisions of a mesh that is moved.
TYPED_TEST(Turns, WithoutATurnThereIsOneChord) {
    using Scalar = TypeParam;
    const TriangleSoup<Scalar> soup = moved<Scalar>(bumpy_sphere(8), 1, {0, 0, 0});
    const CollisionMesh<Scalar> mesh(soup.view());
    Random random(4);
    const Pose<double> pose = any_pose(random, 10);
    Pose<double> to = pose;
    to.translation += Vec3<double>(1, 0, 0);
    const RigidMotion motion(pose, to, 1e-9);
    EXPECT_EQ(motion.end().translation, to.translation);
    int hits = 0;
    for (int i = 0; i < 5000; ++i) {
        const Segment<Scalar> way{(pose.translation + 2 * random.in_cube()).template cast<Scalar>(),
                                  (pose.translation + 2 * random.in_cube()).template cast<Scalar>()};
        ASSERT_EQ(motion.chords(way), 1U);
        const auto hit = mesh.sweep(way, motion, {.sides = Sides::both});
        const Segment<Scalar> chord{motion.start_in_mesh(way.from), motion.end_in_mesh(way.to)};
        const auto still = mesh.first_hit(chord, {.sides = Sides::both});
        ASSERT_EQ(hit.has_value(), still.has_value());
        if (!hit) continue;
        ++hits;
        ASSERT_EQ(hit->triangle, still->triangle);
        ASSERT_LE(hit->time, still->exact_fraction);
        ASSERT_TRUE(hit->local_position == still->position && hit->local_normal == still->normal);
    }
    EXPECT_GT(hits, 500);
}

// A particle lies on a turning table, pulled down in each step, and goes with it: it stays where it is, above the
// table. A rider does not move by one bit.
TYPED_TEST(Turns, WhatRestsOnATableStaysThere) {
    using Scalar = TypeParam;
    const TriangleSoup<Scalar> soup = moved<Scalar>(Polycube(1, 1, 2, 1).soup, 1, {-1, -1, -2});  // its top is z = 0
    const CollisionMesh<Scalar> mesh(soup.view());
    Pose<double> pose;
    pose.translation = {3, -2, 1};
    Vec3<Scalar> p = Vec3<double>(3.5, -2.3, 1.001).cast<Scalar>();
    Vec3<double> velocity = Vec3<double>::Zero();
    std::optional<Vec3<Scalar>> local;
    std::optional<RigidHit<Scalar>> last;
    for (int step = 0; step < 1000; ++step) {
        const Screw screw{pose.translation, {0, 0, 1}, 0.05, 0.001 * std::sin(0.1 * step)};
        const RigidMotion motion(pose, screw, 1e-4);
        velocity[2] -= 0.01;
        const Vec3<Scalar> to = (p.template cast<double>() + velocity).template cast<Scalar>();
        const auto hit = mesh.sweep(Segment<Scalar>{p, to}, motion);
        if (hit) {
            ASSERT_TRUE(hit->place_verified);
            ASSERT_GT(hit->normal[2], Scalar(0.99));
            p = hit->place;
            velocity = hit->surface_motion.template cast<double>();
            last = hit;
        } else {
            p = to;
        }
        pose = motion.end();
        const Vec3<Scalar> here = motion.end_in_mesh(p);
        ASSERT_GE(here[2], 0) << "step " << step;
        if (step == 20) local = here;
        if (step > 20) {
            ASSERT_TRUE(hit);
            ASSERT_LE((here - *local).norm(), 1e-2) << "step " << step;
            ASSERT_LE(here[2], sizeof(Scalar) == 4 ? 1e-5 : 1e-13);
        }
    }
    // It leaves from the place that it keeps in the mesh as it does from that in the world.
    const RigidMotion motion(pose, Screw{pose.translation, {0, 0, 1}, 0.3}, 1e-4);
    for (const double dz : {-0.5, 0.5}) {
        const Vec3<Scalar> to = (p.template cast<double>() + Vec3<double>(0.1, 0, dz)).template cast<Scalar>();
        const auto hit = mesh.sweep(Segment<Scalar>{p, to}, motion);
        const auto ride = mesh.sweep(Ride<Scalar>{motion.start_in_mesh(p), to}, motion);
        ASSERT_EQ(hit.has_value(), dz < 0);
        ASSERT_EQ(ride.has_value(), dz < 0);
        if (hit) {
            ASSERT_TRUE(hit->place == ride->place && hit->time == ride->time);
        }
    }
}

TYPED_TEST(Turns, BatchesAreTheSingleCalls) {
    using Scalar = TypeParam;
    const TriangleSoup<Scalar> soup = moved<Scalar>(bumpy_sphere(8), 1, {0, 0, 0});
    const CollisionMesh<Scalar> mesh(soup.view());
    Random random(6);
    std::vector<Segment<Scalar>> ways;
    for (int i = 0; i < 4000; ++i) {
        const Vec3<double> from = 2 * random.in_cube();
        ways.push_back({from.cast<Scalar>(), (2 * random.in_cube()).cast<Scalar>()});
    }
    ways[5].from[2] = std::numeric_limits<Scalar>::infinity();
    const RigidMotion motion({}, Screw{{0.1, 0.2, 0}, {1, 2, 3}, 0.8, 0.1}, 1e-3);
    for (const Executor& executor : {Executor{}, Executor{Reversed{}}, Executor{Threads{}}}) {
        std::vector<std::optional<RigidHit<Scalar>>> out(ways.size());
        const auto invalid = mesh.statistics().invalid_queries;
        const std::size_t hits = mesh.sweeps(ways, motion, out, {.sides = Sides::both}, executor);
        EXPECT_EQ(mesh.statistics().invalid_queries, invalid + 1);
        std::size_t count = 0;
        for (std::size_t i = 0; i < ways.size(); ++i) {
            const auto single = mesh.sweep(ways[i], motion, {.sides = Sides::both});
            ASSERT_EQ(single.has_value(), out[i].has_value());
            if (!single) continue;
            ++count;
            ASSERT_TRUE(single->time == out[i]->time && single->place == out[i]->place);
            ASSERT_TRUE(single->local == out[i]->local && single->position == out[i]->position);
        }
        EXPECT_EQ(count, hits);
        EXPECT_GT(count, ways.size() / 10);
    }
    std::vector<std::optional<RigidHit<Scalar>>> few(3);
    EXPECT_THROW(mesh.sweeps(ways, motion, few), std::invalid_argument);
}

TYPED_TEST(Turns, WhatIsNoMotion) {
    using Scalar = TypeParam;
    const TriangleSoup<Scalar> soup = moved<Scalar>(corner_triangle(), 1, {0, 0, 0});
    const CollisionMesh<Scalar> mesh(soup.view());
    Pose<double> stretched;
    stretched.rotation *= 2;
    const Vec3<double> z(0, 0, 1);
    const Vec3<double> nan = Vec3<double>::Constant(std::nan(""));
    EXPECT_THROW(RigidMotion(stretched, Pose<double>{}, 1), std::invalid_argument);
    EXPECT_THROW(RigidMotion(Pose<double>{}, stretched, 1), std::invalid_argument);
    EXPECT_THROW(RigidMotion(Pose<double>{}, Pose<double>{}, 0), std::invalid_argument);
    EXPECT_THROW(RigidMotion(Pose<double>{}, Pose<double>{}, std::nan("")), std::invalid_argument);
    EXPECT_THROW(RigidMotion(Pose<double>{}, Pose<double>{}, 1, nan), std::invalid_argument);
    EXPECT_THROW(RigidMotion(Pose<double>{}, Screw{z, z, std::numbers::pi}, 1), std::invalid_argument);
    EXPECT_THROW(RigidMotion(Pose<double>{}, Screw{z, Vec3<double>::Zero(), 1}, 1), std::invalid_argument);
    EXPECT_THROW(RigidMotion(Pose<double>{}, Screw{nan, z, 1}, 1), std::invalid_argument);

    RigidMotion motion({}, Screw{{0, 0, 0}, z, 1}, 1e-3);
    const Segment<Scalar> down{{Scalar(1), Scalar(1), 1}, {Scalar(1), Scalar(1), -1}};
    EXPECT_TRUE(mesh.sweep(down, motion));
    const auto before = mesh.statistics().invalid_queries;
    Segment<Scalar> bad = down;
    bad.to[0] = std::numeric_limits<Scalar>::quiet_NaN();
    EXPECT_FALSE(mesh.sweep(bad, motion));
    EXPECT_EQ(mesh.statistics().invalid_queries, before + 1);
    EXPECT_EQ(motion.chords(bad), 0U);
    // Far away: either an answer, or none; never long.
    const Scalar huge = std::numeric_limits<Scalar>::max() / 4;
    EXPECT_FALSE(mesh.sweep(Segment<Scalar>{{huge, huge, 1}, {huge, 0, -1}}, motion));
    EXPECT_FALSE(mesh.sweep(down, motion, {.max_fraction = std::nan("")}));
    const RigidMotion moved_to = std::move(motion);
    EXPECT_TRUE(mesh.sweep(down, moved_to));
    EXPECT_FALSE(mesh.sweep(down, motion));  // NOLINT(bugprone-use-after-move)
    EXPECT_FALSE(CollisionMesh<Scalar>().sweep(down, moved_to));
}

}  // namespace
}  // namespace pierce::test
