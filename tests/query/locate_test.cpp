// Where points are, against CGAL's exact predicates on all triangles, against the cubes that a surface bounds, and
// against CGAL's side of closed meshes.
#include <algorithm>

#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/inside_oracle.h>
#include <support/meshes.h>
#include <support/real_meshes.h>
#include <support/segments.h>
#include <support/touch_oracle.h>
#include <Eigen/Geometry>

namespace pierce::test {
namespace {

using V = Vec3<double>;

// The story: particles slid over a floor; each fifth was found "outside" of the level that it rested on, and was taken
// for a leak. None had leaked: they lay exactly on the surface, where the translation rule says outside for a floor and
// inside for a ceiling.
template <class Scalar>
void rest(double offset) {
    const TriangleSoup<Scalar> soup = moved<Scalar>(polycube(1, 2, 2, 1), 1, V(offset, offset, offset));
    const CollisionMesh<Scalar> room(turned_inside_out(soup).view());
    const V low(offset, offset, offset);
    const Vec3<Scalar> in_the_air = (low + V(1, 1, 1)).cast<Scalar>();
    EXPECT_EQ(room.locate(in_the_air).place, Place::inside);
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {0.0, 2.0}) {
            V p = low + V(0.25, 0.5, 1);
            p[axis] = offset + side;
            std::array<FaceTouch, 4> faces;
            const Location location = room.locate(p.cast<Scalar>(), faces);
            EXPECT_EQ(location.place, Place::on_surface);
            EXPECT_GE(location.face_count, 1U);
            EXPECT_EQ(location.winding_number, room.winding_number(p.cast<Scalar>()));
            EXPECT_EQ(location.winding_number != 0, room.contains(p.cast<Scalar>()));
            const auto face = static_cast<Scalar>(p[axis]);
            p[axis] = static_cast<double>(std::nextafter(face, static_cast<Scalar>(offset + 1)));
            EXPECT_EQ(room.locate(p.cast<Scalar>()).place, Place::inside);
        }
    }
}

TEST(Locate, a_particle_that_rests_on_the_surface_has_not_leaked) {
    rest<float>(0);
    rest<double>(0);
    rest<float>(10'000);
    rest<double>(10'000);
}

/// Compares the faces with CGAL's, all of them and the first two only. Returns the location.
template <class Scalar>
Location expect_faces(const CollisionMesh<Scalar>& mesh, const TouchOracle& oracle, const Vec3<Scalar>& p) {
    const std::vector<TouchOracle::Found> expected = oracle.touched(p);
    std::array<FaceTouch, 64> faces;
    const Location location = mesh.locate(p, faces);
    EXPECT_EQ(location.face_count, expected.size()) << p.transpose();
    EXPECT_EQ(location.place == Place::on_surface, !expected.empty()) << p.transpose();
    std::array<FaceTouch, 2> some;
    EXPECT_EQ(mesh.locate(p, some).face_count, expected.size());
    EXPECT_EQ(mesh.locate(p).face_count, expected.size());
    for (std::size_t i = 0; i < std::min(expected.size(), faces.size()); ++i) {
        EXPECT_EQ(faces[i].face, expected[i].face) << p.transpose();
        EXPECT_EQ(faces[i].triangle, expected[i].triangle) << p.transpose();
    }
    for (std::size_t i = 0; i < std::min(expected.size(), some.size()); ++i)
        EXPECT_EQ(some[i].triangle, expected[i].triangle) << p.transpose();
    return location;
}

template <class Scalar>
void lattice(double offset, int meshes, int points) {
    for (int m = 0; m < meshes; ++m) {
        const Polycube poly(3, 0.45, 4, static_cast<std::uint64_t>(m));
        const V shift = V(1, -2, 1) * offset;
        TriangleSoup<Scalar> soup = moved<Scalar>(poly.soup, 1, shift);
        for (std::size_t i = 0; i < soup.triangles.size(); ++i)  // faces of two triangles that are no neighbours
            soup.faces.push_back(static_cast<std::uint32_t>(i % (soup.triangles.size() / 2 + 1)));
        const CollisionMesh<Scalar> mesh(soup.view());
        const TouchOracle oracle(soup.view());
        Random random(static_cast<std::uint64_t>(m) + 7);
        std::array<int, 3> seen{};
        for (int i = 0; i < points; ++i) {
            V p;
            for (int k = 0; k < 3; ++k) p[k] = random.between_ints(-2, 14);
            const Location location = expect_faces(mesh, oracle, Vec3<Scalar>((p + shift).cast<Scalar>()));
            ++seen[static_cast<std::size_t>(location.place)];
            EXPECT_EQ(location.winding_number, int(poly.inside_when_moved(p))) << p.transpose();
            if (location.place == Place::on_surface) continue;
            EXPECT_EQ(location.place == Place::inside, poly.strictly_inside(p)) << p.transpose();
        }
        for (const int count : seen) EXPECT_GT(count, points / 20);
    }
}

TEST(Locate, agrees_with_cgal_on_lattices) {
    lattice<float>(0, 4, 2'000);
    lattice<double>(0, 4, 2'000);
    lattice<float>(1e5, 2, 2'000);
    lattice<double>(1e9, 2, 2'000);
}

// Oblique planes: points with whole coordinates in triangles whose corners have them.
TEST(Locate, agrees_with_cgal_on_oblique_planes) {
    Random random(3);
    int on = 0;
    for (int m = 0; m < 200; ++m) {
        TriangleSoup<double> soup;
        const auto whole = [&] {
            const double x = random.between_ints(-4, 4);
            const double y = random.between_ints(-4, 4);
            return V(x, y, random.between_ints(-4, 4));
        };
        for (int i = 0; i < 40; ++i) {
            const V a = whole();
            const V b = whole();
            const V c = whole();
            add_triangle(soup, a, b, c);
        }
        const CollisionMesh<double> mesh(soup.view());
        const TouchOracle oracle(soup.view());
        for (int i = 0; i < 200; ++i) on += expect_faces(mesh, oracle, whole()).place == Place::on_surface ? 1 : 0;
    }
    EXPECT_GT(on, 8'000);
}

// Corners are floats, so that these weighted sums of them are exact in double: points of oblique planes whose computed
// sides are not 0.
TEST(Locate, a_computed_side_that_is_not_0_proves_nothing) {
    Random random(6);
    int computed = 0;
    for (int i = 0; i < 2'000; ++i) {
        const auto corner = [&] { return V(random.in_cube().cast<float>().cast<double>()); };
        const V a = corner();
        const V b = corner();
        const V c = corner();
        TriangleSoup<double> soup;
        add_triangle(soup, a, b, c);
        const CollisionMesh<double> mesh(soup.view());
        const V p = a * 0.5 + b * 0.25 + c * 0.25;
        computed += (b - a).cross(c - a).dot(a - p) != 0 ? 1 : 0;
        ASSERT_EQ(mesh.locate(p).place, Place::on_surface) << p.transpose();
        const V beside = a * 2 - b * 0.5 - c * 0.5;
        ASSERT_EQ(mesh.locate(beside).place, mesh.contains(beside) ? Place::inside : Place::outside);
    }
    EXPECT_GT(computed, 500);
}

// Coordinates so far apart that only sums of products hold them all. Rounded sides say nothing there.
TEST(Locate, agrees_with_cgal_for_any_exponents) {
    Random random(5);
    int on = 0;
    for (int m = 0; m < 3'000; ++m) {
        const auto wild = [&] {
            const double x = std::ldexp(random.between(-1, 1), random.between_ints(-500, 400));
            return random.chance(0.3) ? std::ldexp(1.0, random.between_ints(-500, 400)) : x;
        };
        // In a plane across an axis, or through it: y = x.
        const bool oblique = random.chance(0.5);
        const double height = wild();
        const auto in_plane = [&] {
            const double x = wild();
            const double z = wild();
            return oblique ? V(x, x, z) : V(x, height, z);
        };
        const V a = in_plane();
        const V b = in_plane();
        const V c = in_plane();
        TriangleSoup<double> soup;
        add_triangle(soup, a, b, c);
        const CollisionMesh<double> mesh(soup.view());
        const TouchOracle oracle(soup.view());
        for (int i = 0; i < 4; ++i) {
            V p = in_plane();
            if (i == 1) p = a;
            if (i == 2) p = V(a * 0.5 + b * 0.25 + c * 0.25);
            if (i == 3) p[random.between_ints(0, 2)] = wild();
            on += expect_faces(mesh, oracle, p).place == Place::on_surface ? 1 : 0;
        }
    }
    EXPECT_GT(on, 3'000);
}

TEST(Locate, names_what_of_a_face_the_point_lies_on) {
    const CollisionMesh<double> mesh(corner_triangle().view());
    const auto at = [&](double x, double y) {
        std::array<FaceTouch, 1> face;
        EXPECT_EQ(mesh.locate(V(x, y, 0), face).face_count, 1U);
        return std::pair(face[0].feature, int(face[0].feature_index));
    };
    EXPECT_EQ(at(1, 1), std::pair(Feature::face, 0));
    EXPECT_EQ(at(1, 0), std::pair(Feature::edge, 0));
    EXPECT_EQ(at(2, 2), std::pair(Feature::edge, 1));
    EXPECT_EQ(at(0, 1), std::pair(Feature::edge, 2));
    EXPECT_EQ(at(0, 0), std::pair(Feature::vertex, 0));
    EXPECT_EQ(at(4, 0), std::pair(Feature::vertex, 1));
    EXPECT_EQ(at(0, 4), std::pair(Feature::vertex, 2));
    EXPECT_EQ(mesh.locate(V(2, 2.5, 0)).place, Place::outside);
    EXPECT_EQ(mesh.locate(V(1, 1, 5e-324)).place, Place::outside);
}

TEST(Locate, triangles_without_area_are_no_surface) {
    TriangleSoup<double> soup = moved<double>(bumpy_sphere(4), 1, V(0, 0, 0));
    add_triangle(soup, V(-0.5, 0, 0), V(0.5, 0, 0), V(0, 0, 0));  // a needle inside
    add_triangle(soup, V(2, 0, 0), V(3, 0, 0), V(2.5, 0, 0));     // and one outside
    const CollisionMesh<double> mesh(soup.view());
    EXPECT_EQ(mesh.locate(V(0, 0, 0)).place, Place::inside);
    EXPECT_EQ(mesh.locate(V(2.5, 0, 0)).place, Place::outside);
    const CollisionMesh<double> needles(MeshView<double>{soup.positions, std::span(soup.triangles).last(2)});
    EXPECT_EQ(needles.locate(V(0, 0, 0)).place, Place::outside);
}

TEST(Locate, what_is_not_finite_is_outside_and_counted) {
    const CollisionMesh<double> mesh(bumpy_sphere(4).view());
    QueryCounters counters;
    EXPECT_EQ(mesh.locate(V(0, std::numeric_limits<double>::quiet_NaN(), 0), {}, &counters).place, Place::outside);
    EXPECT_EQ(mesh.locate(V(std::numeric_limits<double>::infinity(), 0, 0), {}, &counters).place, Place::outside);
    EXPECT_EQ(mesh.locate(V(0, 0, 0), {}, &counters).place, Place::inside);
    EXPECT_EQ(mesh.statistics().invalid_queries, 2U);
    EXPECT_EQ(counters.queries, 3U);
    EXPECT_GT(counters.clusters, 0U);
    EXPECT_EQ(mesh.locate(V(1e300, 0, 0)).place, Place::outside);
    EXPECT_EQ(CollisionMesh<double>(MeshView<double>{}).locate(V(0, 0, 0)).place, Place::outside);
}

// Open: a floor. Its points are on the surface, above and below are what the way out says.
TEST(Locate, open_meshes_have_a_surface_as_well) {
    const CollisionMesh<double> floor(terrain(8, 0, 1).view());
    EXPECT_EQ(floor.locate(V(0.1, 0.1, 0)).place, Place::on_surface);
    EXPECT_EQ(floor.locate(V(1, 1, 0)).place, Place::on_surface);
    EXPECT_EQ(floor.locate(V(0, 0, 0)).face_count, 6U);
    for (const double z : {-1e-300, 1e-300}) {
        const Location location = floor.locate(V(0.1, 0.1, z));
        EXPECT_EQ(location.place == Place::inside, floor.contains(V(0.1, 0.1, z)));
        EXPECT_NE(location.place, Place::on_surface);
    }
}

class LocateRealMeshes : public ::testing::TestWithParam<std::string_view> {};

TEST_P(LocateRealMeshes, agree_with_cgal) {
    const TriangleSoup<double> soup = real_mesh<double>(GetParam());
    const CollisionMesh<double> mesh(soup.view());
    const InsideOracle<double> cgal(soup);
    const Extent<double> extent(soup.view());
    Random random(2);
    std::array<int, 3> seen{};
    for (int i = 0; i < 10'000; ++i) {
        const V p = mixed_segment(soup.view(), extent, random).to;
        const CGAL::Bounded_side side = cgal.side(p);
        const Place expected = side == CGAL::ON_BOUNDARY       ? Place::on_surface
                               : side == CGAL::ON_BOUNDED_SIDE ? Place::inside
                                                               : Place::outside;
        ASSERT_EQ(mesh.locate(p).place, expected) << p.transpose();
        ++seen[static_cast<std::size_t>(expected)];
    }
    for (const int count : seen) EXPECT_GT(count, 100);
}

INSTANTIATE_TEST_SUITE_P(Debian, LocateRealMeshes, ::testing::Values("blobby", "elephant", "fandisk", "knot1", "rotor"),
                         [](const auto& param) { return std::string(param.param); });

}  // namespace
}  // namespace pierce::test
