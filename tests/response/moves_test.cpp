// Single steps and what is said of them: rest, bounces, friction, moving surfaces, contacts, batches, costs, and what
// has no meaning.
#include <gtest/gtest.h>
#include <support/executors.h>

#include "ramps.h"

namespace pierce::test {
namespace {

template <class Scalar>
class Moves : public ::testing::Test {};
TYPED_TEST_SUITE(Moves, Both);

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
    EXPECT_EQ(none.state, MoveState::wedged);
    // Slow ones look along their way first, which takes the only query.
    const Vec3<Scalar> slow(std::numeric_limits<Scalar>::epsilon(), 0, 0);
    const Move<Scalar> stuck = move_and_slide(mesh, from, slow, Scalar(1), {.max_casts = 1});
    EXPECT_EQ(stuck.casts, 1);
    EXPECT_EQ(stuck.remainder, slow);
    EXPECT_EQ(stuck.state, MoveState::wedged);
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
            EXPECT_EQ(move_all_either(bounces, mesh, x, v, Scalar(1), all, options, executor, all_contacts), met);
            expect_same(single, all, contacts, all_contacts);
            EXPECT_EQ(counters.queries, single_counters.queries);
            EXPECT_EQ(counters.nodes, single_counters.nodes);
            // In place.
            for (std::size_t i = 0; i < k_count; ++i) {
                all[i].position = x[i];
                all[i].velocity = v[i];
            }
            const PointsView<Scalar> positions(all[0].position.data(), k_count, sizeof(Move<Scalar>));
            const PointsView<Scalar> velocities(all[0].velocity.data(), k_count, sizeof(Move<Scalar>));
            move_all_either(bounces, mesh, positions, velocities, Scalar(1), all, options, executor);
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
