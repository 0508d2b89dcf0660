// What used to be slow is not: counted, not timed, each against its undisturbed counterpart.
//
// Found by trying the library as a new user would: `contains` took an exact decision for each face of a box that begins
// at coordinate 0 (29 ms above a
// fan of 256), and for each face whose edge lies on the way out (6 s for 80,000); one large triangle beside a dense
// part made a query look at
// all of it; 100,000 duplicates cost `all_hits` the product of hits kept and hits met.
#include <gtest/gtest.h>
#include <pierce/pierce.h>
#include <support/meshes.h>

namespace pierce::test {
namespace {

using V = Vec3<double>;

// A cube of edge 1 from (low, low, low), each side n times n squares.
template <class Scalar>
TriangleSoup<Scalar> cube(double low, int n) {
    TriangleSoup<Scalar> soup;
    for (int axis = 0; axis < 3; ++axis)
        for (const bool high : {false, true})
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {
                    const auto at = [&](int u, int v) {
                        V p;
                        p[axis] = low + (high ? 1 : 0);
                        p[(axis + 1) % 3] = low + static_cast<double>(u) / n;
                        p[(axis + 2) % 3] = low + static_cast<double>(v) / n;
                        return p;
                    };
                    const V a = at(i, j);
                    const V b = high ? at(i + 1, j) : at(i, j + 1);
                    const V c = at(i + 1, j + 1);
                    const V d = high ? at(i, j + 1) : at(i + 1, j);
                    add_triangle(soup, a, b, c);
                    add_triangle(soup, a, c, d);
                }
    return soup;
}

template <class Scalar>
std::uint64_t decisions_in_a_cube(double low, int n) {
    const CollisionMesh<Scalar> mesh(cube<Scalar>(low, n).view());
    Random random(61);
    QueryCounters counters;
    for (int i = 0; i < 2000; ++i) {
        const V p =
            V::Constant(low) + V(random.between(0.01, 0.99), random.between(0.01, 0.99), random.between(0.01, 0.99));
        EXPECT_TRUE(mesh.contains(p.cast<Scalar>(), &counters));
    }
    return counters.exact_decisions;
}

TEST(Costs, contains_where_the_mesh_begins_at_zero) {
    for (const int n : {1, 4, 60}) {
        EXPECT_LE(decisions_in_a_cube<float>(0, n), 20U) << n;
        EXPECT_LE(decisions_in_a_cube<float>(1, n), 20U) << n;
        EXPECT_LE(decisions_in_a_cube<double>(0, n), 20U) << n;
        EXPECT_LE(decisions_in_a_cube<double>(1, n), 20U) << n;
    }
}

// A cylinder on the plane z = base, whose ends are fans about the axis; asked is a point on the axis.
template <class Scalar>
std::uint64_t decisions_above_a_fan(int n, double base) {
    TriangleSoup<Scalar> soup;
    const auto rim = [&](int i, double z) {
        return V(std::cos(6.283185307179586 * (i % n) / n), std::sin(6.283185307179586 * (i % n) / n), z);
    };
    const double top = base + 10;
    for (int i = 0; i < n; ++i) {
        add_triangle(soup, V(0, 0, base), rim(i + 1, base), rim(i, base));
        add_triangle(soup, V(0, 0, top), rim(i, top), rim(i + 1, top));
        add_triangle(soup, rim(i, base), rim(i + 1, base), rim(i + 1, top));
        add_triangle(soup, rim(i, base), rim(i + 1, top), rim(i, top));
    }
    const CollisionMesh<Scalar> mesh(soup.view());
    QueryCounters counters;
    EXPECT_TRUE(mesh.contains(V(0, 0, base + 0.5).cast<Scalar>(), &counters));
    return counters.exact_decisions;
}

TEST(Costs, contains_above_a_wide_fan) {
    for (const double base : {0.0, 1.0}) {
        EXPECT_LE(decisions_above_a_fan<float>(256, base), 8U) << base;
        EXPECT_LE(decisions_above_a_fan<double>(256, base), 8U) << base;
    }
}

// 80,000 faces with an edge on the x axis. Points on it see all of them edge-on along the axis; what exact arithmetic
// is needed for are those whose edge
// holds the point itself, once each.
TEST(Costs, contains_beside_many_faces_seen_edge_on) {
    Random random(62);
    TriangleSoup<float> soup;
    add_triangle(soup, V(-1, 0, 0), V(-1, 1, 0), V(-1, 0, 1));  // so that there is more of the axis in the mesh's box
    for (int i = 0; i < 80'000; ++i)
        add_triangle(soup, V(random.unit(), 0, 0), V(random.unit(), 0, 0),
                     V(random.unit(), random.unit(), random.unit()));
    const CollisionMesh<float> mesh(soup.view());
    std::uint64_t beside = 0;
    for (int i = 0; i < 100; ++i) {
        QueryCounters counters;
        (void)mesh.contains({static_cast<float>(-random.between(0.01, 0.99)), 0, 0}, &counters);
        beside += counters.exact_decisions;
    }
    EXPECT_LE(beside, 100U);
    for (std::size_t i = 0; i < 10; ++i) {
        const Vec3<float> p = soup.positions[3 + 3 * i];
        std::uint64_t holds = 0;
        for (std::size_t k = 3; k < soup.positions.size(); k += 3) {
            const auto [low, high] = std::minmax(soup.positions[k][0], soup.positions[k + 1][0]);
            holds += low <= p[0] && p[0] <= high ? 1U : 0U;
        }
        QueryCounters counters;
        (void)mesh.contains(p, &counters);
        EXPECT_LE(counters.exact_decisions, holds + 8) << i;
    }
}

// A unit sphere beside one triangle of 1e10: to floats, all of the sphere is at one parameter of a segment from far
// away, and all of its boxes are one
// in the root's frame. Each query went through the whole sphere.
TEST(Costs, one_large_triangle_beside_a_dense_part) {
    std::array<std::uint64_t, 2> work{};
    for (const bool large : {false, true}) {
        TriangleSoup<double> soup = bumpy_sphere(40);
        const double size = 1e10;
        if (large) add_triangle(soup, V(-size, -size, -2), V(size, -size, -2), V(0, size, -2));
        const CollisionMesh<double> mesh(soup.view(), {.broadphase = Broadphase::tree});
        const CollisionMesh<double> twin(soup.view(), {.broadphase = Broadphase::grid});
        Random random(63);
        QueryCounters counters;
        for (int i = 0; i < 500; ++i) {
            const V from = 3 * random.direction() * (i % 2 == 0 ? 1 : size / 30);
            const Segment<double> segment{V(from[0], from[1], std::abs(from[2])), 0.3 * random.in_cube()};
            const auto hit = mesh.first_hit(segment, {.counters = &counters});
            const auto other = twin.first_hit(segment);
            ASSERT_EQ(hit.has_value(), other.has_value());
            if (hit) {
                EXPECT_EQ(hit->face, other->face);
            }
        }
        work[large ? 1 : 0] = counters.nodes + counters.clusters;
    }
    std::cout << work[0] << " nodes and clusters without it, " << work[1] << " with it\n";
    EXPECT_GT(work[0], 1000U);
    EXPECT_LE(work[1], 3 * work[0]);
}

TEST(Costs, all_hits_on_many_faces_in_one_place) {
    for (const bool duplicates : {true, false}) {
        const std::size_t count = duplicates ? 100'000 : 3'000;
        TriangleSoup<float> soup;
        Random random(64);
        // In one plane: either all the same, or with corners of their own, so that only exact arithmetic sees that they
        // are hit at one fraction.
        for (std::size_t i = 0; i < count; ++i) {
            const double by = duplicates ? 0 : 0.3;
            const auto some = [&](double x, double y) {
                return V(x + random.between(-by, by), y + random.between(-by, by), 0);
            };
            const V a = some(-1, -1);
            const V b = some(1, -1);
            add_triangle(soup, a, b, some(0, 1));
        }
        const CollisionMesh<float> mesh(soup.view());
        const Segment<float> segment{{0.1F, 0.05F, 1}, {-0.1F, -0.13F, -2}};
        for (const std::size_t kept : {std::size_t{100}, count}) {
            std::vector<Hit<float>> hits(kept);
            QueryCounters counters;
            ASSERT_EQ(mesh.all_hits(segment, hits, {.counters = &counters}), count);
            for (std::size_t i = 0; i < kept; ++i) ASSERT_EQ(hits[i].face, i);
            // A heap takes 2 log2 n comparisons for a hit that goes in and 2 log2 n for one that goes out.
            std::cout << count << (duplicates ? " duplicates" : " faces") << ", " << kept
                      << " kept: " << counters.exact_orders << " exact orders\n";
            EXPECT_LE(static_cast<double>(counters.exact_orders),
                      4 * static_cast<double>(count) * std::log2(static_cast<double>(kept)));
            if (duplicates) {
                EXPECT_EQ(counters.exact_orders, 0U);
            }
        }
    }
}

}  // namespace
}  // namespace pierce::test
