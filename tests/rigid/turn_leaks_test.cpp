// A turning drum full of particles, and a swinging door in a cloud of them: nobody gets through, whatever the
// tolerance. Judged by whole-number arithmetic on the mesh and the images of the particles (inside_judge.h), after each
// step; at the door also by the true motion within each step.
#include <cmath>

#include <gtest/gtest.h>

#include <pierce/collision_mesh.h>
#include <point.h>
#include <rigid/inside_judge.h>
#include <rigid/true_turn.h>
#include <support/meshes.h>

namespace pierce::test {
namespace {

/// A drum around the z axis, with eight paddles inside.
TriangleSoup<double> drum(int n) {
    return star(n, [](const Vec3<double>& d) {
        const double wall = std::min(1 / std::hypot(d[0], d[1]), 0.8 / std::abs(d[2]));
        const double paddle = 0.3 * std::pow(std::cos(4 * std::atan2(d[1], d[0])), 8) * std::hypot(d[0], d[1]);
        return wall * (1 - paddle);
    });
}
/// A leaf of 1 by 2, 0.02 thick, hung up at the z axis.
TriangleSoup<double> door() {
    TriangleSoup<double> soup = Polycube(1, 1, 1, 1).soup;
    for (Vec3<double>& p : soup.positions) p = Vec3<double>(p[0], 0.02 * p[1] - 0.01, 2 * p[2] - 1);
    return soup;
}

/// How deep a point is in the door.
double depth_in_door(const Long3& x) {
    const Long3 low = x - Long3(0, -0.01L, -1);
    const Long3 high = Long3(1, 0.01L, 1) - x;
    return static_cast<double>(std::min(low.minCoeff(), high.minCoeff()));
}

struct Tally {
    int leaks = 0;
    int deep = 0;  ///< ways without a hit that came deeper than the tolerance into the door
    int contacts = 0;
    int rides = 0;    ///< places in the world that were not verified
    int unknown = 0;  ///< on the surface, as a rule
};

template <class Scalar>
struct Particle {
    Vec3<Scalar> at;
    std::optional<Vec3<Scalar>> local;  ///< where it rides
    Vec3<double> velocity;
    bool inside;
    int kind;  ///< rests, bounces, rides on what it meets
};

/// Returns whether it went where it wanted to.
template <class Scalar>
bool move(Particle<Scalar>& p, const CollisionMesh<Scalar>& mesh, const RigidMotion& motion, Tally& tally) {
    const QueryOptions options{.sides = p.inside ? Sides::back : Sides::front};
    p.velocity[1] -= 0.004;
    for (int attempt = 0;; ++attempt) {
        const Vec3<Scalar> to = (p.at.template cast<double>() + p.velocity).template cast<Scalar>();
        const auto hit = p.local ? mesh.sweep(Ride<Scalar>{*p.local, to}, motion, options)
                                 : mesh.sweep(Segment<Scalar>{p.at, to}, motion, options);
        if (!hit) {
            p.at = to;
            p.local.reset();
            return true;
        }
        ++tally.contacts;
        const Vec3<double> normal = hit->facing().template cast<double>();
        const Vec3<double> surface = hit->surface_motion.template cast<double>();
        const double approach = normal.dot(p.velocity - surface);
        if (p.kind == 2)
            p.velocity = surface;
        else
            p.velocity -= (p.kind == 1 ? 1.8 : 1) * std::min(approach, 0.0) * normal;
        if (p.velocity.norm() > 0.4) p.velocity *= 0.4 / p.velocity.norm();
        if (attempt < 2 && p.kind != 2) continue;
        p.at = hit->place;
        p.local.reset();
        tally.rides += hit->place_verified ? 0 : 1;
        if (!hit->place_verified || p.kind == 2) p.local = hit->local.vec();
        return false;
    }
}

template <class Scalar, class ScrewOf>
Tally play(const TriangleSoup<double>& shape, int count, int steps, double offset, double tolerance,
           double outside_left_out, bool is_door, std::uint64_t seed, ScrewOf&& screw_of) {
    const TriangleSoup<Scalar> soup = moved<Scalar>(shape, 1, {0, 0, 0});
    const CollisionMesh<Scalar> mesh(soup.view());
    EXPECT_TRUE(mesh.mesh_report().closed());
    // On the surface is on the side that a particle is to stay on.
    InsideJudge<Scalar> judge(soup);
    InsideJudge<Scalar> judge_of_inside(turned_inside_out(soup));
    using Where = typename InsideJudge<Scalar>::Where;
    Pose<double> pose;
    pose.translation = Vec3<double>(offset, -offset, offset);
    Random random(seed);
    std::vector<Particle<Scalar>> particles;
    const RigidMotion at_rest(pose, pose, tolerance);
    while (static_cast<int>(particles.size()) < count) {
        const Vec3<Scalar> at = (1.2 * random.in_cube() + pose.translation).template cast<Scalar>();
        const Where where = judge.where(at_rest.start_in_mesh(at));
        if (where == Where::unknown || (where == Where::outside && random.chance(outside_left_out))) continue;
        particles.push_back(
            {at, {}, 0.1 * random.in_cube(), where == Where::inside, static_cast<int>(particles.size() % 3)});
    }
    Tally tally;
    for (int s = 0; s < steps; ++s) {
        const Screw screw = screw_of(s, pose);
        const RigidMotion motion(pose, screw, tolerance);
        const TrueTurn truth(pose, screw);
        for (Particle<Scalar>& p : particles) {
            const bool rode = p.local.has_value();
            const Long3 from = p.at.template cast<long double>();
            if (move(p, mesh, motion, tally) && is_door && !p.inside && !rode)
                for (int part = 0; part <= 32; ++part) {
                    const long double time = part / 32.0L;
                    const Long3 at = from + time * (p.at.template cast<long double>() - from);
                    if (depth_in_door(truth.in_mesh(at, time)) <= tolerance) continue;
                    ++tally.deep;
                    break;
                }
            const Vec3<Scalar> local = p.local ? *p.local : motion.end_in_mesh(p.at);
            const double far = local.template cast<double>().cwiseAbs().maxCoeff();
            const Where where = far > 7 ? Where::outside : p.inside ? judge_of_inside.where(local) : judge.where(local);
            if (where == Where::unknown)
                ++tally.unknown;
            else if ((where == Where::inside) != p.inside)
                ++tally.leaks, p.inside = !p.inside;
            // What is outside comes back to the mesh all the time.
            if (far > 2 || (!p.inside && random.chance(0.05)))
                p.velocity = 0.1 * (pose.translation + random.in_cube() - p.at.template cast<double>());
        }
        pose = motion.end();
    }
    return tally;
}

template <class Scalar>
class TurnLeaks : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(TurnLeaks, Scalars);

template <class Scalar, class ScrewOf>
void expect_none(const TriangleSoup<double>& shape, int count, int steps, double outside_left_out, ScrewOf&& screw_of) {
    std::uint64_t seed = 0;
    for (const double offset : {0.0, 1000.0})
        for (const double tolerance : {1e-2, 1e-4}) {
            const Tally tally = play<Scalar>(shape, count, steps, offset, tolerance, outside_left_out,
                                             outside_left_out == 0, ++seed, screw_of);
            std::cout << "offset " << offset << ", tolerance " << tolerance << ": " << tally.contacts << " contacts, "
                      << tally.rides << " ride, " << tally.unknown << " on the surface, " << tally.leaks << " leaks\n";
            EXPECT_EQ(tally.leaks, 0) << "case " << seed;
            EXPECT_EQ(tally.deep, 0) << "case " << seed;
            EXPECT_GT(tally.contacts, count * steps / 20) << "case " << seed;
            EXPECT_LE(tally.unknown, count * steps / 100) << "case " << seed;
        }
}

Screw turning(int, const Pose<double>& pose) { return {pose.translation, {0, 0, 1}, 0.12}; }
Screw tumbling(int step, const Pose<double>& pose) {
    return {pose.translation + Vec3<double>(0.3, 0, 0), {std::sin(0.1 * step), 0.5, 1}, 0.7, 0.02 * std::sin(step)};
}
Screw swinging(int step, const Pose<double>& pose) { return {pose.translation, {0, 0, 1}, 0.5 * std::sin(0.2 * step)}; }

TYPED_TEST(TurnLeaks, ADrumKeepsWhatIsInIt) { expect_none<TypeParam>(drum(6), 40, 100, 0.9, turning); }
TYPED_TEST(TurnLeaks, ADrumThatTumbles) { expect_none<TypeParam>(drum(5), 30, 60, 0.8, tumbling); }
TYPED_TEST(TurnLeaks, ADoorLetsNobodyThrough) { expect_none<TypeParam>(door(), 60, 150, 0, swinging); }
TYPED_TEST(TurnLeaks, ADrumKeepsWhatIsInItSoak) { expect_none<TypeParam>(drum(8), 1000, 1000, 0.9, turning); }
TYPED_TEST(TurnLeaks, ADrumThatTumblesSoak) { expect_none<TypeParam>(drum(8), 1000, 1000, 0.8, tumbling); }
TYPED_TEST(TurnLeaks, ADoorLetsNobodyThroughSoak) { expect_none<TypeParam>(door(), 1000, 1000, 0, swinging); }

}  // namespace
}  // namespace pierce::test
