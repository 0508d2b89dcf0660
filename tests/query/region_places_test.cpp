// Places for particles in regions where it is narrow, or where labels are wrong; and the limits of what `check` finds.
#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <pierce/pierce.h>
#include <support/meshes.h>
#include <support/random.h>
#include <support/region_models.h>

namespace pierce::test {
namespace {

template <class Scalar>
class RegionPlaces : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(RegionPlaces, Scalars, );

/// A box that faces outwards, with these labels on all of its faces.
template <class Scalar>
void add_box(RegionModel<Scalar>& model, const Vec3<double>& low, const Vec3<double>& high, FaceRegions labels) {
    const auto at = [&](int k) {
        return Vec3<double>(k & 1 ? high[0] : low[0], k & 2 ? high[1] : low[1], k & 4 ? high[2] : low[2]);
    };
    constexpr int k_faces[12][3] = {{0, 4, 6}, {0, 6, 2}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6},
                                    {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3}, {1, 3, 7}, {1, 7, 5}};
    TriangleSoup<double> box;
    for (const auto& face : k_faces) add_triangle(box, at(face[0]), at(face[1]), at(face[2]));
    append(model.soup, moved<Scalar>(box, 1, {0, 0, 0}));
    model.labels.insert(model.labels.end(), 12, labels);
}

// Two boxes overlap: their faces pass through each other, away from all edges, so the labels agree around each edge. A
// point in the overlap has two regions. `check` said that no flight comes to a leg that is not consistent.
TYPED_TEST(RegionPlaces, faces_that_pass_through_each_other_are_not_found_but_flights_show_them) {
    using Scalar = TypeParam;
    RegionModel<Scalar> model;
    add_box(model, {0, 0, 0}, {2, 2, 2}, {0, 1});
    add_box(model, {1, 1, 1}, {3, 3, 3}, {0, 2});
    const CollisionMesh<Scalar> mesh(model.soup.view());
    const Regions<Scalar> regions(mesh, model.labels);
    EXPECT_TRUE(regions.check().agree());
    std::array<Leg<Scalar>, 8> legs;
    const std::size_t count = regions.walk(Segment<Scalar>{{-1, 1.5, 1.625}, {4, 1.5, 1.625}}, legs);
    ASSERT_EQ(count, 5U);
    EXPECT_TRUE(legs[0].consistent);
    EXPECT_FALSE(legs[1].consistent);
}

// The left wall of a box within a box coincides with that of the outer one, and its labels are wrong: region 7 before
// it. Beyond both a place would be in a region that the labels don't tell from the way there: 2 by the wall that was
// crossed, 9 by all others.
TYPED_TEST(RegionPlaces, the_region_of_a_place_is_that_of_the_point_also_where_labels_are_wrong) {
    using Scalar = TypeParam;
    RegionModel<Scalar> model;
    add_box(model, {1, 0, 0}, {5, 4, 4}, {0, 1});
    add_box(model, {1, 1, 1}, {4, 3, 3}, {1, 9});
    model.labels[12] = model.labels[13] = {7, 2};
    const CollisionMesh<Scalar> mesh(model.soup.view());
    const Regions<Scalar> regions(mesh, model.labels);
    EXPECT_FALSE(regions.check().agree());
    Random random(3);
    for (int i = 0; i < 200; ++i) {
        const auto coordinate = [&] { return static_cast<Scalar>(1.2 + 1.6 * random.unit()); };
        const Segment<Scalar> flight{{-1, coordinate(), coordinate()}, {2, coordinate(), coordinate()}};
        std::array<Leg<Scalar>, 1> legs;
        ASSERT_EQ(regions.walk(flight, legs), 1U);
        for (const RegionPlace<Scalar>& place : {regions.cross(flight, legs[0]), regions.stop(flight, legs[0])})
            EXPECT_EQ(place.region, regions.region_at(place.point))
                << said(flight) << " to " << place.point.transpose();
    }
}

// Deep in a wedge, where its walls are closer together than a grain, no place off the plane that is hit is clear: the
// particle goes back along its way just as far as there is room, and not to where it came from.
TYPED_TEST(RegionPlaces, before_a_face_in_a_narrow_wedge_lie_back_along_the_way) {
    using Scalar = TypeParam;
    TriangleSoup<double> wedge;  // along z, its edge at x = 0, open at x = 1; seen from inside
    const double steep = 0x1p-12;
    const Vec3<double> a(0, 0, -1), b(0, 0, 1), c(1, steep, -1), d(1, steep, 1), e(1, -steep, -1), f(1, -steep, 1);
    add_triangle(wedge, a, c, d);
    add_triangle(wedge, a, d, b);
    add_triangle(wedge, a, f, e);
    add_triangle(wedge, a, b, f);
    add_triangle(wedge, c, e, f);
    add_triangle(wedge, c, f, d);
    const TriangleSoup<Scalar> soup = moved<Scalar>(wedge, 1, {0, 0, 0});
    const CollisionMesh<Scalar> mesh(soup.view());
    const std::vector<FaceRegions> labels(soup.triangles.size(), {1, 0});
    const Regions<Scalar> regions(mesh, labels);
    const double ulp = std::is_same_v<Scalar, float> ? 0x1p-23 : 0x1p-52;
    int back = 0;
    for (const double depth : {0x1p10, 0x1p9, 0x1p8, 0x1p7}) {  // in units in the last place
        const auto y = static_cast<Scalar>(steep * depth * ulp * 0.999);
        const Segment<Scalar> flight{{Scalar(0.5), 0, Scalar(0.1)},
                                     {static_cast<Scalar>(depth * ulp * 0.9), y, Scalar(0.1)}};
        std::array<Leg<Scalar>, 1> legs;
        ASSERT_EQ(regions.walk(flight, legs), 1U);
        if (legs[0].face == no_face) continue;
        const RegionPlace<Scalar> place = regions.stop(flight, legs[0]);
        EXPECT_EQ(place.region, legs[0].region);
        EXPECT_EQ(regions.region_at(place.point), legs[0].region);
        EXPECT_LT(place.point.x(), Scalar(0.26)) << depth;
        ++back;
    }
    EXPECT_GT(back, 2);
}

// A grain is rounded away from the face, so that a place is never nearer than that: in all three coordinates.
TEST(RegionPlacesFloat, are_a_grain_or_more_off_the_plane) {
    const TriangleSoup<float> soup = moved<float>(bumpy_sphere(12), 1, {3, 5, 7});
    const CollisionMesh<float> mesh(soup.view());
    const std::vector<FaceRegions> labels(soup.triangles.size(), {0, 1});
    const Regions<float> regions(mesh, labels);
    float largest = 0;
    for (const Vec3<float>& p : soup.positions) largest = std::max(largest, p.cwiseAbs().maxCoeff());
    const double grain = 4 * (static_cast<double>(std::nextafter(largest, 100.0F)) - static_cast<double>(largest));
    Random random(5);
    for (int i = 0; i < 3000; ++i) {
        const auto direction = [&] { return static_cast<float>(2 * random.unit() - 1); };
        const Segment<float> flight{{3, 5, 7}, {3 + 3 * direction(), 5 + 3 * direction(), 7 + 3 * direction()}};
        std::array<Leg<float>, 1> legs;
        ASSERT_EQ(regions.walk(flight, legs), 1U);
        if (legs[0].face == no_face) continue;
        const IndexTriple& t = soup.triangles[legs[0].triangle];
        const Vec3<double> corner = soup.positions[t[0]].cast<double>();
        const Vec3<double> normal = (soup.positions[t[1]].cast<double>() - corner)
                                        .cross(soup.positions[t[2]].cast<double>() - corner)
                                        .normalized();
        // What is computed here, and the normal, the true point and the product in the library, round in double.
        const double least = grain - 64 * 0x1p-52 * 10;
        EXPECT_LE(normal.dot(regions.stop(flight, legs[0]).point.cast<double>() - corner), -least) << said(flight);
        EXPECT_GE(normal.dot(regions.cross(flight, legs[0]).point.cast<double>() - corner), least) << said(flight);
    }
}

}  // namespace
}  // namespace pierce::test
