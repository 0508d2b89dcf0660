// Slides keep their way: down inclines at all offsets and rates, across the edges of a flat floor, along a valley, over
// a ridge; corners stop them. The judge is the formula for the same steps, g sin(a) dt^2 n (n + 1) / 2.
#include <gtest/gtest.h>

#include "ramps.h"

namespace pierce::test {
namespace {

constexpr double k_gravity = 9.81;
constexpr double k_seconds = 4;

template <class Scalar>
struct Scalars;
template <>
struct Scalars<float> {
    static constexpr std::array offsets = {0.0, 1e3};
};
template <>
struct Scalars<double> {
    static constexpr std::array offsets = {0.0, 1e3, 1e6};
};

template <class Scalar>
class Slides : public ::testing::Test {};
TYPED_TEST_SUITE(Slides, Both);

double distance_of(double acceleration, int steps, double seconds) {
    return acceleration * seconds * seconds * steps * (steps + 1) / 2;
}

template <class Scalar>
double kept_on_incline(double offset, double degrees, double turn, int rate, bool rounded_mesh) {
    const double a = radians(degrees);
    // Downhill is along x turned about the upright axis.
    const Eigen::AngleAxisd about(radians(turn), V::UnitY());
    const V down = about * V(std::cos(a), -std::sin(a), 0);
    const V across = about * V(0, 0, 1);
    const V middle = offset * V(1, 1, 1);
    TriangleSoup<Scalar> soup;
    add_floor<Scalar>(soup, middle - 20 * down - 100 * across, across, down, 40, 5, rounded_mesh ? 0.3 : 0);
    const CollisionMesh<Scalar> mesh(soup.view());
    const V above = middle + V(0, 0.5, 0);
    const auto landed = mesh.sweep({above.cast<Scalar>(), V(above - V(0, 2, 0)).cast<Scalar>()});
    if (!landed) return 0;
    const Vec3<Scalar> start = landed->point;
    const int steps = static_cast<int>(k_seconds * rate);
    int contacts = 0;
    const Move<Scalar> end =
        fall<Scalar>(start, V(0, -k_gravity, 0), steps, 1.0 / rate, [&](const auto& x, const auto& v, Scalar dt) {
            const Move<Scalar> move = move_and_slide(mesh, x, v, dt);
            contacts += move.contacts > 0 ? 1 : 0;
            EXPECT_EQ(move.remainder, Vec3<Scalar>::Zero());
            return move;
        });
    EXPECT_GT(contacts, sizeof(Scalar) == 4 ? steps / 5 : steps * 9 / 10);  // floats: at times it falls within a grain
    const V way = (end.position - start).template cast<double>();
    EXPECT_LE(std::abs(way.dot(across)), 0.01 * way.norm());
    return way.dot(down) / distance_of(k_gravity * std::sin(a), steps, 1.0 / rate);
}

TYPED_TEST(Slides, down_an_incline_keep_their_way) {
    double least = 2;
    double most = 0;
    for (const double offset : Scalars<TypeParam>::offsets)
        for (const double degrees : {1.0, 5.0, 10.0, 30.0, 45.0, 60.0})
            for (const double turn : {0.0, 33.0})
                for (const int rate : {60, 240}) {
                    const double kept = kept_on_incline<TypeParam>(offset, degrees, turn, rate, turn > 0);
                    EXPECT_NEAR(kept, 1, 0.01) << "offset " << offset << ", " << degrees << " degrees, turned by "
                                               << turn << ", " << rate << " steps a second";
                    least = std::min(least, kept);
                    most = std::max(most, kept);
                }
    std::cout << "kept: " << least << " to " << most << '\n';
}

// Edges inside of a flat floor are no obstacle, whatever the direction: the velocity along the floor stays as it is.
TYPED_TEST(Slides, across_edges_of_a_flat_floor_are_not_caught) {
    using Scalar = TypeParam;
    Random random(7);
    for (const double offset : Scalars<Scalar>::offsets)
        for (int i = 0; i < 12; ++i) {
            const double height = i % 3 == 0 ? 0 : 1 + random.unit();
            TriangleSoup<Scalar> soup;
            add_floor<Scalar>(soup, V(offset - 10, offset - 10, offset + height), V::UnitX(), V::UnitY(), 40, 0.5, 0.4);
            const CollisionMesh<Scalar> mesh(soup.view());
            const double angle = i == 0 ? 0 : random.between(0, 2 * std::numbers::pi);
            Vec3<Scalar> velocity = V(4 * std::cos(angle), 4 * std::sin(angle), 0).cast<Scalar>();
            const Vec3<Scalar> along = velocity;
            Vec3<Scalar> at = V(offset, offset, offset + height + 0.001).cast<Scalar>();
            const Vec3<Scalar> start = at;
            for (int step = 0; step < 120; ++step) {
                const Move<Scalar> move = move_and_slide(
                    mesh, at, Vec3<Scalar>(velocity - Vec3<Scalar>(0, 0, Scalar(k_gravity / 60))), Scalar(1) / 60);
                ASSERT_LE(move.casts, 4);
                at = move.position;
                velocity = move.velocity;
            }
            EXPECT_EQ(velocity, along) << "offset " << offset << ", direction " << angle;
            const double step = std::ldexp(static_cast<double>(std::numeric_limits<Scalar>::epsilon()),
                                           std::ilogb(std::max(offset + 10, 1.0)));
            EXPECT_LE(((at - start) - 2 * along).template cast<double>().head(2).norm(), 120 * step);
        }
}

// A valley of two planes whose crease falls by `fall` degrees, its sides rising by `rise` on either hand.
template <class Scalar>
double kept_in_valley(double offset, double fall_by, double rise, int rate, bool& steady) {
    const double a = radians(fall_by);
    const double b = radians(rise);
    const V down(std::cos(a), 0, -std::sin(a));
    const V up(std::sin(a), 0, std::cos(a));
    const V left = std::cos(b) * V::UnitY() + std::sin(b) * up;
    const V right = -std::cos(b) * V::UnitY() + std::sin(b) * up;
    const V middle = offset * V(1, 1, 1);
    TriangleSoup<Scalar> soup;
    add_floor<Scalar>(soup, middle - 20 * down, down, left, 30, 5);
    add_floor<Scalar>(soup, middle - 20 * down, right, down, 30, 5);
    const CollisionMesh<Scalar> mesh(soup.view());
    // Dropped onto the crease (beside it, it would swing from side to side, as it should).
    const V above = middle + 0.3 * V::UnitZ();
    Move<Scalar> move{};
    move.position = above.cast<Scalar>();
    move.velocity.setZero();
    for (int i = 0; i < 4 * rate; ++i)
        move = move_and_slide(mesh, move.position, V(0, 0, -1).cast<Scalar>(), Scalar(1) / static_cast<Scalar>(rate));
    const Vec3<Scalar> start = move.position;
    const int steps = 2 * rate;
    steady = true;
    const Move<Scalar> end =
        fall<Scalar>(start, V(0, 0, -k_gravity), steps, 1.0 / rate, [&](const auto& x, const auto& v, Scalar dt) {
            const Move<Scalar> next = move_and_slide(mesh, x, v, dt);
            const double grain = 64 * static_cast<double>(std::numeric_limits<Scalar>::epsilon()) * (offset + 150);
            const V off = next.position.template cast<double>() - middle;
            steady = steady && (off - off.dot(down) * down).norm() < grain / std::sin(b);
            return next;
        });
    return (end.position - start).template cast<double>().dot(down) /
           distance_of(k_gravity * std::sin(a), steps, 1.0 / rate);
}

TYPED_TEST(Slides, into_a_valley_go_along_its_crease) {
    for (const double offset : Scalars<TypeParam>::offsets)
        for (const double fall_by : {5.0, 30.0})
            for (const double rise : {10.0, 30.0, 45.0, 60.0, 80.0})
                for (const int rate : {60, 240}) {
                    bool steady = false;
                    const double kept = kept_in_valley<TypeParam>(offset, fall_by, rise, rate, steady);
                    EXPECT_NEAR(kept, 1, 0.01) << "offset " << offset << ", falls by " << fall_by << ", rises by "
                                               << rise << ", " << rate << " steps a second";
                    EXPECT_TRUE(steady) << "it leaves the crease: offset " << offset << ", " << fall_by << ", " << rise
                                        << ", " << rate;
                }
}

// A corner of three planes, in any position: it is stopped, for good, to the last bit.
TYPED_TEST(Slides, into_a_corner_are_wedged) {
    using Scalar = TypeParam;
    Random random(9);
    for (const double offset : Scalars<Scalar>::offsets)
        for (int i = 0; i < 200; ++i) {
            const V middle = offset * V(1, -1, 1) + random.in_cube();
            const Eigen::AngleAxisd turn(i % 4 == 0 ? 0 : random.between(0, 3), random.direction());
            const V x = turn * V::UnitX();
            const V y = turn * V(random.between(-0.5, 0.5), 1, 0).normalized();
            const V z = turn * V(random.between(-0.5, 0.5), random.between(-0.5, 0.5), 1).normalized();
            TriangleSoup<Scalar> soup;
            for (const auto& [u, w] : {std::pair{x, y}, {y, z}, {z, x}}) add_floor<Scalar>(soup, middle, u, w, 3, 2);
            const CollisionMesh<Scalar> mesh(soup.view());
            const V inwards = -(random.unit() + 0.1) * x - (random.unit() + 0.1) * y - (random.unit() + 0.1) * z;
            // Against all three planes, so that nothing slides out of the corner.
            const V nx = y.cross(z), ny = z.cross(x), nz = x.cross(y);
            const V push = -(nx + ny + nz) / (nx + ny + nz).norm() * 5 + 0.1 * inwards;
            if (push.dot(nx) > 0 || push.dot(ny) > 0 || push.dot(nz) > 0) continue;
            Move<Scalar> move{};
            move.position = V(middle + 1.5 * (x + y + z)).cast<Scalar>();
            Move<Scalar> last{};
            int still = 0;
            for (int step = 0; step < 400; ++step) {
                last = move;
                move = move_and_slide(mesh, move.position, push.cast<Scalar>(), Scalar(1) / 60);
                still = same_bits(move.position, last.position) ? still + 1 : 0;
            }
            const double grain =
                16 * static_cast<double>(std::numeric_limits<Scalar>::epsilon()) * (std::abs(offset) + 10);
            ASSERT_EQ(move.state, MoveState::wedged) << i << ' ' << push.transpose();
            ASSERT_EQ(move.velocity, Vec3<Scalar>::Zero()) << i;
            ASSERT_GE(still, 100) << i;
            ASSERT_LE((move.position.template cast<double>() - middle).norm(), 8 * grain) << i;
        }
}

// Up a roof, over its ridge and down: the part of the velocity along the ridge is never touched.
TYPED_TEST(Slides, over_a_ridge_are_not_turned_aside) {
    using Scalar = TypeParam;
    for (const double offset : Scalars<Scalar>::offsets)
        for (const double slope : {2.0, 10.0, 30.0}) {
            const double a = radians(slope);
            const V up(std::cos(a), 0, std::sin(a));
            const V down(std::cos(a), 0, -std::sin(a));
            const V middle = offset * V(1, 1, 1);
            TriangleSoup<Scalar> soup;
            add_floor<Scalar>(soup, middle - 50 * V::UnitY() - 100 * up, up, V::UnitY(), 100, 1);
            add_floor<Scalar>(soup, middle - 50 * V::UnitY(), down, V::UnitY(), 100, 1);
            const CollisionMesh<Scalar> mesh(soup.view());
            Move<Scalar> move{};
            move.position = V(middle - 2 * up + 0.001 * V::UnitZ()).cast<Scalar>();
            move.velocity = V(14 * up + 3 * V::UnitY()).cast<Scalar>();
            const auto along = static_cast<double>(move.velocity[1]);
            int touched = 0;
            for (int step = 0; step < 90; ++step) {
                move = move_and_slide(mesh, move.position,
                                      Vec3<Scalar>(move.velocity - Vec3<Scalar>(0, 0, Scalar(k_gravity / 60))),
                                      Scalar(1) / 60);
                touched += move.contacts > 0 ? 1 : 0;
                // The sides of the roof are flat in the mesh but for rounding.
                EXPECT_NEAR(static_cast<double>(move.velocity[1]), along,
                            90 * 4 * static_cast<double>(std::numeric_limits<Scalar>::epsilon()) * (offset + 50));
            }
            EXPECT_GT(move.position[0] - Scalar(offset), Scalar(5));
            EXPECT_GT(touched, 5);
        }
}

// Off the end of a platform, and against a wall that leans over: it slides down that, and the platform holds it no
// more.
TYPED_TEST(Slides, are_not_held_by_what_they_left_behind) {
    using Scalar = TypeParam;
    for (const double offset : Scalars<Scalar>::offsets) {
        const V middle = offset * V(1, 1, 1);
        TriangleSoup<Scalar> soup;
        add_floor<Scalar>(soup, middle + V(-4, -2, 0), V::UnitX(), V::UnitY(), 4, 1);
        // Its normal is (-1, 0, -1) / sqrt 2.
        add_floor<Scalar>(soup, middle + V(-1, -4, 3), V::UnitY(), V(1, 0, -1) * std::sqrt(0.5), 8, 1);
        const CollisionMesh<Scalar> mesh(soup.view());
        const Vec3<Scalar> from = (middle + V(-1, 0.3, 0.001)).template cast<Scalar>();
        const Move<Scalar> move = move_and_slide(mesh, from, Vec3<Scalar>(4, 0, Scalar(-0.1)), Scalar(1));
        const double unit = k_epsilon<Scalar> * (offset + 8);
        EXPECT_EQ(move.contacts, 2U);
        // 3 of its 4 to the wall; half of the speed is left along it.
        EXPECT_NEAR(double(move.velocity[0]), 2, 64 * unit);
        EXPECT_NEAR(double(move.velocity[2]), -2, 64 * unit);
        EXPECT_NEAR(double(move.position[2]) - offset, -0.5, 0.01 + 64 * unit);
    }
}

}  // namespace
}  // namespace pierce::test
