// A ball that is pushed around inside a closed surface never gets out, and never overlaps it.
#include <gtest/gtest.h>

#include <pierce/collision_mesh.h>
#include <support/meshes.h>
#include <support/sphere_oracle.h>

#include <point.h>

namespace pierce::test {
namespace {

using detail::to_point;

template <class Scalar>
void push_around(const TriangleSoup<double>& unit, double offset, double radius, int steps, std::uint64_t seed) {
    const TriangleSoup<Scalar> soup = moved<Scalar>(unit, 1, {offset, offset / 2, -offset});
    const CollisionMesh<Scalar> mesh(soup.view());
    const auto r = static_cast<Scalar>(radius);
    Random random(seed);
    // A start that is clear, by the judge.
    Vec3<Scalar> at;
    const auto is_clear = [&](const Vec3<Scalar>& p) {
        const SphereOracle oracle({to_point(p), to_point(p)}, static_cast<double>(r));
        for (const IndexTriple& t : soup.triangles)
            if (oracle.gap({to_point(soup.positions[t[0]]), to_point(soup.positions[t[1]]),
                            to_point(soup.positions[t[2]])}) < 0)
                return false;
        return true;
    };
    int tries = 0;
    do {
        const Vec3<double> p = 3 * random.in_cube() + Vec3<double>(offset, offset / 2, -offset);
        at = p.cast<Scalar>();
        ASSERT_LT(++tries, 2000);
    } while (!mesh.contains(at) || !is_clear(at));
    int hits = 0;
    int stuck = 0;
    for (int i = 0; i < steps; ++i) {
        // Falls, is thrown, slides along what it hits.
        const double length = random.chance(0.1) ? 50 : random.chance(0.5) ? 0.01 : 0.3;
        Vec3<double> way = length * random.in_cube();
        if (i / 200 % 2 == 0) way = Vec3<double>(0.1 * way[0], 0.1 * way[1], -std::abs(way[2]));
        for (int bounce = 0; bounce < 3; ++bounce) {
            const Vec3<double> target = at.template cast<double>() + way;
            const Vec3<Scalar> to = target.cast<Scalar>();
            const auto hit = mesh.sweep_sphere({at, to}, r);
            const Vec3<Scalar> before = at;
            at = hit ? hit->center.vec() : to;
            ASSERT_TRUE(mesh.contains(at)) << "step " << i;
            if (!hit) break;
            ++hits;
            stuck += at == before ? 1 : 0;
            const Vec3<double> n = hit->normal.template cast<double>();
            way = (1 - static_cast<double>(hit->fraction)) * (way - n * std::min(n.dot(way), 0.0));
        }
        ASSERT_TRUE(i % (steps / 20) != 0 || is_clear(at)) << "step " << i;
    }
    EXPECT_GT(hits, steps / 4);
    EXPECT_LT(stuck, hits);
}

template <class Scalar>
void all_rooms(int steps) {
    std::uint64_t seed = 1;
    for (const double offset : {0.0, 1e3, 1e6}) {
        for (const double radius : {0.05, 0.3}) {
            push_around<Scalar>(polycube(3, 0.8, 1, 3), offset, radius, steps, seed++);
            push_around<Scalar>(bumpy_sphere(5), offset, radius, steps, seed++);
            push_around<Scalar>(bowl(5), offset, radius, steps, seed++);
        }
    }
}

TEST(SphereRooms, ABallNeverGetsOutFloat) { all_rooms<float>(1500); }
TEST(SphereRooms, ABallNeverGetsOutDouble) { all_rooms<double>(1500); }
TEST(SphereRoomsSoak, ABallNeverGetsOutFloat) { all_rooms<float>(50'000); }
TEST(SphereRoomsSoak, ABallNeverGetsOutDouble) { all_rooms<double>(50'000); }

}  // namespace
}  // namespace pierce::test
