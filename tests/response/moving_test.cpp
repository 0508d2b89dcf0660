// Moves on a mesh that moves: bounces, rides and rests by their formulas, seen from the mesh; batches.
#include <cmath>

#include <deform/shapes.h>
#include <gtest/gtest.h>
#include <pierce/deforming_mesh.h>
#include <support/executors.h>

#include "ramps.h"

namespace pierce::test {
namespace {

template <class Scalar>
class MovingMeshes : public ::testing::Test {};
TYPED_TEST_SUITE(MovingMeshes, Both);

/// A floor whose positions are given by a function of the time.
template <class Scalar>
struct Platform {
    TriangleSoup<double> rest;
    TriangleSoup<Scalar> now;
    DeformingMesh<Scalar> mesh;

    template <class At>
    explicit Platform(const At& at) : rest(flat()), now{placed(at, 0), rest.triangles, {}}, mesh(now.view()) {}
    template <class At>
    DeformationStep<Scalar> go(const At& at, double time) {
        now.positions = placed(at, time);
        mesh.begin_step(now.positions);
        return mesh.step();
    }

  private:
    static TriangleSoup<double> flat() {
        TriangleSoup<double> soup;
        add_floor<double>(soup, V(-5, -5, 0), V::UnitX(), V::UnitY(), 10, 1, 0.3);
        return soup;
    }
    template <class At>
    std::vector<Vec3<Scalar>> placed(const At& at, double time) const {
        std::vector<Vec3<Scalar>> out;
        for (const V& p : rest.positions) out.push_back(V(at(p, time)).template cast<Scalar>());
        return out;
    }
};

// A racket that comes: what is at rest leaves it with twice its speed, from where and when they met.
TYPED_TEST(MovingMeshes, a_racket_strikes_a_ball_at_rest) {
    using Scalar = TypeParam;
    const auto at = [](const V& p, double time) { return V(p[2] + 4 * time, p[0], p[1]); };
    for (const double restitution : {1.0, 0.25}) {
        Platform<Scalar> racket(at);
        const DeformationStep<Scalar> step = racket.go(at, 0.25);
        const MoveOptions<Scalar> options{.response = {.restitution = Scalar(restitution)}};
        std::array<MoveContact<Scalar>, 4> contacts;
        const Vec3<Scalar> from(Scalar(0.4), Scalar(0.2), Scalar(0.1));
        const Move<Scalar> move = move_and_bounce(step, from, Vec3<Scalar>::Zero(), Scalar(0.25), options, contacts);
        ASSERT_EQ(move.contacts, 1U);
        EXPECT_EQ(move.state, MoveState::slid);
        const double speed = 4 * (1 + restitution);
        EXPECT_NEAR(double(move.velocity[0]), speed, 1e-5);
        EXPECT_NEAR(double(contacts[0].seconds), 0.25 - 0.1, 1e-5);
        EXPECT_NEAR(double(contacts[0].speed), 4, 1e-5);
        EXPECT_NEAR(double(move.position[0]), 0.4 + speed * 0.15, 1e-5);
        EXPECT_NEAR(double(move.position[1]), 0.2, 1e-6);
        // It slides only: it goes with the racket.
        const Move<Scalar> pushed = move_and_slide(step, from, Vec3<Scalar>(0, 1, 0), Scalar(0.25), options);
        EXPECT_NEAR(double(pushed.velocity[0]), 4, 1e-5);
        EXPECT_EQ(pushed.velocity[1], Scalar(1));
        EXPECT_NEAR(double(pushed.position[0]), 1, 1e-5);
        EXPECT_NEAR(double(pushed.position[1]), 0.45, 1e-5);
        // `max_fraction` would let it through what comes later.
        MoveOptions<Scalar> limited = options;
        for (const double limit : {0.01, -1.0, std::nan("")}) {
            limited.query.max_fraction = limit;
            const Move<Scalar> same =
                move_and_bounce(step, from, Vec3<Scalar>::Zero(), Scalar(0.25), limited, contacts);
            EXPECT_TRUE(same_bits(same, move)) << limit;
        }
        // From behind only: it is passed.
        MoveOptions<Scalar> back = options;
        back.query.sides = Sides::back;
        EXPECT_EQ(move_and_bounce(step, from, Vec3<Scalar>::Zero(), Scalar(0.25), back).state, MoveState::free);
    }
}

// Seen from a mesh that goes along at a constant velocity all is as on one at rest.
TYPED_TEST(MovingMeshes, do_what_a_mesh_at_rest_does_seen_from_them) {
    using Scalar = TypeParam;
    const V with(1, -0.5, 0.75);
    const TriangleSoup<double> rest = star(4, [](const V&) { return 2.0; });
    const CollisionMesh<double> still(rest.view());
    Random random(3);
    for (const bool bounces : {false, true}) {
        TriangleSoup<Scalar> soup{shaped<Scalar>(
                                      rest, [](const V& p, double) { return p; }, 0, 0),
                                  rest.triangles,
                                  {}};
        DeformingMesh<Scalar> mesh(soup.view());
        std::vector<Move<double>> seen(60);
        std::vector<Move<Scalar>> moves(seen.size());
        for (std::size_t i = 0; i < seen.size(); ++i) {
            seen[i].position = random.in_cube();
            seen[i].velocity = 3 * random.in_cube();
            moves[i].position = seen[i].position.template cast<Scalar>();
            moves[i].velocity = V(seen[i].velocity + with).template cast<Scalar>();
        }
        const double dt = 1.0 / 64;
        int met = 0, apart = 0;
        for (int s = 1; s <= 300; ++s) {
            for (std::size_t v = 0; v < soup.positions.size(); ++v)
                soup.positions[v] = V(rest.positions[v] + s * dt * with).template cast<Scalar>();
            mesh.begin_step(soup.positions);
            const DeformationStep<Scalar> step = mesh.step();
            for (std::size_t i = 0; i < seen.size(); ++i) {
                const V push(0, 0, -2 * dt);
                MoveOptions<double> options{.query = {.sides = Sides::back},
                                            .response = {.restitution = 0.75, .friction = 0.125}};
                MoveOptions<Scalar> moving{.query = options.query,
                                           .response = {.restitution = Scalar(0.75), .friction = Scalar(0.125)}};
                seen[i] = move_either(bounces, still, seen[i].position, V(seen[i].velocity + push), dt, options);
                moves[i] =
                    move_either(bounces, step, moves[i].position,
                                Vec3<Scalar>(moves[i].velocity + push.template cast<Scalar>()), Scalar(dt), moving);
                met += moves[i].contacts > 0 ? 1 : 0;
                const V x = moves[i].position.template cast<double>() - s * dt * with;
                if ((x - seen[i].position).norm() > (sizeof(Scalar) == 4 ? 1e-2 : 1e-7)) ++apart;
                ASSERT_FALSE(moves[i].state == MoveState::crushed || moves[i].state == MoveState::invalid);
            }
        }
        EXPECT_GT(met, 200);
        std::cout << met << " with contacts, " << apart << " apart\n";
        // Where it meets two faces at about the same time, the two may differ: and from there on.
        EXPECT_LE(apart, 18'000 / 10) << bounces;
    }
}

/// Where a point is in the coordinates of the mesh at rest: by Newton's method.
template <class At>
V where(const At& at, double time, const V& x) {
    V p = V::Zero();
    for (int round = 0; round < 30; ++round) {
        Eigen::Matrix3d slope;
        for (int k = 0; k < 3; ++k) slope.col(k) = at(V(p + V::Unit(k)), time) - at(p, time);
        p -= slope.inverse() * (at(p, time) - x);
    }
    return p;
}

// What friction holds rides: on a floor that turns, tilts, goes up and down and stretches it stays at its place.
TYPED_TEST(MovingMeshes, what_rests_rides) {
    using Scalar = TypeParam;
    for (const double offset : {0.0, 1e3}) {
        const auto at = [offset](const V& p, double time) {
            const Eigen::AngleAxisd turn(0.5 * time, V::UnitZ());
            const Eigen::AngleAxisd tilt(0.1 * std::sin(3 * time), V(1, 0.5, 0).normalized());
            return V(turn * (tilt * V((1 + 0.1 * std::sin(time)) * p)) +
                     V(offset + 3 * time, offset, offset + 0.1 * std::sin(4 * time)));
        };
        Platform<Scalar> platform(at);
        const MoveOptions<Scalar> options{.response = {.friction = 10}};
        Random random(8);
        std::vector<V> places;
        std::vector<Move<Scalar>> moves(40);
        for (Move<Scalar>& move : moves) {
            places.emplace_back(random.between(-4, 4), random.between(-4, 4), 0);
            move.position = V(at(V(places.back() + V(0, 0, 0.01)), 0)).template cast<Scalar>();
            move.velocity.setZero();
        }
        const double dt = 1.0 / 120;
        int resting = 0;
        constexpr int k_steps = 360;
        for (int s = 1; s <= k_steps; ++s) {
            const DeformationStep<Scalar> step = platform.go(at, s * dt);
            for (Move<Scalar>& move : moves) {
                move = move_and_bounce(step, move.position,
                                       Vec3<Scalar>(move.velocity - Vec3<Scalar>(0, 0, Scalar(9.81 * dt))), Scalar(dt),
                                       options);
                resting += move.state == MoveState::resting ? 1 : 0;
                ASSERT_NE(move.state, MoveState::crushed);
                if (s == 60)
                    places[static_cast<std::size_t>(&move - moves.data())] =
                        where(at, s * dt, V(move.position.template cast<double>()));
            }
        }
        for (std::size_t i = 0; i < moves.size(); ++i) {
            const V in_mesh = where(at, k_steps * dt, V(moves[i].position.template cast<double>()));
            const double unit = k_epsilon<Scalar> * (offset + 20);
            EXPECT_LE((in_mesh - places[i]).head(2).norm(), 300 * 4 * unit) << i;
            EXPECT_LE(std::abs(in_mesh[2]), 1e-3 + 64 * unit) << i;
        }
        EXPECT_GT(resting, 40 * k_steps * 9 / 10) << offset;
    }
}

// In a step in which nothing moves: it rests to the last bit, and slides as on a mesh at rest.
TYPED_TEST(MovingMeshes, that_do_not_move_are_meshes_at_rest) {
    using Scalar = TypeParam;
    for (const double offset : {0.0, 1e3, 1e6}) {
        const auto at = [offset](const V& p, double time) { return V(p + V(offset, offset, offset + 0 * time)); };
        Platform<Scalar> platform(at);
        const MoveOptions<Scalar> options{.response = {.friction = 1}};
        Move<Scalar> move{};
        move.position = V(offset + 0.3, offset + 0.2, offset + 1).template cast<Scalar>();
        move.velocity.setZero();
        const Vec3<Scalar> push(0, 0, Scalar(-9.81 / 60));
        for (int step = 0; step < 240 && move.state != MoveState::resting; ++step)
            move = move_and_bounce(platform.go(at, 0), move.position, Vec3<Scalar>(move.velocity + push),
                                   Scalar(1) / 60, options);
        ASSERT_EQ(move.state, MoveState::resting);
        const Vec3<Scalar> place = move.position;
        for (int step = 0; step < 200; ++step) {
            move = move_and_bounce(platform.go(at, 0), move.position, Vec3<Scalar>(move.velocity + push),
                                   Scalar(1) / 60, options);
            ASSERT_TRUE(same_bits(move.position, place)) << offset << ' ' << step;
            ASSERT_LE(move.casts, 2);
            // Far away in float a step is less than what it lies above the floor by.
            if (sizeof(Scalar) == 8 || offset < 1e5) {
                ASSERT_EQ(move.state, MoveState::resting);
                ASSERT_EQ(move.velocity, (Vec3<Scalar>::Zero()));
            }
        }
        if (sizeof(Scalar) == 4 && offset > 1e5) continue;
        const Vec3<Scalar> v(2, Scalar(0.5), 0);
        const Move<Scalar> slid = move_and_slide(platform.go(at, 0), place, Vec3<Scalar>(v + push), Scalar(1) / 60);
        EXPECT_EQ(slid.velocity, v);
        const double step = std::ldexp(k_epsilon<Scalar>, std::ilogb(offset + 1));
        EXPECT_LE((slid.position - place - v / Scalar(60)).template cast<double>().norm(), 8 * step);
    }
}

TYPED_TEST(MovingMeshes, batches_are_single_calls_and_what_has_no_meaning_stays) {
    using Scalar = TypeParam;
    const TriangleSoup<double> rest = star(5, [](const V&) { return 1.0; });
    TriangleSoup<Scalar> soup{shaped<Scalar>(rest, beating, 0, 0), rest.triangles, {}};
    DeformingMesh<Scalar> mesh(soup.view());
    mesh.begin_step(shaped<Scalar>(rest, beating, 0.1, 0));
    const DeformationStep<Scalar> step = mesh.step();
    Random random(6);
    constexpr std::size_t k_count = 2500, k_room = 3;
    std::vector<Vec3<Scalar>> x, v;
    for (std::size_t i = 0; i < k_count; ++i) {
        x.push_back(V(1.2 * random.in_cube()).cast<Scalar>());
        v.push_back(V(0.5 * random.in_cube()).cast<Scalar>());
    }
    v[17][1] = std::numeric_limits<Scalar>::quiet_NaN();
    const Reversed reversed;
    const Threads threads;
    for (const bool bounces : {false, true}) {
        const auto call = [&](const DeformationStep<Scalar>& in, const auto&... given) {
            return move_either(bounces, in, given...);
        };
        QueryCounters single_counters;
        MoveOptions<Scalar> options{.query = {.sides = Sides::both, .counters = &single_counters},
                                    .response = {.restitution = Scalar(0.5), .friction = Scalar(0.1)}};
        std::vector<Move<Scalar>> single(k_count);
        std::vector<MoveContact<Scalar>> contacts(k_count * k_room);
        std::size_t met = 0;
        for (std::size_t i = 0; i < k_count; ++i) {
            single[i] = call(step, x[i], v[i], Scalar(1), options, std::span(contacts).subspan(i * k_room, k_room));
            met += single[i].contacts > 0 ? 1U : 0U;
        }
        EXPECT_EQ(single[17].state, MoveState::invalid);
        EXPECT_GT(met, k_count / 10);
        for (const Executor& executor : {Executor(), Executor(reversed), Executor(threads)}) {
            QueryCounters counters;
            options.query.counters = &counters;
            std::vector<Move<Scalar>> all(k_count);
            std::vector<MoveContact<Scalar>> all_contacts(k_count * k_room);
            EXPECT_EQ(move_all_either(bounces, step, x, v, Scalar(1), all, options, executor, all_contacts), met);
            for (std::size_t i = 0; i < k_count; ++i) ASSERT_TRUE(same_bits(single[i], all[i])) << i;
            for (std::size_t i = 0; i < contacts.size(); ++i) ASSERT_TRUE(same_bits(contacts[i], all_contacts[i])) << i;
            EXPECT_EQ(counters.queries, single_counters.queries);
        }
        std::vector<Move<Scalar>> few(k_count - 1);
        EXPECT_THROW(move_all_either(bounces, step, x, v, Scalar(1), few), std::invalid_argument);
        const auto expect_invalid = [&](const Vec3<Scalar>& from, const Vec3<Scalar>& velocity, Scalar seconds,
                                        Scalar radius) {
            const std::uint64_t before = step.before().statistics().invalid_queries;
            MoveOptions<Scalar> given;
            given.radius = radius;
            const Move<Scalar> move = call(step, from, velocity, seconds, given);
            EXPECT_EQ(move.state, MoveState::invalid);
            EXPECT_TRUE(same_bits(move.position, from));
            EXPECT_EQ(step.before().statistics().invalid_queries, before + 1);
        };
        const Scalar infinity = std::numeric_limits<Scalar>::infinity();
        expect_invalid(x[0], v[0], 0, 0);
        expect_invalid(x[0], v[0], -1, 0);
        expect_invalid(x[0], v[0], infinity, 0);
        expect_invalid(x[0], v[0], 1, Scalar(0.5));
        expect_invalid(Vec3<Scalar>(infinity, 0, 0), v[0], 1, 0);
        expect_invalid(x[0], Vec3<Scalar>(0, infinity, 0), 1, 0);
        // A step without a mesh stops nothing; extreme numbers are total.
        EXPECT_EQ(call(DeformationStep<Scalar>(), x[0], v[0], Scalar(1)).position, Vec3<Scalar>(x[0] + v[0]));
        const Scalar tiny = std::numeric_limits<Scalar>::denorm_min();
        const Scalar most = std::numeric_limits<Scalar>::max();
        for (const Scalar seconds : {tiny, std::numeric_limits<Scalar>::min(), Scalar(1), most})
            for (const Scalar speed : {tiny, Scalar(1), most / 4})
                for (std::size_t i = 0; i < 30; ++i)
                    EXPECT_TRUE(call(step, x[i], Vec3<Scalar>(v[i].normalized() * speed), seconds, options)
                                    .position.allFinite());
    }
}

}  // namespace
}  // namespace pierce::test
