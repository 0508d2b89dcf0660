// Particles that fly by rays inside of closed meshes, from verified point to verified point: a ray without an end that
// hits nothing has found a leak. Many are aimed at vertices and along edges, and start where faces meet.
#include <gtest/gtest.h>

#include <pierce/pierce.h>
#include <support/meshes.h>
#include <support/random.h>
#include <support/real_meshes.h>

namespace pierce::test {
namespace {

template <class Scalar>
class Flights {
  public:
    Flights(const TriangleSoup<Scalar>& soup, std::uint64_t seed) : soup_(soup), mesh_(soup.view()), random_(seed) {}

    /// Steps of one particle after the other, each of which starts somewhere inside. `outside(point)` is asked now and
    /// then.
    template <class Outside>
    void fly(std::size_t particles, std::size_t steps, Outside&& outside) {
        for (std::size_t i = 0; i < particles; ++i) {
            Vec3<Scalar> at = start();
            for (std::size_t step = 0; step < steps; ++step) {
                const Ray<Scalar> ray{at, direction(at)};
                const auto hit = mesh_.first_hit(ray, {.sides = Sides::back});
                ASSERT_TRUE(hit) << "particle " << i << " left in step " << step << ", from " << at.transpose()
                                 << " along " << ray.direction.transpose();
                at = hit->point;
                if (step % 16 == 0) {
                    ASSERT_FALSE(outside(at)) << "particle " << i << " in step " << step;
                }
            }
        }
    }
    /// For surfaces that no point comes to lie on.
    void fly(std::size_t particles, std::size_t steps) {
        fly(particles, steps, [this](const Vec3<Scalar>& at) { return !mesh_.contains(at); });
    }

  private:
    Vec3<Scalar> vertex() { return soup_.positions[random_.below(soup_.positions.size())]; }
    Vec3<Scalar> start() {
        for (;;) {
            const Vec3<Scalar> p = (vertex() + vertex()) / 2;
            if (mesh_.contains(p)) return p;
        }
    }
    Vec3<Scalar> direction(const Vec3<Scalar>& at) {
        const double kind = random_.unit();
        Vec3<Scalar> d = random_.direction().template cast<Scalar>();
        if (kind < 0.2) d = vertex() - at;
        if (kind > 0.8) {
            const IndexTriple& t = soup_.triangles[random_.below(soup_.triangles.size())];
            d = (soup_.positions[t[0]] + soup_.positions[t[1]]) / 2 - at;
        }
        return d == Vec3<Scalar>(0, 0, 0) ? Vec3<Scalar>(0, 0, 1) : d;
    }

    const TriangleSoup<Scalar>& soup_;
    CollisionMesh<Scalar> mesh_;
    Random random_;
};

template <class Scalar>
class RayFlights : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(RayFlights, Scalars, );

TYPED_TEST(RayFlights, stay_inside) {
    for (const double offset : {0.0, 1000.0}) {
        const Vec3<double> shift(offset, -offset, offset);
        Flights<TypeParam>(moved<TypeParam>(bumpy_sphere(20), 1, shift), 7).fly(50, 1000);
        if (this->HasFatalFailure()) return;
        // Cubes that meet in edges and vertices: points come to lie on faces beside the one that was hit.
        const Polycube poly(4, 0.6, 4, 3);
        Flights<TypeParam>(moved<TypeParam>(poly.soup, 1, shift), 8).fly(50, 1000, [&](const Vec3<TypeParam>& at) {
            return poly.strictly_outside(at.template cast<double>() - shift);
        });
        if (this->HasFatalFailure()) return;
    }
}

TYPED_TEST(RayFlights, stay_inside_of_a_real_mesh) {
    const TriangleSoup<TypeParam> soup = real_mesh<TypeParam>("elephant");
    Flights<TypeParam>(soup, 9).fly(100, 1000);
}

template <class Scalar>
class RayFlightsSoak : public ::testing::Test {};
TYPED_TEST_SUITE(RayFlightsSoak, Scalars, );

// 10^8 steps in all.
TYPED_TEST(RayFlightsSoak, stay_inside_of_a_real_mesh_for_long) {
    const TriangleSoup<TypeParam> soup = real_mesh<TypeParam>("elephant");
    Flights<TypeParam>(soup, 10).fly(5000, 10000);
}

}  // namespace
}  // namespace pierce::test
