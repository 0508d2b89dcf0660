// Particles that are transported through some forty regions, with shared faces, edges and vertices: none is lost.
//
// Codes for particle transport accept 1 lost particle in 5 million and give up at 10.
#include <gtest/gtest.h>

#include <support/region_flights.h>

namespace pierce::test {
namespace {

template <class Scalar>
class RegionFlights : public ::testing::Test {
  protected:
    static FlightTally fly_nested(double offset, std::uint64_t flights, unsigned threads, std::uint64_t seed) {
        const auto model = nested_model(12, 3).as<Scalar>(1, Vec3<double>(offset, -offset, offset));
        const CollisionMesh<Scalar> mesh(model.soup.view());
        const Regions<Scalar> regions(mesh, model.labels);
        EXPECT_TRUE(regions.check().agree()) << regions.check().to_string();
        const FlightTally tally = fly(model, regions, flights, seed, threads);
        EXPECT_EQ(tally.lost, 0U);
        EXPECT_EQ(tally.wrong, 0U);
        EXPECT_GT(tally.crossings, flights / 2);
        EXPECT_GT(tally.stops, flights / 10);
        EXPECT_LT(tally.thin, flights / 500);
        EXPECT_LT(tally.still, flights / 500);
        return tally;
    }
};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(RegionFlights, Scalars, );

TYPED_TEST(RegionFlights, lose_no_particle) { EXPECT_EQ(this->fly_nested(0, 100000, 1, 5).flights, 100000U); }

TYPED_TEST(RegionFlights, lose_no_particle_far_from_the_origin) { this->fly_nested(1000, 100000, 1, 6); }

/// What places promise, in cubes of many colours: flights between points of a lattice go through edges and vertices as
/// often as not.
template <class Scalar>
void look_at_places(double scale, double offset) {
    Random random(11);
    const auto model = ColouredCubes(4, 5, 1, 2).model.as<Scalar>(scale, scale * Vec3<double>(offset, offset, offset));
    const CollisionMesh<Scalar> mesh(model.soup.view());
    const Regions<Scalar> regions(mesh, model.labels);
    const auto lattice_point = [&] {
        Vec3<double> p;
        for (int k = 0; k < 3; ++k) p[k] = scale * (random.between_ints(-2, 10) / 2.0 + offset);
        return p.template cast<Scalar>().eval();
    };
    const auto places = [&](const auto& flight, const Vec3<Scalar>& from) {
        std::array<Leg<Scalar>, 2> legs;
        const std::size_t count = regions.walk(flight, legs);
        const Leg<Scalar>& leg = legs[0];
        EXPECT_EQ(leg.region, regions.region_at(from));
        const RegionPlace<Scalar> before = regions.stop(flight, leg);
        std::array<Leg<Scalar>, 8> way;
        EXPECT_TRUE(before.reached);
        EXPECT_EQ(before.region, leg.region);
        EXPECT_EQ(regions.region_at(before.point), leg.region);
        EXPECT_EQ(regions.walk(Segment<Scalar>{from, before.point}, way), 1U);
        const RegionPlace<Scalar> beyond = regions.cross(flight, leg);
        EXPECT_EQ(regions.region_at(beyond.point), beyond.region);
        if (leg.face == no_face) return 0;
        const std::size_t legs_there = regions.walk(Segment<Scalar>{from, beyond.point}, way);
        if (beyond.reached) {
            EXPECT_EQ(legs_there, 2U);
            EXPECT_EQ(beyond.region, leg.next);
        }
        // Where the flight has a way to go in the next region there is a place for it.
        if (count == 2 && legs[1].exit > legs[1].entry) {
            EXPECT_TRUE(beyond.reached);
        }
        return beyond.reached ? 1 : 0;
    };
    int reached = 0;
    for (int i = 0; i < 3000 && !::testing::Test::HasFailure(); ++i) {
        const Vec3<Scalar> from = lattice_point();
        const Vec3<Scalar> to = lattice_point();
        reached += places(Segment<Scalar>{from, to}, from);
        reached += places(Ray<Scalar>{from, to - from, static_cast<Scalar>(random.below(5)) / 2}, from);
    }
    EXPECT_GT(reached, 2000);
}

TYPED_TEST(RegionFlights, have_places_on_both_sides_of_faces_edges_and_vertices) {
    constexpr int k_far = sizeof(TypeParam) == 4 ? 100 : 900;
    for (const double scale : {1.0, std::ldexp(1.0, k_far), std::ldexp(1.0, -k_far)})
        for (const double offset : {0.0, 1000.0}) look_at_places<TypeParam>(scale, offset);
}

// A wedge between two faces that rise from 1 to the next number, over nearly the same length: where the flight goes
// through, no number lies between them. The particle is put behind both, and its region is that of the place.
TYPED_TEST(RegionFlights, say_where_a_particle_is_if_the_next_region_is_too_thin) {
    using Scalar = TypeParam;
    using V = Vec3<Scalar>;
    const auto next = static_cast<double>(std::nextafter(Scalar(1), Scalar(2)));
    RegionModel<Scalar> model;
    for (const double end : {9.0, 8.0}) {
        add_triangle(model.soup, Vec3<double>(-9, -9, 1), Vec3<double>(end, -9, next), Vec3<double>(-9, 9, 1));
        const auto region = static_cast<std::uint32_t>(model.labels.size() + 1);
        model.labels.push_back({region + 1, region});
    }
    // Above it, region 3 and its end.
    const auto box = moved<Scalar>(polycube(1, 1, 1, 1), 8, Vec3<double>(-4, -9, 1.5));
    append(model.soup, box);
    model.labels.resize(model.soup.triangles.size(), {3, 4});
    const CollisionMesh<Scalar> mesh(model.soup.view());
    const Regions<Scalar> regions(mesh, model.labels);
    const Ray<Scalar> flight{V(0.25, -5, 0.5), V(0, 0, 1)};
    std::array<Leg<Scalar>, 1> leg;
    ASSERT_EQ(regions.walk(flight, leg), 1U);
    EXPECT_EQ(leg[0].region, 1U);
    EXPECT_EQ(leg[0].next, 2U);
    const RegionPlace<Scalar> place = regions.cross(flight, leg[0]);
    EXPECT_FALSE(place.reached);
    EXPECT_EQ(place.region, 3U);
    EXPECT_EQ(regions.region_at(place.point), 3U);
    EXPECT_GE(static_cast<double>(place.point[2]), next);
    EXPECT_LT(place.point[2], Scalar(1.001));
}

template <class Scalar>
class RegionFlightsSoak : public RegionFlights<Scalar> {};
TYPED_TEST_SUITE(RegionFlightsSoak, Scalars, );

// 10^9 in all.
TYPED_TEST(RegionFlightsSoak, lose_no_particle_of_a_billion) {
    const unsigned threads = std::max(1U, std::thread::hardware_concurrency());
    this->fly_nested(0, 500'000'000, threads, 1000);
}

}  // namespace
}  // namespace pierce::test
