// A particle that is moved to each returned point and stepped again never leaves a closed mesh: gravity and reflection
// in a bowl, 240 steps, near and far from the origin, no skin anywhere.
#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/inside_oracle.h>
#include <support/meshes.h>

namespace pierce::test {
namespace {

struct Outcome {
    int outside = 0;
    int bounces = 0;
    double travelled = 0;
};

// `inwards`: the faces look into the bowl and are hit from their front; else they look outwards and are hit from the
// back.
template <class Scalar>
Outcome run(double offset, bool inwards, std::size_t particles) {
    const double radius = 100;
    const Vec3<double> centre = offset * Vec3<double>(1, -1, 1);
    TriangleSoup<Scalar> soup = moved<Scalar>(bowl(12), radius, centre);
    const InsideOracle<Scalar> oracle(soup);
    if (inwards) soup = turned_inside_out(soup);
    const CollisionMesh<Scalar> mesh(soup.view());
    const QueryOptions options{.sides = inwards ? Sides::front : Sides::back};

    Outcome outcome;
    Random random(11);
    const double dt = 1.0 / 60;
    for (std::size_t i = 0; i < particles; ++i) {
        Vec3<Scalar> position = (centre + radius * 0.25 * random.in_cube()).template cast<Scalar>();
        EXPECT_FALSE(oracle.outside(position));
        Vec3<double> velocity = radius * std::exp(random.between(-1, 3.5)) * random.direction();
        for (int step = 0; step < 240; ++step) {
            velocity[2] -= 5 * radius * dt;
            double left = dt;
            for (int bounce = 0; bounce < 4; ++bounce) {
                const Vec3<Scalar> to = (position.template cast<double>() + velocity * left).template cast<Scalar>();
                const auto hit = mesh.sweep({position, to}, options);
                if (!hit) {
                    position = to;
                    break;
                }
                ++outcome.bounces;
                outcome.travelled += (hit->point - position).template cast<double>().norm();
                position = hit->point;
                left *= 1 - double(hit->fraction);
                const Vec3<double> n = hit->normal.template cast<double>();
                velocity = 0.95 * (velocity - 2 * velocity.dot(n) * n);
            }
        }
        outcome.outside += oracle.outside(position) ? 1 : 0;
    }
    std::cout << particles << " particles, offset " << offset << ": " << outcome.bounces << " bounces, "
              << outcome.outside << " outside\n";
    return outcome;
}

template <class Scalar>
class Particles : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Particles, Scalars);

TYPED_TEST(Particles, stay_in_a_closed_bowl_with_no_skin) {
    for (double offset : {0.0, 1e3, 1e6}) {
        for (bool inwards : {true, false}) {
            const Outcome outcome = run<TypeParam>(offset, inwards, 1000);
            EXPECT_EQ(outcome.outside, 0) << "offset " << offset;
            EXPECT_GT(outcome.bounces, 10'000);
            EXPECT_GT(outcome.travelled, 0);
        }
    }
}

}  // namespace
}  // namespace pierce::test
