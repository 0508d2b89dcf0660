// Single steps and what is said of them: rest, bounces, friction, moving surfaces, contacts, batches, costs, and what has
// no meaning.
#include <gtest/gtest.h>
#include <support/executors.h>
#include <support/inside_oracle.h>

#include "ramps.h"

namespace pierce::test {
namespace {

template <class Scalar>
class Moves : public ::testing::Test {};
TYPED_TEST_SUITE(Moves, Both);

template <class Scalar>
CollisionMesh<Scalar> floor_at(const V& middle, const V& up, double shift = 0.3) {
    TriangleSoup<Scalar> soup;
    const V u = up.unitOrthogonal();
    const V w = up.cross(u);
    add_floor<Scalar>(soup, middle - 10 * u - 10 * w, u, w, 20, 1, shift);
    return CollisionMesh<Scalar>(soup.view());
}

template <class Scalar>
constexpr double k_epsilon = static_cast<double>(std::numeric_limits<Scalar>::epsilon());

// Dropped on a floor that friction holds it on, then pushed into it step by step.
TYPED_TEST(Moves, what_rests_does_not_move_and_costs_what_a_free_one_does) {
    using Scalar = TypeParam;
    Random random(4);
    QueryCounters resting, free;
    std::uint64_t steps = 0;
    for (const double offset : {0.0, 1e3, 1e6})
        for (int i = 0; i < 40; ++i) {
            const bool level = i % 4 == 0;
            V up = level ? V(0, 0, 1) : V(0.4 * random.in_cube() + V(0, 0, 1)).normalized();
            if (!level && std::acos(up[2]) > 0.5) up = V(0, 0.3, 1).normalized();
            const V middle = offset * V(1, -1, 1) + (i % 8 == 0 ? 0 : 1) * random.in_cube();
            const CollisionMesh<Scalar> mesh = floor_at<Scalar>(middle, up);
            const MoveOptions<Scalar> options{.response = {.friction = 1}};
            const V aside = V(random.between(-3, 3), random.between(-3, 3), 0);
            Move<Scalar> move{};
            move.position = V(middle + 2 * up + aside).cast<Scalar>();
            move.velocity.setZero();
            const Vec3<Scalar> push(0, 0, Scalar(-9.81 / 60));
            for (int step = 0; step < 240 && move.state != MoveState::resting; ++step)
                move =
                    move_and_bounce(mesh, move.position, Vec3<Scalar>(move.velocity + push), Scalar(1) / 60, options);
            ASSERT_EQ(move.state, MoveState::resting) << offset << ' ' << i;
            ASSERT_EQ(move.velocity, Vec3<Scalar>::Zero());
            const Vec3<Scalar> place = move.position;
            // It is within a few grains of the plane, and in front of it.
            const double height = (place.template cast<double>() - middle).dot(up);
            EXPECT_LE(std::abs(height), 64 * k_epsilon<Scalar> * (std::abs(offset) + 20));
            MoveOptions<Scalar> counted = options;
            counted.query.counters = &resting;
            for (int step = 0; step < 1000; ++step) {
                move =
                    move_and_bounce(mesh, move.position, Vec3<Scalar>(move.velocity + push), Scalar(1) / 60, counted);
                ASSERT_TRUE(same_bits(move.position, place)) << step;
                ASSERT_EQ(move.state, MoveState::resting);
                ASSERT_EQ(move.casts, 1);
                ASSERT_EQ(move.travel, Vec3<Scalar>::Zero());
            }
            // The same step beside it, up in the air, and just above the floor.
            counted.query.counters = &free;
            const Vec3<Scalar> air = (place.template cast<double>() + 0.01 * up).template cast<Scalar>();
            for (int step = 0; step < 1000; ++step) (void)move_and_bounce(mesh, air, push, Scalar(1) / 60, counted);
            steps += 1000;
        }
    const auto per_step = [&](std::uint64_t count) { return static_cast<double>(count) / static_cast<double>(steps); };
    std::cout << "a step at rest, and a free one: nodes " << per_step(resting.nodes) << ", " << per_step(free.nodes)
              << "; clusters " << per_step(resting.clusters) << ", " << per_step(free.clusters) << "; triangles "
              << per_step(resting.triangles) << ", " << per_step(free.triangles) << "; exact "
              << per_step(resting.exact_decisions + resting.exact_values + resting.exact_sides + resting.exact_orders)
              << ", " << per_step(free.exact_decisions + free.exact_values + free.exact_sides + free.exact_orders)
              << '\n';
    EXPECT_EQ(resting.queries, steps);
    // At 1e6 in float the step is far shorter than a grain: a free one takes two.
    EXPECT_GE(free.queries, steps);
    EXPECT_LE(free.queries, sizeof(Scalar) == 4 ? steps * 4 / 3 : steps);
    // The free one is not as near to the triangles, so that the wide kernels refuse them all.
    EXPECT_LE(resting.nodes, free.nodes * 3 / 2);
    EXPECT_LE(resting.clusters, free.clusters * 2);
    EXPECT_LE(resting.triangles, free.triangles + 3 * steps / 2);
    EXPECT_LE(resting.exact_decisions, steps / 10);
    EXPECT_LE(resting.exact_values + resting.exact_sides + resting.exact_orders + resting.retreats, steps / 100);
}

// On a slope of angle a friction holds it if tan(a) is less than it; else it slides at g (sin a - f cos a).
TYPED_TEST(Moves, friction_is_that_of_coulomb) {
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
TYPED_TEST(Moves, friction_in_a_groove_is_that_of_both_sides) {
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
TYPED_TEST(Moves, bounces_keep_the_energy_that_they_should) {
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
            double seconds = 0;
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
                seconds += 0.1;
                ASSERT_FALSE(oracle.outside(x));
            }
            const double energy = v.template cast<double>().squaredNorm();
            EXPECT_NEAR(energy + lost, speed * speed, 500 * k_epsilon<Scalar> * speed * speed) << i;
        }
    }
}

// A ball that is let fall from a height bounces to e^2 times that; below its rest speed it stays.
TYPED_TEST(Moves, heights_of_bounces_and_rest) {
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

TYPED_TEST(Moves, surfaces_that_move_take_it_along) {
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

TYPED_TEST(Moves, say_what_they_met) {
    using Scalar = TypeParam;
    const CollisionMesh<Scalar> mesh = floor_at<Scalar>(V(0, 0, 1), V(0, 0, 1));
    std::array<MoveContact<Scalar>, 2> contacts{};
    const Vec3<Scalar> from(Scalar(0.3), Scalar(0.2), 2);
    const Vec3<Scalar> v(1, 0, -4);
    const Move<Scalar> move = move_and_slide(mesh, from, v, Scalar(1), {}, contacts);
    ASSERT_EQ(move.contacts, 1U);
    EXPECT_EQ(move.casts, 2);
    EXPECT_EQ(move.state, MoveState::slid);
    const auto hit = mesh.first_hit({from, from + v});
    EXPECT_EQ(contacts[0].face, hit->face);
    EXPECT_EQ(contacts[0].triangle, hit->triangle);
    EXPECT_EQ(contacts[0].side, Sides::front);
    EXPECT_TRUE(same_bits(contacts[0].point, hit->point));
    EXPECT_NEAR(double(contacts[0].seconds), 0.75, 1e-5);
    EXPECT_EQ(contacts[0].speed, Scalar(4));
    EXPECT_EQ(move.velocity, Vec3<Scalar>(1, 0, 0));
    EXPECT_NEAR(double(move.position[0]), 1.3, 1e-5);
    EXPECT_EQ(move.travel, Vec3<Scalar>(move.position - from));
    // No room for contacts: they are counted all the same.
    EXPECT_TRUE(same_bits(move_and_slide(mesh, from, v, Scalar(1)), move));
    // Nothing met.
    const Move<Scalar> free = move_and_slide(mesh, from, Vec3<Scalar>(1, 0, Scalar(0.5)), Scalar(1));
    EXPECT_EQ(free.state, MoveState::free);
    EXPECT_EQ(free.contacts, 0U);
    EXPECT_EQ(free.position, Vec3<Scalar>(from + Vec3<Scalar>(1, 0, Scalar(0.5))));
    EXPECT_EQ(free.velocity, Vec3<Scalar>(1, 0, Scalar(0.5)));
    // Queries used up: the rest of the way is said.
    const Move<Scalar> cut = move_and_slide(mesh, from, v, Scalar(1), {.max_casts = 1}, contacts);
    EXPECT_EQ(cut.casts, 1);
    EXPECT_TRUE(same_bits(cut.position, hit->point.vec()));
    EXPECT_NEAR(double(cut.remainder[0]), 0.75, 1e-5);
    const Move<Scalar> none = move_and_slide(mesh, from, v, Scalar(1), {.max_casts = 0}, contacts);
    EXPECT_EQ(none.casts, 0);
    EXPECT_EQ(none.position, from);
    EXPECT_EQ(none.remainder, v);
    // `max_fraction` would let it through what lies beyond.
    EXPECT_TRUE(same_bits(move_and_slide(mesh, from, v, Scalar(1), {.query = {.max_fraction = 0.01}}), move));
    // An empty mesh stops nothing.
    EXPECT_EQ(move_and_slide(CollisionMesh<Scalar>(), from, v, Scalar(1)).position, Vec3<Scalar>(from + v));
}

// Where to draw what touches something: off all that it touches, and never through what is above.
TYPED_TEST(Moves, lift_for_looks) {
    using Scalar = TypeParam;
    const TriangleSoup<Scalar> soup = moved<Scalar>(polycube(1, 1, 2, 1), 1, V(0, 0, 0));
    const CollisionMesh<Scalar> mesh(soup.view());
    const MoveOptions<Scalar> options{.query = {.sides = Sides::back}};
    std::array<MoveContact<Scalar>, 8> contacts;
    const Move<Scalar> move =
        move_and_slide(mesh, Vec3<Scalar>(1, 1, 1), Vec3<Scalar>(-3, -4, -5), Scalar(1), options, contacts);
    ASSERT_EQ(move.contacts, 3U);
    const auto met = std::span(contacts).first(move.contacts);
    const Vec3<Scalar> shown = lifted(mesh, move.position, met, Scalar(0.01), options.query);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(double(shown[k]), 0.01, 0.0003);
    // More than there is room for: it stays inside.
    const Vec3<Scalar> most = lifted(mesh, move.position, met, Scalar(50), options.query);
    for (int k = 0; k < 3; ++k) EXPECT_LE(most[k], Scalar(2));
    EXPECT_EQ(lifted(mesh, move.position, {}, Scalar(0.01), options.query), move.position);
    EXPECT_EQ(lifted(mesh, move.position, met, Scalar(0), options.query), move.position);
    EXPECT_EQ(lifted(mesh, move.position, met, std::numeric_limits<Scalar>::quiet_NaN(), options.query), move.position);
}

TYPED_TEST(Moves, without_a_meaning_move_nothing) {
    using Scalar = TypeParam;
    const CollisionMesh<Scalar> mesh = floor_at<Scalar>(V(0, 0, 1), V(0, 0, 1));
    const Scalar infinity = std::numeric_limits<Scalar>::infinity();
    const Scalar most = std::numeric_limits<Scalar>::max();
    std::uint64_t count = 0;
    const auto expect_invalid = [&](const Vec3<Scalar>& x, const Vec3<Scalar>& v, Scalar seconds) {
        for (const bool bounces : {false, true}) {
            std::array<MoveContact<Scalar>, 2> contacts{};
            const Move<Scalar> move = bounces ? move_and_bounce(mesh, x, v, seconds, {}, contacts)
                                              : move_and_slide(mesh, x, v, seconds, {}, contacts);
            ++count;
            EXPECT_EQ(move.state, MoveState::invalid);
            EXPECT_TRUE(same_bits(move.position, x));
            EXPECT_TRUE(same_bits(move.velocity, v));
            EXPECT_EQ(move.travel, Vec3<Scalar>::Zero());
            EXPECT_EQ(move.contacts, 0U);
            EXPECT_EQ(mesh.statistics().invalid_queries, count);
        }
    };
    const Vec3<Scalar> x(0, 0, 2), v(0, 0, -1);
    for (const Scalar bad : {std::numeric_limits<Scalar>::quiet_NaN(), infinity, -infinity})
        for (int k = 0; k < 3; ++k) {
            Vec3<Scalar> y = x, w = v;
            y[k] = w[k] = bad;
            expect_invalid(y, v, 1);
            expect_invalid(x, w, 1);
            expect_invalid(x, v, bad);
        }
    expect_invalid(x, v, -1);
    expect_invalid(x, Vec3<Scalar>(0, most, 0), 2);
    // The ends of the number range are fine.
    const Move<Scalar> fast = move_and_slide(mesh, x, Vec3<Scalar>(0, 0, -most), Scalar(1));
    EXPECT_EQ(fast.state, MoveState::resting);
    EXPECT_NEAR(double(fast.position[2]), 1, 1e-4);
    EXPECT_EQ(
        move_and_slide(mesh, x, Vec3<Scalar>(0, 0, -std::numeric_limits<Scalar>::denorm_min()), Scalar(1)).position, x);
    EXPECT_EQ(move_and_slide(mesh, x, v, Scalar(0)).position, x);
    EXPECT_EQ(mesh.statistics().invalid_queries, count);
    const Response<Scalar> nan{.restitution = std::numeric_limits<Scalar>::quiet_NaN(),
                               .friction = std::numeric_limits<Scalar>::quiet_NaN(),
                               .velocity = Vec3<Scalar>::Constant(std::numeric_limits<Scalar>::quiet_NaN())};
    EXPECT_TRUE(move_and_bounce(mesh, x, Vec3<Scalar>(0, 0, -4), Scalar(1), {.response = nan}).position.allFinite());
}

// Of two lists of moves and contacts.
template <class Scalar>
void expect_same(const std::vector<Move<Scalar>>& x, const std::vector<Move<Scalar>>& y,
                 const std::vector<MoveContact<Scalar>>& c, const std::vector<MoveContact<Scalar>>& d) {
    ASSERT_EQ(x.size(), y.size());
    for (std::size_t i = 0; i < x.size(); ++i) ASSERT_TRUE(same_bits(x[i], y[i])) << i;
    for (std::size_t i = 0; i < c.size(); ++i) ASSERT_TRUE(same_bits(c[i], d[i])) << i;
}

TYPED_TEST(Moves, batches_are_single_calls) {
    using Scalar = TypeParam;
    const TriangleSoup<Scalar> soup = moved<Scalar>(bumpy_sphere(10), 3, V(1, 2, 3));
    const CollisionMesh<Scalar> mesh(soup.view());
    Random random(6);
    constexpr std::size_t k_count = 3000, k_room = 3;
    std::vector<Vec3<Scalar>> x, v;
    for (std::size_t i = 0; i < k_count; ++i) {
        x.push_back(V(V(1, 2, 3) + 1.5 * random.in_cube()).cast<Scalar>());
        v.push_back(V(8 * random.in_cube()).cast<Scalar>());
    }
    v[17][1] = std::numeric_limits<Scalar>::quiet_NaN();
    for (const bool bounces : {false, true}) {
        QueryCounters single_counters;
        MoveOptions<Scalar> options{.query = {.sides = Sides::back, .counters = &single_counters},
                                    .response = {.restitution = Scalar(0.5), .friction = Scalar(0.1)}};
        std::vector<Move<Scalar>> single(k_count);
        std::vector<MoveContact<Scalar>> contacts(k_count * k_room);
        std::size_t met = 0;
        for (std::size_t i = 0; i < k_count; ++i) {
            const std::span room = std::span(contacts).subspan(i * k_room, k_room);
            single[i] = bounces ? move_and_bounce(mesh, x[i], v[i], Scalar(1), options, room)
                                : move_and_slide(mesh, x[i], v[i], Scalar(1), options, room);
            met += single[i].contacts > 0 ? 1U : 0U;
        }
        EXPECT_GT(met, k_count / 2);
        const Reversed reversed;
        const Threads threads;
        for (const Executor& executor : {Executor(), Executor(reversed), Executor(threads)}) {
            QueryCounters counters;
            options.query.counters = &counters;
            std::vector<Move<Scalar>> all(k_count);
            std::vector<MoveContact<Scalar>> all_contacts(k_count * k_room);
            const auto call = bounces ? moves_and_bounce<Scalar> : moves_and_slide<Scalar>;
            EXPECT_EQ(call(mesh, x, v, Scalar(1), all, options, executor, all_contacts), met);
            expect_same(single, all, contacts, all_contacts);
            EXPECT_EQ(counters.queries, single_counters.queries);
            EXPECT_EQ(counters.nodes, single_counters.nodes);
            // In place.
            for (std::size_t i = 0; i < k_count; ++i) {
                all[i].position = x[i];
                all[i].velocity = v[i];
            }
            call(mesh, {all[0].position.data(), k_count, sizeof(Move<Scalar>)},
                 {all[0].velocity.data(), k_count, sizeof(Move<Scalar>)}, Scalar(1), all, options, executor, {});
            expect_same<Scalar>(single, all, {}, {});
        }
    }
    std::vector<Move<Scalar>> few(k_count - 1);
    EXPECT_THROW(moves_and_slide(mesh, x, v, Scalar(1), few), std::invalid_argument);
    v.pop_back();
    EXPECT_THROW(moves_and_bounce(mesh, x, v, Scalar(1), few), std::invalid_argument);
    EXPECT_EQ(moves_and_slide(mesh, PointsView<Scalar>(), PointsView<Scalar>(), Scalar(1), std::span<Move<Scalar>>()),
              0U);
}

}  // namespace
}  // namespace pierce::test
