// Crossings count each passage through the surface once: on lattices, where nearly every segment is degenerate, against
// the cubes that the surface bounds; on real closed meshes against CGAL.
#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/inside_oracle.h>
#include <support/meshes.h>
#include <support/real_meshes.h>
#include <support/segments.h>

namespace pierce::test {
namespace {

using V = Vec3<double>;

// A point on the lattice of half a cube's edge: on faces, edges and vertices as often as not.
V lattice_point(Random& random, const Polycube& poly) {
    const int most = 2 * (poly.size + 1);
    const auto c = [&] { return poly.edge / 2 * random.between_ints(-2, most); };
    const double x = c();
    const double y = c();
    return {x, y, c()};
}

template <class Scalar>
void lattice_crossings(double offset, int meshes, int segments) {
    for (int m = 0; m < meshes; ++m) {
        const Polycube poly(4, 0.45, 4, static_cast<std::uint64_t>(m));
        const V shift = V(1, -2, 1) * offset;
        const CollisionMesh<Scalar> mesh(moved<Scalar>(poly.soup, 1, shift).view());
        Random random(static_cast<std::uint64_t>(m) + 100);
        int changes = 0;
        for (int i = 0; i < segments; ++i) {
            const V p = lattice_point(random, poly);
            V q = lattice_point(random, poly);
            for (int k = 0; k < 3; ++k)
                if (random.chance(0.4)) q[k] = p[k];  // along an axis or in a plane of faces
            const int change = int(poly.inside_when_moved(q)) - int(poly.inside_when_moved(p));
            const Segment<Scalar> segment{(p + shift).cast<Scalar>(), (q + shift).cast<Scalar>()};
            ASSERT_EQ(mesh.crossings(segment), change) << p.transpose() << " -> " << q.transpose();
            changes += std::abs(change);
            if (i % 8 == 0) {
                ASSERT_EQ(mesh.contains(segment.from), poly.inside_when_moved(p)) << p.transpose();
                ASSERT_EQ(mesh.winding_number(segment.from), int(poly.inside_when_moved(p))) << p.transpose();
            }
        }
        EXPECT_GT(changes, segments / 10);
    }
}

TEST(Crossings, equal_the_change_of_the_winding_number_on_lattices) {
    lattice_crossings<float>(0, 10, 40'000);
    lattice_crossings<double>(0, 10, 40'000);
    lattice_crossings<float>(1e6, 4, 25'000);
    lattice_crossings<double>(1e9, 4, 25'000);
}

TEST(Crossings, hold_for_faces_that_repeat_coordinates_and_for_open_meshes) {
    // The same polycube as a soup in which every triangle has vertices of its own: seams by coordinates only.
    const Polycube poly(3, 0.5, 2, 5);
    const CollisionMesh<double> whole(poly.soup.view());
    const CollisionMesh<double> parts(apart(poly.soup).view());
    // An open square: each passage counts once, on the diagonal and at the middle too.
    const CollisionMesh<double> square(terrain(2, 0, 1).view());
    Random random(6);
    for (int i = 0; i < 20'000; ++i) {
        const Segment<double> s{lattice_point(random, poly), lattice_point(random, poly)};
        ASSERT_EQ(whole.crossings(s), parts.crossings(s));
        const V at(random.between_ints(-3, 3) / 4.0, random.between_ints(-3, 3) / 4.0, 0);
        const V d(random.between_ints(-1, 1) / 8.0, random.between_ints(-1, 1) / 8.0, 1);
        ASSERT_EQ(square.crossings({at + d, at - d}), 1) << at.transpose();
        ASSERT_EQ(square.crossings({at - d, at + d}), -1) << at.transpose();
        ASSERT_EQ(square.crossings({at + d, at + 2 * d}), 0) << at.transpose();
    }
}

TEST(Crossings, that_are_not_finite_count_nothing) {
    const CollisionMesh<double> mesh(bumpy_sphere(4).view());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(mesh.crossings({V(0, 0, 0), V(nan, 0, 9)}), 0);
    EXPECT_FALSE(mesh.contains(V(0, nan, 0)));
    EXPECT_TRUE(mesh.contains(V(0, 0, 0)));
    EXPECT_EQ(mesh.statistics().invalid_queries, 2U);
    const CollisionMesh<double> empty(MeshView<double>{});
    EXPECT_FALSE(empty.contains(V(0, 0, 0)));
    EXPECT_EQ(empty.crossings({V(0, 0, 0), V(1, 1, 1)}), 0);
}

TEST(Crossings, winding_number_counts_nested_and_inverted_surfaces) {
    TriangleSoup<double> soup = bumpy_sphere(6);
    append(soup, moved<double>(bumpy_sphere(6), 0.5, V(0, 0, 0)));
    append(soup, turned_inside_out(moved<double>(bumpy_sphere(6), 0.5, V(5, 0, 0))));
    const CollisionMesh<double> mesh(soup.view());
    EXPECT_EQ(mesh.winding_number(V(0, 0, 0)), 2);
    EXPECT_EQ(mesh.winding_number(V(0.7, 0, 0)), 1);
    EXPECT_EQ(mesh.winding_number(V(2, 0, 0)), 0);
    EXPECT_EQ(mesh.winding_number(V(5, 0, 0)), -1);
}

// Segments and points of each mesh that are really compared: one that CGAL finds on the surface itself has no parity
// and is not.
constexpr int k_compared = 125'000;
constexpr std::array<std::string_view, 8> k_closed_meshes = {"blobby", "couplingdown", "triceratops", "elephant",
                                                             "eight",  "fandisk",      "knot1",       "rotor"};
static_assert(k_compared * k_closed_meshes.size() >= 1'000'000);

class RealCrossings : public ::testing::TestWithParam<std::string_view> {};

TEST_P(RealCrossings, agree_with_cgal) {
    const TriangleSoup<double> soup = real_mesh<double>(GetParam());
    const CollisionMesh<double> mesh(soup.view());
    ASSERT_TRUE(mesh.mesh_report().closed()) << mesh.mesh_report().to_string();
    const InsideOracle<double> cgal(soup);
    const Extent<double> extent(soup.view());
    Random random(9);
    int inside = 0;
    V from = extent.low - V(1, 1, 1);
    bool from_inside = false;
    int compared = 0;
    for (int i = 0; i < 2 * k_compared && compared < k_compared; ++i) {
        V to = extent.low + (extent.high - extent.low).cwiseProduct(random.in_cube().cwiseAbs());
        const Segment<double> mixed = mixed_segment(soup.view(), extent, random);
        if (random.chance(0.3)) to = mixed.to;
        const auto side = cgal.side(to);
        if (side == CGAL::ON_BOUNDARY) continue;
        const bool to_inside = side == CGAL::ON_BOUNDED_SIDE;
        ASSERT_EQ(mesh.contains(to), to_inside) << to.transpose();
        ASSERT_EQ(mesh.crossings({from, to}), int(to_inside) - int(from_inside))
            << from.transpose() << " -> " << to.transpose();
        ++compared;
        inside += to_inside ? 1 : 0;
        from = to;
        from_inside = to_inside;
    }
    EXPECT_EQ(compared, k_compared);
    EXPECT_GT(inside, compared / 50);
    EXPECT_LT(inside, compared * 9 / 10);
}

// Closed, and without self-intersections: CGAL's answer is a parity.
INSTANTIATE_TEST_SUITE_P(Debian, RealCrossings,
                         ::testing::ValuesIn(k_closed_meshes),
                         [](const auto& param) { return std::string(param.param); });

}  // namespace
}  // namespace pierce::test
