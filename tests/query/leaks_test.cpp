// No chain of steps gets from the front of a closed surface to its back without a hit, not through an edge and not
// through a vertex; and the experiment that says why hits and crossings follow two rules, which must not be mixed.
#include <gtest/gtest.h>
#include <exact/crossing.h>
#include <exact/decide.h>
#include <exact/volumes.h>
#include <pierce/collision_mesh.h>
#include <support/meshes.h>

namespace pierce::test {
namespace {

using V = Vec3<double>;

template <class Scalar>
class Leaks : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Leaks, Scalars);

TYPED_TEST(Leaks, none_in_the_corner_of_floor_and_wall) {
    // An L of cubes, facing outwards: the floor is the top of the lower part, the wall the side of the upper one.
    //
    //        +----+            A point exactly in the valley edge (o) is on the plane of both, in front of
    //        |wall|            both, and moves into the wall: hit. The same into the floor, and into
    //   +----o    |            the edge between them.
    //   | floor   |
    //   +---------+
    TriangleSoup<double> soup;
    const auto vertex = [&](double x, double y, double z) {
        soup.positions.push_back(V(x, y, z));
        return static_cast<std::uint32_t>(soup.positions.size() - 1);
    };
    const double outline[6][2] = {{0, 0}, {2, 0}, {2, 2}, {1, 2}, {1, 1}, {0, 1}};  // counter-clockwise in x, z
    std::array<std::uint32_t, 6> near{};
    std::array<std::uint32_t, 6> far{};
    for (std::size_t i = 0; i < 6; ++i) {
        near[i] = vertex(outline[i][0], 0, outline[i][1]);
        far[i] = vertex(outline[i][0], 3, outline[i][1]);
    }
    for (std::size_t i = 0; i < 6; ++i) {
        const std::size_t j = (i + 1) % 6;
        soup.triangles.push_back({near[i], far[j], near[j]});
        soup.triangles.push_back({near[i], far[i], far[j]});
    }
    for (const auto& t : {std::array<std::size_t, 3>{0, 1, 4}, {0, 4, 5}, {1, 2, 4}, {2, 3, 4}}) {
        soup.triangles.push_back({near[t[0]], near[t[1]], near[t[2]]});
        soup.triangles.push_back({far[t[0]], far[t[2]], far[t[1]]});
    }
    const CollisionMesh<TypeParam> mesh(moved<TypeParam>(soup, 1, V(0, 0, 0)).view());
    ASSERT_TRUE(mesh.mesh_report().closed()) << mesh.mesh_report().to_string();
    using P = Vec3<TypeParam>;
    for (double y : {0.5, 1.0, 1.5, 2.999}) {
        const P edge = V(1, y, 1).cast<TypeParam>();
        for (double dx : {-0.5, 0.0, 0.5})
            for (double dz : {-0.5, 0.0, 0.5})
                for (double dy : {-0.3, 0.0, 0.0001}) {
                    const P d = V(dx, dy, dz).cast<TypeParam>();
                    const bool into = dx > 0 || dz < 0;
                    EXPECT_EQ(mesh.any_hit({edge, edge + d}), into) << y << ": " << d.transpose();
                }
    }
}

// Every vertex, edge and face of lattice meshes as a start, every direction of motion: what ends inside was hit on the
// way.
TYPED_TEST(Leaks, none_from_any_vertex_edge_or_face_in_any_octant) {
    std::int64_t into = 0;
    for (std::uint64_t seed = 0; seed < 6; ++seed)
        for (const double offset : {0.0, 1e3, 1e6}) {
            const Polycube poly(3, 0.5, 4, seed);
            const V shift(offset, -offset, offset);
            const CollisionMesh<TypeParam> mesh(moved<TypeParam>(poly.soup, 1, shift).view());
            for (int x = 0; x <= 12; x += 2)
                for (int y = 0; y <= 12; y += 2)
                    for (int z = 0; z <= 12; z += 2) {
                        const V from(x, y, z);
                        if (poly.strictly_inside(from)) continue;
                        for (int dx = -3; dx <= 3; ++dx)
                            for (int dy = -3; dy <= 3; ++dy)
                                for (int dz = -3; dz <= 3; ++dz) {
                                    const V to = from + V(dx, dy, dz);
                                    if (!poly.strictly_inside(to)) continue;
                                    ++into;
                                    ASSERT_TRUE(mesh.any_hit(
                                        {(from + shift).cast<TypeParam>(), (to + shift).cast<TypeParam>()}))
                                        << from.transpose() << " -> " << to.transpose();
                                }
                    }
        }
    EXPECT_GT(into, 100'000);
}

// Where both sides count: what ends inside was hit on the way in, and what starts inside on the way out, also if it
// only comes to rest on the surface. Leaks::none_from_any... tried with fronts alone never saw a passage from the back.
TYPED_TEST(Leaks, none_either_way_where_both_sides_count) {
    std::int64_t in = 0;
    std::int64_t out = 0;
    for (std::uint64_t seed = 0; seed < 6; ++seed)
        for (const double offset : {0.0, 1e3}) {
            const Polycube poly(3, 0.5, 4, seed);
            const V shift(offset, -offset, offset);
            const CollisionMesh<TypeParam> mesh(moved<TypeParam>(poly.soup, 1, shift).view());
            for (int x = 0; x <= 12; x += 2)
                for (int y = 0; y <= 12; y += 2)
                    for (int z = 0; z <= 12; z += 2)
                        for (int dx = -3; dx <= 3; ++dx)
                            for (int dy = -3; dy <= 3; ++dy)
                                for (int dz = -3; dz <= 3; ++dz) {
                                    const V from(x, y, z);
                                    const V to = from + V(dx, dy, dz);
                                    const bool inside = poly.strictly_inside(from);
                                    if (poly.strictly_inside(to) == inside) continue;
                                    ++(inside ? out : in);
                                    ASSERT_TRUE(
                                        mesh.any_hit({(from + shift).cast<TypeParam>(), (to + shift).cast<TypeParam>()},
                                                     {.sides = Sides::both}))
                                        << from.transpose() << " -> " << to.transpose();
                                }
        }
    EXPECT_GT(in, 50'000);
    EXPECT_GT(out, 50'000);
}

// The rules on 1.2 million steps of lattice walks around random polycubes. A walk starts outside and goes wherever the
// rule sees no hit. `mixed` takes half-open plane sides from the first rule and tie-broken edges from the second.
enum class Rule { closed, both, translated, mixed };

bool hit(const detail::Path& path, const detail::Corners& corners, Rule rule) {
    if (rule == Rule::closed) return detail::decide(path, corners, Sides::front).hit;
    if (rule == Rule::both) return detail::decide(path, corners, Sides::both).hit;
    if (rule == Rule::translated) return detail::crossing(path, corners) > 0;
    return detail::with_volumes(path, corners, [](const auto& volumes) {
        if (!(volumes.from_side().sign() >= 0 && volumes.to_side().sign() < 0)) return false;
        for (int k = 0; k < 3; ++k) {
            int weight = volumes.weight(k).sign();
            if (weight == 0) weight = volumes.edge_shift(k);
            if (weight != 1) return false;
        }
        return true;
    });
}

std::int64_t leaks_in_lattice_walks(Rule rule) {
    std::int64_t leaks = 0;
    for (std::uint64_t trial = 0; trial < 400; ++trial) {
        const Polycube poly(3, 0.45, 4, trial);
        const auto& soup = poly.soup;
        std::vector<detail::Corners> triangles;
        for (const IndexTriple& t : soup.triangles)
            triangles.push_back({detail::to_point(soup.positions[t[0]]), detail::to_point(soup.positions[t[1]]),
                                 detail::to_point(soup.positions[t[2]])});
        Random random(trial);
        const V start(-3, -3, -3);
        V p = start;
        bool inside = false;
        for (int step = 0; step < 3000; ++step) {
            V q;
            const std::size_t kind = random.below(3);
            for (int k = 0; k < 3; ++k) {
                if (kind == 0) q[k] = random.between_ints(-4, 16);
                else q[k] = std::clamp(p[k] + random.between_ints(kind == 1 ? -1 : -4, kind == 1 ? 1 : 4), -4.0, 16.0);
            }
            const detail::Path path{detail::to_point(p), detail::to_point(q)};
            const V low = p.cwiseMin(q);
            const V high = p.cwiseMax(q);
            const bool stopped = std::any_of(triangles.begin(), triangles.end(), [&](const detail::Corners& c) {
                for (std::size_t k = 0; k < 3; ++k) {
                    const auto at = static_cast<int>(k);
                    if (std::min({c[0][k], c[1][k], c[2][k]}) > high[at] ||
                        std::max({c[0][k], c[1][k], c[2][k]}) < low[at])
                        return false;
                }
                return hit(path, c, rule);
            });
            // A walk where both sides count goes on from the inside, of every 1,000 steps the second half.
            if (rule == Rule::both && step % 500 == 0) {
                inside = step % 1000 == 500 && !poly.cube.empty();
                p = start;
                for (int k = 0; inside && k < 3; ++k) p[k] = 4 * (*poly.cube.begin())[static_cast<std::size_t>(k)] + 2;
                continue;
            }
            if (stopped) continue;
            p = q;
            if (poly.strictly_inside(p) == inside) continue;
            ++leaks;
            p = start;
            inside = false;
        }
    }
    return leaks;
}

TEST(LeakRules, closed_and_translated_never_leak_mixed_does) {
    EXPECT_EQ(leaks_in_lattice_walks(Rule::closed), 0);
    EXPECT_EQ(leaks_in_lattice_walks(Rule::both), 0);
    EXPECT_EQ(leaks_in_lattice_walks(Rule::translated), 0);
    const std::int64_t mixed = leaks_in_lattice_walks(Rule::mixed);
    std::cout << "the mixture leaks " << mixed << " times in 1.2 million steps\n";
    EXPECT_GT(mixed, 0);
}

}  // namespace
}  // namespace pierce::test
