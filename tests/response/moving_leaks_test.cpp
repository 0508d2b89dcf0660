// Particles in and around closed meshes that move: the short cut of each move clear by the exact decision of every
// triangle, and nobody gets through.
#include <deform/naive_step.h>
#include <deform/shapes.h>
#include <gtest/gtest.h>
#include <pierce/deforming_mesh.h>
#include <support/inside_oracle.h>

#include "ramps.h"

namespace pierce::test {
namespace {

template <class Scalar>
class MovingRooms : public ::testing::Test {};
template <class Scalar>
class MovingRoomsSoak : public ::testing::Test {};
TYPED_TEST_SUITE(MovingRooms, Both);
TYPED_TEST_SUITE(MovingRoomsSoak, Both);

struct Tally {
    int leaks = 0, contacts = 0, crushed = 0, on_surface = 0, wrong = 0, undone = 0, moves = 0, rested = 0, judged = 0;
};

/// `judged_every`: of how many moves one is judged by all triangles.
template <class Scalar>
Tally play(Shape shape, int n, int count, int steps, double pace, double offset, std::uint64_t seed, int judged_every) {
    const TriangleSoup<double> rest = star(n, [](const V&) { return 1.0; });
    TriangleSoup<Scalar> soup{shaped<Scalar>(rest, shape, 0, offset), rest.triangles, {}};
    DeformingMesh<Scalar> mesh(soup.view());
    Random random(seed);
    std::vector<Vec3<Scalar>> x, v;
    std::vector<bool> inside;
    while (static_cast<int>(x.size()) < count) {
        const Vec3<Scalar> at = (1.3 * random.in_cube() + V::Constant(offset)).template cast<Scalar>();
        const Location where = mesh.step().before().locate(at);
        if (where.place == Place::on_surface) continue;
        x.push_back(at);
        v.push_back(V(0.02 * random.in_cube()).template cast<Scalar>());
        inside.push_back(where.place == Place::inside);
    }
    Tally tally;
    for (int s = 1; s <= steps; ++s) {
        NaiveStep<Scalar> naive{soup, shaped<Scalar>(rest, shape, pace * s, offset)};
        mesh.begin_step(naive.after);
        const DeformationStep<Scalar> step = mesh.step();
        soup.positions = naive.after;
        const InsideOracle<Scalar> oracle(soup);
        for (std::size_t i = 0; i < x.size(); ++i) {
            MoveOptions<Scalar> options{.query = {.sides = inside[i] ? Sides::back : Sides::front}};
            if (i % 3 == 0) options.response.friction = 5;
            if (i % 3 == 1) options.response.restitution = Scalar(0.9);
            // Down inside, to the middle outside.
            const V off = x[i].template cast<double>() - V::Constant(offset);
            const V push = 0.004 * (inside[i] ? V(0, 0, -1) : V(-off.normalized()));
            Vec3<Scalar> velocity = v[i] + push.cast<Scalar>();
            if (velocity.norm() > Scalar(0.3)) velocity *= Scalar(0.3) / velocity.norm();
            const Move<Scalar> move = i % 3 == 2 ? move_and_slide(step, x[i], velocity, Scalar(1), options)
                                                 : move_and_bounce(step, x[i], velocity, Scalar(1), options);
            ++tally.moves;
            tally.contacts += move.contacts > 0 ? 1 : 0;
            tally.crushed += move.state == MoveState::crushed ? 1 : 0;
            tally.rested += move.state == MoveState::resting ? 1 : 0;
            tally.undone += move.remainder != Vec3<Scalar>::Zero() ? 1 : 0;
            if (tally.moves % judged_every == 0) {
                ++tally.judged;
                tally.wrong += naive.first({x[i], move.position}, options.query) ? 1 : 0;
            }
            x[i] = move.position;
            v[i] = move.velocity;
            const CGAL::Bounded_side side = oracle.side(x[i]);
            if (side == CGAL::ON_BOUNDARY)
                ++tally.on_surface;
            else if ((side == CGAL::ON_BOUNDED_SIDE) != inside[i])
                ++tally.leaks, inside[i] = !inside[i];
        }
    }
    return tally;
}

template <class Scalar>
void expect_no_leaks(int n, int count, int steps, int judged_every) {
    std::uint64_t seed = 0;
    for (const Shape shape : {beating, twisting, waving})
        for (const double pace : {0.02, 0.15})
            for (const double offset : {0.0, 1000.0}) {
                const Tally t = play<Scalar>(shape, n, count, steps, pace, offset, ++seed, judged_every);
                std::cout << "shape " << seed << ": " << t.moves << " moves, " << t.contacts << " with contacts, "
                          << t.rested << " riding, " << t.undone << " not done, " << t.judged << " judged, "
                          << t.on_surface << " on the surface\n";
                EXPECT_EQ(t.leaks, 0) << "shape " << seed;
                EXPECT_EQ(t.crushed, 0) << "shape " << seed;
                EXPECT_EQ(t.wrong, 0) << "shape " << seed;
                EXPECT_GT(t.judged, 0);
                EXPECT_GT(t.contacts, t.moves / 40) << "shape " << seed;
                EXPECT_GT(t.rested, t.moves / 100) << "shape " << seed;
                EXPECT_LT(t.undone, t.moves / 10) << "shape " << seed;
            }
}

TYPED_TEST(MovingRooms, let_nobody_through) { expect_no_leaks<TypeParam>(4, 40, 60, 10); }
TYPED_TEST(MovingRoomsSoak, let_nobody_through) { expect_no_leaks<TypeParam>(10, 1000, 1000, 5000); }

// A ball that is turned inside out through its middle leaves no place for what is in it, or on its way.
TYPED_TEST(MovingRooms, that_close_crush) {
    using Scalar = TypeParam;
    const TriangleSoup<double> rest = star(3, [](const V&) { return 1.0; });
    TriangleSoup<Scalar> soup{shaped<Scalar>(rest, beating, 0, 0), rest.triangles, {}};
    DeformingMesh<Scalar> mesh(soup.view());
    std::vector<Vec3<Scalar>> after = soup.positions;
    for (Vec3<Scalar>& p : after) p *= Scalar(-1);
    mesh.begin_step(after);
    const Move<Scalar> move =
        move_and_slide(mesh.step(), Vec3<Scalar>(Scalar(0.2), Scalar(0.1), Scalar(0.3)),
                       Vec3<Scalar>(Scalar(0.1), 0, 0), Scalar(1), {.query = {.sides = Sides::back}});
    EXPECT_EQ(move.state, MoveState::crushed);
    EXPECT_TRUE(move.position.allFinite());
}

}  // namespace
}  // namespace pierce::test
