// Bounces, friction and surfaces that move, by their formulas.
#include <gtest/gtest.h>
#include <support/inside_oracle.h>

#include "ramps.h"

namespace pierce::test {
namespace {

template <class Scalar>
class Bounces : public ::testing::Test {};
TYPED_TEST_SUITE(Bounces, Both);

// On a slope of angle a friction holds it if tan(a) is less than it; else it slides at g (sin a - f cos a).
TYPED_TEST(Bounces, friction_is_that_of_coulomb) {
    using Scalar = TypeParam;
    for (const double offset : {0.0, 1e3})
        for (const double degrees : {5.0, 20.0, 35.0})
            for (const double friction : {0.05, 0.3, 0.9}) {
                const double a = radians(degrees);
                const V up(std::sin(a), 0, std::cos(a));
                const V down(std::cos(a), 0, -std::sin(a));
                const V middle = offset * V(1, 1, 1);
                const CollisionMesh<Scalar> mesh = floor_at<Scalar>(middle, up);
                const MoveOptions<Scalar> options{.response = {.friction = Scalar(friction)}};
                Vec3<Scalar> start = V(middle + 0.1 * up - 5 * down).cast<Scalar>();
                start = mesh.sweep({start, V(middle - 0.1 * up - 5 * down).cast<Scalar>()})->point;
                const Move<Scalar> end = fall<Scalar>(
                    start, V(0, 0, -9.81), 120, 1.0 / 120,
                    [&](const auto& x, const auto& v, Scalar dt) { return move_and_bounce(mesh, x, v, dt, options); });
                const double way = (end.position - start).template cast<double>().dot(down);
                if (std::tan(a) < friction) {
                    EXPECT_EQ(way, 0) << degrees << ' ' << friction;
                    EXPECT_EQ(end.state, MoveState::resting);
                } else {
                    const double expected = 9.81 * (std::sin(a) - friction * std::cos(a)) * 121.0 / 120 / 2;
                    EXPECT_NEAR(way / expected, 1, 0.01) << offset << ' ' << degrees << ' ' << friction;
                }
            }
}

// In a groove whose sides rise by b each of them pushes with g cos(a) / (2 cos(b)).
TYPED_TEST(Bounces, friction_in_a_groove_is_that_of_both_sides) {
    using Scalar = TypeParam;
    const double a = radians(40);
    const double friction = 0.3;
    for (const double rise : {30.0, 60.0}) {
        const double b = radians(rise);
        const V down(std::cos(a), 0, -std::sin(a));
        const V up(std::sin(a), 0, std::cos(a));
        const V left = std::cos(b) * V::UnitY() + std::sin(b) * up;
        const V right = -std::cos(b) * V::UnitY() + std::sin(b) * up;
        TriangleSoup<Scalar> soup;
        add_floor<Scalar>(soup, -10 * down, down, left, 10, 4);
        add_floor<Scalar>(soup, -10 * down, right, down, 10, 4);
        const CollisionMesh<Scalar> mesh(soup.view());
        const Vec3<Scalar> start = mesh.sweep({V(0, 0, 1).cast<Scalar>(), V(0, 0, -1).cast<Scalar>()})->point;
        for (const double f : {friction, 2.0}) {
            const MoveOptions<Scalar> options{.response = {.friction = Scalar(f)}};
            const Move<Scalar> end = fall<Scalar>(
                start, V(0, 0, -9.81), 120, 1.0 / 120,
                [&](const auto& x, const auto& v, Scalar dt) { return move_and_bounce(mesh, x, v, dt, options); });
            const double way = (end.position - start).template cast<double>().dot(down);
            const double acceleration = 9.81 * (std::sin(a) - f * std::cos(a) / std::cos(b));
            if (f > friction) {
                EXPECT_EQ(end.state, MoveState::resting);
                EXPECT_EQ(way, 0);
            } else {
                EXPECT_NEAR(way / std::max(acceleration * 121 / 120 / 2, 1e-3), 1, 0.01) << rise;
            }
        }
    }
}

// In a closed convex box without gravity: with restitution 1 the energy stays, with less each bounce takes its share.
TYPED_TEST(Bounces, bounces_keep_the_energy_that_they_should) {
    using Scalar = TypeParam;
    Random random(5);
    for (const double offset : {0.0, 1e3}) {
        const TriangleSoup<Scalar> soup = moved<Scalar>(polycube(1, 1, 2, 1), 1, offset * V(1, 1, 1));
        const InsideOracle<Scalar> oracle(soup);
        const CollisionMesh<Scalar> mesh(soup.view());
        std::vector<MoveContact<Scalar>> contacts(64);
        for (int i = 0; i < 200; ++i) {
            const double e = i % 2 == 0 ? 1 : random.between(0.5, 1);
            const MoveOptions<Scalar> options{
                .query = {.sides = Sides::back}, .response = {.restitution = Scalar(e)}, .max_casts = 64};
            Vec3<Scalar> x = V(offset * V(1, 1, 1) + V(1, 1, 1) + 0.9 * random.in_cube()).cast<Scalar>();
            Vec3<Scalar> v = V(5 * random.direction()).cast<Scalar>();
            const double speed = v.template cast<double>().norm();
            double lost = 0;
            for (int step = 0; step < 60; ++step) {
                const Move<Scalar> move = move_and_bounce(mesh, x, v, Scalar(0.1), options, contacts);
                ASSERT_LE(move.contacts, contacts.size());
                for (std::size_t k = 0; k < move.contacts; ++k) {
                    ASSERT_GT(contacts[k].speed, 0);
                    lost += (1 - double(Scalar(e)) * double(Scalar(e))) * std::pow(double(contacts[k].speed), 2);
                    EXPECT_EQ(contacts[k].side, Sides::back);
                }
                ASSERT_EQ(move.remainder, Vec3<Scalar>::Zero());
                x = move.position;
                v = move.velocity;
                ASSERT_FALSE(oracle.outside(x));
            }
            const double energy = v.template cast<double>().squaredNorm();
            EXPECT_NEAR(energy + lost, speed * speed, 500 * k_epsilon<Scalar> * speed * speed) << i;
        }
    }
}

// A ball that is let fall from a height bounces to e^2 times that; below its rest speed it stays.
TYPED_TEST(Bounces, heights_of_bounces_and_rest) {
    using Scalar = TypeParam;
    const CollisionMesh<Scalar> mesh = floor_at<Scalar>(V(0, 0, 1), V(0, 0, 1));
    const double dt = 1.0 / 1000;
    MoveOptions<Scalar> options{
        .response = {.restitution = Scalar(0.8), .rest_speed = Scalar(2 * 9.81 * dt / (1 - 0.8))}};
    Move<Scalar> move{};
    move.position = Vec3<Scalar>(Scalar(0.3), Scalar(0.2), 2);
    move.velocity.setZero();
    double top = 0;
    bool risen = false;
    int step = 0;
    for (; step < 60'000 && move.state != MoveState::resting; ++step) {
        move =
            move_and_bounce(mesh, move.position, Vec3<Scalar>(move.velocity + Vec3<Scalar>(0, 0, Scalar(-9.81 * dt))),
                            Scalar(dt), options);
        if (move.contacts > 0 && !risen) risen = true;
        if (risen && step < 1000) top = std::max(top, double(move.position[2]) - 1);
    }
    EXPECT_NEAR(top, 0.64, 0.02);
    EXPECT_EQ(move.state, MoveState::resting);
    EXPECT_LT(step, 6000);  // after t (1 + e) / (1 - e) = 0.45 s * 9
    EXPECT_EQ(move.position[0], Scalar(0.3));
}

TYPED_TEST(Bounces, surfaces_that_move_take_it_along) {
    using Scalar = TypeParam;
    const CollisionMesh<Scalar> mesh = floor_at<Scalar>(V(0, 0, 1), V(0, 0, 1));
    const MoveOptions<Scalar> conveyor{.response = {.friction = Scalar(0.5), .velocity = {2, 1, 0}}};
    const Vec3<Scalar> start(Scalar(-3), Scalar(-2), Scalar(1.0001));
    const Move<Scalar> end = fall<Scalar>(
        start, V(0, 0, -9.81), 120, 1.0 / 60,
        [&](const auto& x, const auto& v, Scalar dt) { return move_and_bounce(mesh, x, v, dt, conveyor); });
    EXPECT_EQ(end.velocity, Vec3<Scalar>(2, 1, 0)) << "exactly that of the conveyor, and no faster";
    EXPECT_EQ(end.state, MoveState::slid);
    // 0.456 s until it is as fast: half of the way of that time is lost.
    EXPECT_NEAR(double(end.position[0] - start[0]), 2 * (2 - 0.456 / 2), 0.03);
    // A wall that comes pushes it: the velocity is that of the wall, and a bounce is on top of it.
    const Vec3<Scalar> down(1, 0, -3);
    const MoveOptions<Scalar> lift{.response = {.velocity = {0, 0, 2}}};
    EXPECT_EQ(move_and_slide(mesh, start, down, Scalar(0.1), lift).velocity, Vec3<Scalar>(1, 0, 2));
    const MoveOptions<Scalar> racket{.response = {.restitution = Scalar(0.5), .velocity = {0, 0, 2}}};
    EXPECT_NEAR(double(move_and_bounce(mesh, start, down, Scalar(0.1), racket).velocity[2]), 2 + 0.5 * 5, 1e-6);
    // By face: every other one is a conveyor.
    const auto by_face = [](const MoveContact<Scalar>& contact) -> Response<Scalar> {
        return {.friction = 10, .velocity = {contact.face % 2 == 0 ? Scalar(1) : Scalar(-1), 0, 0}};
    };
    std::array<MoveContact<Scalar>, 4> contacts;
    int either[2] = {};
    for (int i = 0; i < 20; ++i) {
        const Vec3<Scalar> at(Scalar(-4 + 0.4 * i), Scalar(0.1 * i), Scalar(1.0001));
        const Move<Scalar> move =
            move_and_bounce(mesh, at, Vec3<Scalar>(0, 0, -1), Scalar(1) / 60, {.response_at = by_face}, contacts);
        ASSERT_GE(move.contacts, 1U);
        EXPECT_EQ(move.velocity, Vec3<Scalar>(contacts[0].face % 2 == 0 ? Scalar(1) : Scalar(-1), 0, 0));
        ++either[contacts[0].face % 2];
    }
    EXPECT_GT(either[0], 0);
    EXPECT_GT(either[1], 0);
}

}  // namespace
}  // namespace pierce::test
