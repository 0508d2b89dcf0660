// Balls that are pushed around in closed rooms: each way of theirs clear by rational arithmetic; batches.
#include <gtest/gtest.h>
#include <support/executors.h>

#include "balls.h"

namespace pierce::test {
namespace {

template <class Scalar>
class BallWays : public ::testing::Test {};
TYPED_TEST_SUITE(BallWays, Both);

TYPED_TEST(BallWays, go_ways_that_are_clear) {
    using Scalar = TypeParam;
    std::uint64_t seed = 1;
    for (const double offset : {0.0, 1e3, 1e6})
        for (const double radius : {0.05, 0.3})
            for (const TriangleSoup<double>& unit : {polycube(3, 0.8, 1, 3), bumpy_sphere(5), bowl(5)}) {
                const V middle(offset, offset / 2, -offset);
                const TriangleSoup<Scalar> soup = moved<Scalar>(unit, 1, middle);
                const CollisionMesh<Scalar> mesh(soup.view());
                const std::vector<Corners> triangles = corners_of(soup);
                const auto r = static_cast<Scalar>(radius);
                Random random(seed++);
                Vec3<Scalar> at;
                int tries = 0;
                do {
                    at = V(3 * random.in_cube() + middle).cast<Scalar>();
                    ASSERT_LT(++tries, 2000);
                } while (!mesh.contains(at) || !is_clear(triangles, at, r));
                Vec3<Scalar> velocity = Vec3<Scalar>::Zero();
                std::array<MoveContact<Scalar>, 32> contacts;
                int met = 0, hits = 0, undone = 0;
                constexpr int k_steps = 120;
                for (int i = 0; i < k_steps; ++i) {
                    velocity[2] -= Scalar(9.81 / 60);
                    if (i % 30 == 0) velocity += V(9 * random.in_cube()).cast<Scalar>();
                    MoveOptions<Scalar> options{.response = {.restitution = Scalar(0.7), .friction = Scalar(0.1)}};
                    options.radius = r;
                    const Move<Scalar> move =
                        move_either(i / 30 % 2 != 0, mesh, at, velocity, Scalar(1) / 60, options, contacts);
                    ASSERT_LE(move.contacts, contacts.size());
                    ASSERT_NE(move.state, MoveState::invalid);
                    hits += ways_with_a_hit<Scalar>(triangles, at, r, move, contacts);
                    met += move.contacts > 0 ? 1 : 0;
                    undone += move.remainder != Vec3<Scalar>::Zero() ? 1 : 0;
                    at = move.position;
                    velocity = move.velocity;
                }
                EXPECT_EQ(hits, 0) << "seed " << seed;
                EXPECT_TRUE(is_clear(triangles, at, r)) << "seed " << seed;
                EXPECT_TRUE(mesh.contains(at));
                EXPECT_GE(met, k_steps / 20) << "seed " << seed;
                // In floats of 1/16 the ball is as large as a lattice cell.
                EXPECT_LE(undone, sizeof(Scalar) == 4 && offset > 1e5 ? k_steps / 2 : 2) << "seed " << seed;
            }
}

TYPED_TEST(BallWays, in_batches_are_single_calls) {
    using Scalar = TypeParam;
    const TriangleSoup<Scalar> soup = moved<Scalar>(bumpy_sphere(8), 3, V(1, 2, 3));
    const CollisionMesh<Scalar> mesh(soup.view());
    Random random(6);
    constexpr std::size_t k_count = 1500, k_room = 3;
    std::vector<Vec3<Scalar>> x, v;
    std::vector<Scalar> radii;
    for (std::size_t i = 0; i < k_count; ++i) {
        x.push_back(V(V(1, 2, 3) + 1.5 * random.in_cube()).cast<Scalar>());
        v.push_back(V(8 * random.in_cube()).cast<Scalar>());
        radii.push_back(i % 5 == 0 ? Scalar(0) : static_cast<Scalar>(random.between(0.01, 0.4)));
    }
    radii[17] = std::numeric_limits<Scalar>::quiet_NaN();
    radii[18] = -1;
    radii[19] = std::numeric_limits<Scalar>::infinity();
    const Reversed reversed;
    const Threads threads;
    for (const bool bounces : {false, true}) {
        std::vector<Move<Scalar>> single(k_count);
        std::vector<MoveContact<Scalar>> contacts(k_count * k_room);
        std::size_t met = 0;
        MoveOptions<Scalar> options{.query = {.sides = Sides::both},
                                    .response = {.restitution = Scalar(0.5), .friction = Scalar(0.1)}};
        for (std::size_t i = 0; i < k_count; ++i) {
            options.radius = radii[i];
            single[i] = move_either(bounces, mesh, x[i], v[i], Scalar(0.2), options,
                                    std::span(contacts).subspan(i * k_room, k_room));
            EXPECT_EQ(single[i].state == MoveState::invalid, i >= 17 && i <= 19);
            met += single[i].contacts > 0 ? 1U : 0U;
        }
        EXPECT_GT(met, k_count / 8);
        options.radius = 77;  // it is each one's that counts
        options.radii = radii;
        for (const Executor& executor : {Executor(), Executor(reversed), Executor(threads)}) {
            const std::uint64_t invalid = mesh.statistics().invalid_queries;
            std::vector<Move<Scalar>> all(k_count);
            std::vector<MoveContact<Scalar>> all_contacts(k_count * k_room);
            EXPECT_EQ(move_all_either(bounces, mesh, x, v, Scalar(0.2), all, options, executor, all_contacts), met);
            for (std::size_t i = 0; i < k_count; ++i) ASSERT_TRUE(same_bits(single[i], all[i])) << i;
            for (std::size_t i = 0; i < contacts.size(); ++i) ASSERT_TRUE(same_bits(contacts[i], all_contacts[i])) << i;
            EXPECT_EQ(mesh.statistics().invalid_queries, invalid + 3);
        }
        std::vector<Move<Scalar>> out(k_count);
        options.radii = std::span(radii).first(k_count - 1);
        EXPECT_THROW(moves_and_slide(mesh, x, v, Scalar(1), out, options), std::invalid_argument);
    }
}

}  // namespace
}  // namespace pierce::test
