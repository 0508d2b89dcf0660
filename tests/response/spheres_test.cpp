// Balls that slide and bounce: rest to the last bit, no edges where faces go on in one plane, round edges and into
// corners.
#include <gtest/gtest.h>

#include "balls.h"

namespace pierce::test {
namespace {

template <class Scalar>
class Balls : public ::testing::Test {};
TYPED_TEST_SUITE(Balls, Both);

TYPED_TEST(Balls, at_rest_do_not_move) {
    using Scalar = TypeParam;
    Random random(4);
    for (const double offset : {0.0, 1e3, 1e6})
        for (int i = 0; i < 12; ++i) {
            const V up = i % 4 == 0 ? V(0, 0, 1) : V(V(0.3 * random.in_cube()) + V(0, 0, 1)).normalized();
            const V middle = offset * V(1, -1, 1) + (i % 8 == 0 ? 0 : 1) * random.in_cube();
            const V u = up.unitOrthogonal();
            TriangleSoup<Scalar> soup;
            add_floor<Scalar>(soup, middle - 10 * u - 10 * up.cross(u), u, up.cross(u), 20, 1, 0.3);
            const CollisionMesh<Scalar> mesh(soup.view());
            MoveOptions<Scalar> options{.response = {.friction = 1}};
            options.radius = static_cast<Scalar>(sizeof(Scalar) == 4 && offset > 1e5 ? 2 : random.between(0.05, 2));
            Move<Scalar> move{};
            move.position =
                V(middle + (1 + double(options.radius)) * up + V(random.unit(), random.unit(), 0)).cast<Scalar>();
            move.velocity.setZero();
            const Vec3<Scalar> push(0, 0, Scalar(-9.81 / 60));
            for (int step = 0; step < 240 && move.state != MoveState::resting; ++step)
                move =
                    move_and_bounce(mesh, move.position, Vec3<Scalar>(move.velocity + push), Scalar(1) / 60, options);
            ASSERT_EQ(move.state, MoveState::resting) << offset << ' ' << i;
            const Vec3<Scalar> place = move.position;
            const double height = (place.template cast<double>() - middle).dot(up) - double(options.radius);
            EXPECT_LE(std::abs(height), 64 * k_epsilon<Scalar> * (std::abs(offset) + 20)) << offset << ' ' << i;
            EXPECT_TRUE(is_clear(corners_of(soup), place, options.radius));
            for (int step = 0; step < 300; ++step) {
                move =
                    move_and_bounce(mesh, move.position, Vec3<Scalar>(move.velocity + push), Scalar(1) / 60, options);
                ASSERT_TRUE(same_bits(move.position, place)) << step;
                ASSERT_EQ(move.state, MoveState::resting);
                ASSERT_EQ(move.casts, 1);
                ASSERT_EQ(move.travel, Vec3<Scalar>::Zero());
            }
        }
}

// As points do: the way down an incline of many triangles, within 1 % of the formula.
TYPED_TEST(Balls, keep_their_way_down_an_incline) {
    using Scalar = TypeParam;
    double least = 2, most = 0;
    for (const double offset : sizeof(Scalar) == 4 ? std::vector{0.0, 1e3} : std::vector{0.0, 1e3, 1e6})
        for (const double degrees : {1.0, 10.0, 45.0, 60.0})
            for (const double radius : {0.05, 1.0})
                for (const int rate : {60, 240}) {
                    const double a = radians(degrees);
                    const Eigen::AngleAxisd about(radians(33), V::UnitY());
                    const V down = about * V(std::cos(a), -std::sin(a), 0);
                    const V across = about * V(0, 0, 1);
                    const V up = across.cross(down);
                    const V middle = offset * V(1, 1, 1);
                    TriangleSoup<Scalar> soup;
                    add_floor<Scalar>(soup, middle - 20 * down - 60 * across, across, down, 60, 2, 0.3);
                    const CollisionMesh<Scalar> mesh(soup.view());
                    MoveOptions<Scalar> options;
                    options.radius = static_cast<Scalar>(radius);
                    Move<Scalar> start = move_and_slide(mesh, V(middle + (radius + 0.1) * up).template cast<Scalar>(),
                                                        V(-0.5 * up).template cast<Scalar>(), Scalar(1), options);
                    const int steps = 3 * rate;
                    const Move<Scalar> end = fall<Scalar>(start.position, V(0, -9.81, 0), steps, 1.0 / rate,
                                                          [&](const auto& x, const auto& v, Scalar dt) {
                                                              const Move<Scalar> move =
                                                                  move_and_slide(mesh, x, v, dt, options);
                                                              EXPECT_EQ(move.remainder, Vec3<Scalar>::Zero());
                                                              return move;
                                                          });
                    const V way = (end.position - start.position).template cast<double>();
                    const double kept = way.dot(down) / (9.81 * std::sin(a) * steps * (steps + 1) / 2 / rate / rate);
                    EXPECT_NEAR(kept, 1, 0.01) << "offset " << offset << ", " << degrees << " degrees, radius "
                                               << radius << ", " << rate << " steps a second";
                    EXPECT_LE(std::abs(way.dot(across)), 0.01 * way.norm());
                    least = std::min(least, kept);
                    most = std::max(most, kept);
                }
    std::cout << "kept: " << least << " to " << most << '\n';
}

// Edges inside of a flat floor are no obstacle, whatever the direction.
TYPED_TEST(Balls, are_not_caught_by_edges_of_a_flat_floor) {
    using Scalar = TypeParam;
    Random random(7);
    for (const double offset : {0.0, 1e3})
        for (int i = 0; i < 8; ++i) {
            const double height = i % 3 == 0 ? 0 : 1 + random.unit();
            TriangleSoup<Scalar> soup;
            add_floor<Scalar>(soup, V(offset - 10, offset - 10, offset + height), V::UnitX(), V::UnitY(), 40, 0.5, 0.4);
            const CollisionMesh<Scalar> mesh(soup.view());
            const double angle = i == 0 ? 0 : random.between(0, 2 * std::numbers::pi);
            MoveOptions<Scalar> options;
            options.radius = static_cast<Scalar>(i % 2 == 0 ? 0.1 : 1.3);
            Vec3<Scalar> velocity = V(4 * std::cos(angle), 4 * std::sin(angle), 0).cast<Scalar>();
            const Vec3<Scalar> along = velocity;
            Vec3<Scalar> at = V(offset, offset, offset + height + double(options.radius) + 0.001).cast<Scalar>();
            const Vec3<Scalar> start = at;
            for (int step = 0; step < 120; ++step) {
                const Move<Scalar> move = move_and_slide(
                    mesh, at, Vec3<Scalar>(velocity - Vec3<Scalar>(0, 0, Scalar(9.81 / 60))), Scalar(1) / 60, options);
                ASSERT_LE(move.casts, 4);
                at = move.position;
                velocity = move.velocity;
            }
            EXPECT_EQ(velocity.template head<2>(), along.template head<2>()) << offset << ", direction " << angle;
            // Where its center is above an edge the normal is that of a difference of points.
            EXPECT_LE(std::abs(velocity[2]), k_epsilon<Scalar>);
            const double step = std::ldexp(k_epsilon<Scalar>, std::ilogb(std::max(offset + 10, 1.0)));
            EXPECT_LE(((at - start) - 2 * along).template cast<double>().head(2).norm(), 120 * step);
        }
}

// Over a kerb that is lower than its center, up along it and down behind it; a higher one stops it.
TYPED_TEST(Balls, go_over_a_kerb_or_are_stopped_by_it) {
    using Scalar = TypeParam;
    for (const double offset : {0.0, 1e3})
        for (const double kerb : {0.05, 0.2, 1.2}) {
            const V middle = offset * V(1, 1, 1);
            TriangleSoup<Scalar> soup;
            add_floor<Scalar>(soup, middle + V(-10, -5, 0), V::UnitX(), V::UnitY(), 10, 1, 0.3);
            add_floor<Scalar>(soup, middle + V(0, -5, 0), V::UnitY(), V::UnitZ() * kerb / 10, 10, 1);
            add_floor<Scalar>(soup, middle + V(0, -5, kerb), V::UnitX(), V::UnitY(), 10, 1, 0.3);
            const CollisionMesh<Scalar> mesh(soup.view());
            const std::vector<Corners> triangles = corners_of(soup);
            MoveOptions<Scalar> options;
            options.radius = Scalar(0.5);
            Move<Scalar> move{};
            move.position = V(middle + V(-3, 0.1, 0.51)).template cast<Scalar>();
            move.velocity = Vec3<Scalar>(4, Scalar(0.3), 0);
            std::array<MoveContact<Scalar>, 32> contacts;
            int hits = 0;
            for (int step = 0; step < 120; ++step) {
                const Vec3<Scalar> from = move.position;
                move = move_and_slide(mesh, from, Vec3<Scalar>(move.velocity - Vec3<Scalar>(0, 0, Scalar(9.81 / 60))),
                                      Scalar(1) / 60, options, contacts);
                hits += ways_with_a_hit<Scalar>(triangles, from, options.radius, move, contacts);
                // Along the kerb nothing stops it.
                EXPECT_NEAR(double(move.velocity[1]), double(Scalar(0.3)), 1e-3);
            }
            EXPECT_EQ(hits, 0);
            const V end = move.position.template cast<double>() - middle;
            if (kerb < 0.5) {
                EXPECT_GT(end[0], 0.5) << kerb;
                EXPECT_GT(end[2], kerb + 0.49) << kerb;
            } else {
                EXPECT_NEAR(end[0], -0.5, 0.01) << kerb;
                EXPECT_NEAR(double(move.velocity[0]), 0, 1e-6);
            }
        }
}

// In a corner of three planes it is wedged, in a groove it rests, for good.
TYPED_TEST(Balls, in_corners_and_grooves_stay) {
    using Scalar = TypeParam;
    Random random(9);
    for (const double offset : {0.0, 1e3})
        for (int i = 0; i < 40; ++i) {
            const bool groove = i % 2 == 0;
            const V middle = offset * V(1, -1, 1) + random.in_cube();
            const Eigen::AngleAxisd turn(i % 4 < 2 ? 0 : random.between(0, 3), random.direction());
            const V x = turn * V::UnitX(), y = turn * V::UnitY(), z = turn * V::UnitZ();
            TriangleSoup<Scalar> soup;
            add_floor<Scalar>(soup, middle - 3 * y, y, z, 6, 2);
            add_floor<Scalar>(soup, middle - 3 * y, x, y, 6, 2);
            if (!groove) add_floor<Scalar>(soup, middle - 3 * x - 3 * z, z, x, 6, 2);
            const CollisionMesh<Scalar> mesh(soup.view());
            // (Far away in float the groove falls by roundings.)
            MoveOptions<Scalar> options{.response = {.friction = Scalar(groove ? 0.01 : 0)}};
            options.radius = static_cast<Scalar>(random.between(0.2, 1));
            const double r = static_cast<double>(options.radius);
            const V push = -(random.unit() + 0.3) * x - (random.unit() + 0.3) * z - (groove ? 0 : 0.4) * y;
            Move<Scalar> move{}, last{};
            move.position = V(middle + 1.5 * (x + y + z)).template cast<Scalar>();
            int still = 0;
            for (int step = 0; step < 240; ++step) {
                last = move;
                move =
                    move_and_bounce(mesh, move.position, V(5 * push).template cast<Scalar>(), Scalar(1) / 60, options);
                still = same_bits(move.position, last.position) ? still + 1 : 0;
            }
            // Three triangles may hold it in a groove, too: two that are in one plane but for rounding.
            EXPECT_TRUE(move.state == MoveState::wedged || (groove && move.state == MoveState::resting)) << i;
            EXPECT_EQ(move.velocity, (Vec3<Scalar>::Zero())) << i;
            EXPECT_GE(still, 100) << i;
            const V off = move.position.template cast<double>() - middle;
            const double near = 256 * k_epsilon<Scalar> * (std::abs(offset) + 10);
            EXPECT_NEAR(off.dot(x), r, near);
            EXPECT_NEAR(off.dot(z), r, near);
            EXPECT_TRUE(is_clear(corners_of(soup), move.position, options.radius));
        }
}

// One that overlaps may go on along what it overlaps, and no deeper.
TYPED_TEST(Balls, that_overlap_are_not_stuck) {
    using Scalar = TypeParam;
    Random random(5);
    MoveOptions<Scalar> options;
    options.radius = 1;
    for (int i = 0; i < 20; ++i) {
        const V up = i == 0 ? V(0, 0, 1) : random.direction();
        const V u = up.unitOrthogonal();
        TriangleSoup<Scalar> soup;  // of two triangles: those beside it would be met as well
        add_floor<Scalar>(soup, -10 * u - 5 * up.cross(u), u, up.cross(u), 1, 20);
        const CollisionMesh<Scalar> mesh(soup.view());
        const Vec3<Scalar> from = V(0.2 * u + 0.1 * up.cross(u) + 0.75 * up).template cast<Scalar>();
        const auto gone = [&](const V& velocity, MoveState state) {
            const Move<Scalar> move = move_and_slide(mesh, from, velocity.cast<Scalar>(), Scalar(1), options);
            EXPECT_EQ(move.state, state) << i;
            return V(move.travel.template cast<double>());
        };
        EXPECT_LE((gone(2 * u - up, MoveState::slid) - 2 * u).norm(), 1e-5) << i;
        EXPECT_LE((gone(3 * up, MoveState::free) - 3 * up).norm(), 1e-5) << i;
        EXPECT_TRUE(i > 0 || gone(-3 * up, MoveState::resting) == V::Zero());
    }
}

// Off the end of a platform, and against a wall that leans over: as points do, it slides down that.
TYPED_TEST(Balls, are_not_held_by_what_they_left_behind) {
    using Scalar = TypeParam;
    for (const double offset : {0.0, 1e3}) {
        const V middle = offset * V(1, 1, 1);
        TriangleSoup<Scalar> soup;
        add_floor<Scalar>(soup, middle + V(-4, -2, 0), V::UnitX(), V::UnitY(), 4, 1);
        add_floor<Scalar>(soup, middle + V(-1, -4, 3), V::UnitY(), V(1, 0, -1) * std::sqrt(0.5), 8, 1);
        const CollisionMesh<Scalar> mesh(soup.view());
        MoveOptions<Scalar> options;
        options.radius = Scalar(0.2);
        const Vec3<Scalar> from = (middle + V(-1, 0.3, 0.201)).template cast<Scalar>();
        const Move<Scalar> move = move_and_slide(mesh, from, Vec3<Scalar>(4, 0, Scalar(-0.1)), Scalar(1), options);
        const double unit = k_epsilon<Scalar> * (offset + 8);
        EXPECT_EQ(move.contacts, 2U);
        // The wall is x + z = 2; half of the speed is left along it.
        EXPECT_NEAR(double(move.velocity[0]), 2, 64 * unit);
        EXPECT_NEAR(double(move.velocity[2]), -2, 64 * unit);
        const double rest = 1 - (2 - 0.2 - 0.2 * std::sqrt(2.0) + 1) / 4;
        EXPECT_NEAR(double(move.position[2]) - offset, 0.2 - 2 * rest, 0.01 + 64 * unit);
    }
}

TYPED_TEST(Balls, bounce_as_points_do) {
    using Scalar = TypeParam;
    const CollisionMesh<Scalar> mesh = floor_at<Scalar>(V(0, 0, 0), V(0, 0, 1));
    MoveOptions<Scalar> options{.response = {.restitution = Scalar(0.5)}};
    options.radius = Scalar(0.25);
    std::array<MoveContact<Scalar>, 4> contacts;
    const Move<Scalar> move = move_and_bounce(mesh, Vec3<Scalar>(Scalar(0.2), Scalar(0.1), Scalar(1.25)),
                                              Vec3<Scalar>(1, 0, -4), Scalar(1), options, contacts);
    ASSERT_EQ(move.contacts, 1U);
    EXPECT_NEAR(double(contacts[0].point[2]), 0.25, 1e-5);
    EXPECT_NEAR(double(contacts[0].seconds), 0.75, 1e-5);
    EXPECT_NEAR(double(contacts[0].speed), 4, 1e-5);
    EXPECT_NEAR(double(move.position[2]), 0.25 + 0.75 * 2, 1e-5);
    EXPECT_NEAR(double(move.position[0]), 1.2, 1e-5);
    EXPECT_EQ(move.velocity, (Vec3<Scalar>(1, 0, 2)));
}

}  // namespace
}  // namespace pierce::test
