// Regions: walks against a judge in rationals that looks at all triangles, and what must be true of any walk.
#include <gtest/gtest.h>

#include <pierce/pierce.h>
#include <support/meshes.h>
#include <support/region_models.h>
#include <support/region_oracle.h>
#include <support/within_an_ulp.h>

namespace pierce::test {
namespace {

template <class Scalar>
using V = Vec3<Scalar>;

/// All legs are as the judge says. Returns how many.
template <class Scalar, class Way>
std::size_t judge(const Regions<Scalar>& regions, const RegionModel<Scalar>& model, const Way& way) {
    const std::vector<OracleLeg> expected = RegionOracle<Scalar>(way).legs(model.soup, model.labels);
    std::vector<Leg<Scalar>> legs(expected.size() + 3);
    const std::size_t count = regions.walk(way, legs);
    EXPECT_EQ(count, expected.size()) << said(way);
    if (count != expected.size()) return 0;
    Scalar entry = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Leg<Scalar>& leg = legs[i];
        const OracleLeg& e = expected[i];
        const auto text = [&] { return said(way) + " leg " + std::to_string(i); };
        EXPECT_EQ(leg.triangle, e.triangle.value_or(no_face)) << text();
        if (e.triangle) {
            EXPECT_EQ(leg.face, model.soup.view().face_of(*e.triangle)) << text();
        }
        EXPECT_EQ(leg.consistent, e.consistent) << text();
        EXPECT_EQ(leg.entry, entry) << text();
        EXPECT_GE(leg.exit, leg.entry) << text();
        if (count > 1) {
            EXPECT_EQ(leg.region, e.region) << text();
            EXPECT_EQ(leg.next, e.next) << text();
        }
        if (e.triangle) {
            EXPECT_EQ(leg.side, e.from_front ? Sides::front : Sides::back) << text();
            EXPECT_TRUE(within_an_ulp(leg.exit, e.exit)) << text() << ": " << leg.exit << " for " << e.exit.get_d();
            if (i > 0 && e.exit == expected[i - 1].exit) {
                EXPECT_EQ(leg.exit, leg.entry) << text();
            }
        }
        entry = leg.exit;
    }
    // The first ones are the same whatever the room.
    for (std::size_t room = 1; room < count; ++room) {
        std::vector<Leg<Scalar>> some(room);
        EXPECT_EQ(regions.walk(way, some), room) << said(way);
        for (std::size_t i = 0; i < room; ++i) {
            EXPECT_EQ(some[i].triangle, legs[i].triangle) << said(way) << " room " << room;
            EXPECT_EQ(some[i].region, legs[i].region) << said(way) << " room " << room;
            EXPECT_EQ(some[i].exit, legs[i].exit) << said(way) << " room " << room;
        }
    }
    return count;
}

/// A few labelled triangles in one place: some on a lattice, with vertices in common, some anywhere, some twice.
template <class Scalar>
RegionModel<Scalar> handful(double size, Random& random) {
    RegionModel<Scalar> model;
    const auto some = [&]() -> Vec3<double> {
        if (random.chance(0.2)) return 3 * size * random.in_cube();
        Vec3<double> p;
        for (int k = 0; k < 3; ++k) p[k] = size * random.between_ints(-2, 2);
        return p;
    };
    for (int i = 0; i < 12; ++i) {
        if (i > 0 && random.chance(0.2)) {
            const IndexTriple t = model.soup.triangles[random.below(model.soup.triangles.size())];
            model.soup.triangles.push_back(random.chance(0.5) ? t : IndexTriple{t[1], t[0], t[2]});
        } else {
            add_triangle(model.soup, some(), some(), some());
        }
        const auto region = [&] { return static_cast<std::uint32_t>(random.below(4)); };
        model.labels.push_back({region(), region()});
    }
    // Some are two triangles to a face.
    if (random.chance(0.3))
        for (std::uint32_t t = 0; t < 12; ++t) model.soup.faces.push_back(t / 2);
    return model;
}

template <class Scalar>
class Flights {
  public:
    Flights(const RegionModel<Scalar>& model, double size, Random& random)
        : model_(model), size_(size), random_(random) {}

    Segment<Scalar> segment() { return {point(), point()}; }
    Ray<Scalar> ray() {
        Ray<Scalar> ray{point(), {}};
        ray.direction = point() - ray.origin;
        if (random_.chance(0.3))
            for (int k = 0; k < 3; ++k) ray.direction[k] = static_cast<Scalar>(random_.between_ints(-2, 2));
        constexpr int k_range = std::numeric_limits<Scalar>::max_exponent / 2 - 40;
        if (random_.chance(0.3)) ray.direction *= std::ldexp(Scalar(1), random_.between_ints(-k_range, k_range));
        if (random_.chance(0.1))
            ray.direction[static_cast<int>(random_.below(3))] = std::numeric_limits<Scalar>::denorm_min();
        if (!ray.direction.allFinite()) ray.direction = V<Scalar>(1, 0, 0);
        if (random_.chance(0.3)) ray.limit = static_cast<Scalar>(random_.between_ints(0, 4)) / 2;
        return ray;
    }
    V<Scalar> point() {
        if (random_.chance(0.2)) return model_.soup.positions[random_.below(model_.soup.positions.size())];
        V<Scalar> p;
        if (random_.chance(0.2)) {
            p = (4 * size_ * random_.in_cube()).template cast<Scalar>();
        } else {
            for (int k = 0; k < 3; ++k) p[k] = static_cast<Scalar>(size_ * random_.between_ints(-3, 3));
        }
        if (random_.chance(0.05)) p[static_cast<int>(random_.below(3))] = std::numeric_limits<Scalar>::denorm_min();
        return p;
    }

  private:
    const RegionModel<Scalar>& model_;
    double size_;
    Random& random_;
};

template <class Scalar>
std::size_t judge_many(std::size_t rounds, std::uint64_t seed) {
    Random random(seed);
    std::size_t legs = 0;
    for (std::size_t round = 0; round < rounds && !::testing::Test::HasFailure(); ++round) {
        constexpr int k_range = sizeof(Scalar) == 4 ? 100 : 900;
        const int exponent = random.chance(0.5) ? 0 : random.between_ints(-k_range, k_range);
        const double size = std::ldexp(random.chance(0.5) ? 1 : random.between(1, 2), exponent);
        const RegionModel<Scalar> model = handful<Scalar>(size, random);
        const CollisionMesh<Scalar> mesh(model.soup.view());
        const Regions<Scalar> regions(mesh, model.labels, 9);
        Flights<Scalar> flights(model, size, random);
        for (int i = 0; i < 20; ++i)
            legs += judge(regions, model, flights.segment()) + judge(regions, model, flights.ray());
    }
    return legs;
}

template <class Scalar>
class RegionsTest : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(RegionsTest, Scalars, );

TYPED_TEST(RegionsTest, walk_as_the_judge_says) { EXPECT_GT(judge_many<TypeParam>(150, 5), 6000U); }

// Two sheets meet in an edge, which a flight goes through at a fraction that lies in the middle between two floats:
// each sheet's own arithmetic rounds it up or down as its errors go, so that one leg had a length that it has not.
TEST(RegionsFloat, give_equal_fractions_equal_bits) {
    Random random(6);
    const float k = 0x1p24F + 1236;  // every second whole number is a float here; k is one
    const Segment<float> way{V<float>(0, 0, 0), V<float>(0x1p25F, 0, 0)};
    for (int i = 0; i < 1000; ++i) {
        const Vec3<double> middle(static_cast<double>(k) + 1, 0, 0);
        const Vec3<double> half(1, random.between_ints(1, 9), random.between_ints(1, 9));
        RegionModel<float> model;
        for (std::uint32_t sheet = 0; sheet < 2; ++sheet) {
            const Vec3<double> side = 1e6 * random.in_cube();
            add_triangle(model.soup, middle - half, middle + half, middle + side);
            add_triangle(model.soup, middle + half, middle - half, middle - side);
            model.labels.insert(model.labels.end(), 2, {sheet, sheet + 1});
        }
        const CollisionMesh<float> mesh(model.soup.view());
        const Regions<float> regions(mesh, model.labels);
        std::array<Leg<float>, 4> legs;
        ASSERT_EQ(regions.walk(way, legs), 3U);
        ASSERT_EQ(legs[0].exit, legs[1].exit) << i;
    }
}

// Two boxes with a wall each in one plane, as a model has them whose volumes were never merged: the flight leaves the
// first box before it comes into the second, whatever the numbers of the walls, also where room is for one leg only.
TYPED_TEST(RegionsTest, leave_one_box_before_the_next_where_walls_coincide) {
    using Scalar = TypeParam;
    for (const bool turned : {false, true}) {
        TriangleSoup<Scalar> soup;
        std::vector<FaceRegions> labels;
        for (int box = 0; box < 2; ++box) {
            const int first = turned ? 1 - box : box;
            append(soup, moved<Scalar>(polycube(1, 1, 1, 1), 1, V<double>(first, 0, 0)));
            labels.resize(soup.triangles.size(), {0, static_cast<std::uint32_t>(first + 1)});
        }
        const CollisionMesh<Scalar> mesh(soup.view());
        const Regions<Scalar> regions(mesh, labels);
        EXPECT_EQ(regions.region_at(V<Scalar>(0.5, 0.25, 0.5)), 1U);
        EXPECT_EQ(regions.region_at(V<Scalar>(1.5, 0.25, 0.5)), 2U);
        const Segment<Scalar> way{V<Scalar>(-1, 0.25, 0.5), V<Scalar>(3, 0.25, 0.5)};
        const std::array<std::uint32_t, 5> expected = {0, 1, 0, 2, 0};
        for (std::size_t room = 1; room <= 5; ++room) {
            std::vector<Leg<Scalar>> legs(room);
            ASSERT_EQ(regions.walk(way, legs), room);
            for (std::size_t i = 0; i < room; ++i) {
                EXPECT_EQ(legs[i].region, expected[i]) << turned << room << i;
                EXPECT_TRUE(legs[i].consistent) << turned << room << i;
            }
        }
    }
}

TYPED_TEST(RegionsTest, agree_with_winding_numbers_of_solids_around_one_another) {
    using Scalar = TypeParam;
    Random random(3);
    RegionModel<Scalar> model;
    std::vector<CollisionMesh<Scalar>> solids;
    for (int i = 0; i < 4; ++i) {
        const TriangleSoup<Scalar> solid = moved<Scalar>(bumpy_sphere(12), 1 - 0.2 * i, V<double>(0, 0, 0));
        append(model.soup, solid);
        model.labels.resize(model.soup.triangles.size(),
                            {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i + 1)});
        solids.emplace_back(solid.view());
    }
    const CollisionMesh<Scalar> mesh(model.soup.view());
    const Regions<Scalar> regions(mesh, model.labels);
    const auto region_by_solids = [&](const V<Scalar>& p) {
        std::uint32_t inside = 0;
        for (const auto& solid : solids) inside += static_cast<std::uint32_t>(solid.winding_number(p));
        return inside;
    };
    std::array<Leg<Scalar>, 256> legs;
    for (int i = 0; i < 3000; ++i) {
        const auto point = [&] {
            if (random.chance(0.3)) return model.soup.positions[random.below(model.soup.positions.size())];
            return (1.2 * random.in_cube()).template cast<Scalar>().eval();
        };
        const Segment<Scalar> way{point(), point()};
        const std::size_t count = regions.walk(way, legs);
        ASSERT_LT(count, legs.size());
        EXPECT_EQ(legs[0].region, region_by_solids(way.from)) << said(way);
        EXPECT_EQ(legs[count - 1].region, region_by_solids(way.to)) << said(way);
        EXPECT_EQ(regions.region_at(way.to), region_by_solids(way.to)) << said(way);
        int sum = 0;
        for (std::size_t j = 0; j + 1 < count; ++j) {
            EXPECT_TRUE(legs[j].consistent);
            sum += legs[j].side == Sides::front ? 1 : -1;
        }
        EXPECT_EQ(sum, mesh.crossings(way)) << said(way);
    }
}

TYPED_TEST(RegionsTest, say_where_labels_do_not_agree_on_the_way) {
    using Scalar = TypeParam;
    RegionModel<Scalar> model = ColouredCubes(2, 1000000, 1, 3).model.as<Scalar>(1, V<double>(0, 0, 0));
    const Segment<Scalar> way{V<Scalar>(-1, 0.25, 0.5), V<Scalar>(3, 0.25, 0.5)};
    const CollisionMesh<Scalar> mesh(model.soup.view());
    std::array<Leg<Scalar>, 8> legs;
    const Regions<Scalar> right(mesh, model.labels);
    ASSERT_EQ(right.walk(way, legs), 4U);
    const std::uint32_t wall = legs[1].face;
    FaceRegions& label = model.labels[wall];
    (legs[1].side == Sides::front ? label.front : label.behind) = 77;
    const Regions<Scalar> wrong(mesh, model.labels);
    const std::uint32_t region = legs[1].region;
    ASSERT_EQ(wrong.walk(way, legs), 4U);
    EXPECT_TRUE(legs[0].consistent);
    EXPECT_FALSE(legs[1].consistent);
    EXPECT_EQ(legs[1].region, region);  // as the face says that was crossed
    EXPECT_TRUE(legs[2].consistent);
}

// A leg of a longer ray along the same way: the face lies beyond the end, which only the ray's limit says. A particle
// that collided before it went through the wall.
TYPED_TEST(RegionsTest, take_legs_of_longer_rays) {
    const TriangleSoup<TypeParam> soup = moved<TypeParam>(bumpy_sphere(4), 1, {0, 0, 0});
    const CollisionMesh<TypeParam> mesh(soup.view());
    const std::vector<FaceRegions> labels(soup.triangles.size(), {0, 1});
    const Regions<TypeParam> regions(mesh, labels);
    Ray<TypeParam> ray{{0, 0, 0}, {1, TypeParam(0.125), TypeParam(0.25)}};
    std::array<Leg<TypeParam>, 1> legs;
    ASSERT_EQ(regions.walk(ray, legs), 1U);
    ASSERT_GT(legs[0].exit, TypeParam(0.75));
    ASSERT_EQ(regions.cross(ray, legs[0]).region, 0U);
    ray.limit = TypeParam(0.75);
    for (const RegionPlace<TypeParam>& place : {regions.cross(ray, legs[0]), regions.stop(ray, legs[0])}) {
        EXPECT_EQ(place.region, 1U);
        EXPECT_EQ(place.point, Vec3<TypeParam>(ray.limit * ray.direction));
    }
}

// A leg of another flight, or kept while the mesh was built anew: its triangle was taken as it was, and read beyond the
// mesh.
TYPED_TEST(RegionsTest, take_legs_of_other_flights_and_meshes) {
    TriangleSoup<TypeParam> soup = moved<TypeParam>(bumpy_sphere(4), 1, {0, 0, 0});
    const auto flat = static_cast<std::uint32_t>(soup.triangles.size());
    add_triangle(soup, Vec3<double>(2, 0, 0), Vec3<double>(3, 0, 0), Vec3<double>(4, 0, 0));
    const CollisionMesh<TypeParam> mesh(soup.view());
    const std::vector<FaceRegions> labels(soup.triangles.size(), {0, 1});
    const Regions<TypeParam> regions(mesh, labels);
    const Segment<TypeParam> flight{{0, 0, 0}, {2, TypeParam(0.125), TypeParam(0.25)}};
    std::array<Leg<TypeParam>, 1> legs;
    ASSERT_EQ(regions.walk(flight, legs), 1U);
    ASSERT_EQ(legs[0].region, 1U);
    ASSERT_EQ(regions.cross(flight, legs[0]).region, 0U);
    for (const std::uint32_t triangle : {legs[0].triangle == 0 ? 1U : 0U, flat, flat + 1, no_face - 1, no_face}) {
        Leg<TypeParam> leg = legs[0];
        leg.triangle = triangle;
        for (const RegionPlace<TypeParam>& place : {regions.cross(flight, leg), regions.stop(flight, leg)}) {
            EXPECT_EQ(place.region, 1U) << triangle;
            EXPECT_EQ(regions.region_at(place.point), 1U) << triangle;
        }
    }
}

TYPED_TEST(RegionsTest, take_any_input) {
    using Scalar = TypeParam;
    const RegionModel<Scalar> model = ColouredCubes(2, 3, 1, 3).model.as<Scalar>(1, V<double>(0, 0, 0));
    CollisionMesh<Scalar> built(model.soup.view());
    EXPECT_THROW(Regions<Scalar>(built, std::span(model.labels).first(3)), std::invalid_argument);
    const Regions<Scalar> regions(built, model.labels, 5);
    const CollisionMesh<Scalar> mesh = std::move(built);  // which the regions don't mind
    const Scalar nan = std::numeric_limits<Scalar>::quiet_NaN();
    std::array<Leg<Scalar>, 4> legs;
    EXPECT_EQ(regions.region_at(V<Scalar>(nan, 0, 0)), 5U);
    EXPECT_EQ(regions.walk(Segment<Scalar>{V<Scalar>(0, 0, 0), V<Scalar>(nan, 0, 0)}, legs), 0U);
    EXPECT_EQ(regions.walk(Ray<Scalar>{V<Scalar>(0, 0, 0), V<Scalar>(1, 0, 0), Scalar(-1)}, legs), 0U);
    EXPECT_EQ(regions.walk(Ray<Scalar>{V<Scalar>(0, 0, 0), V<Scalar>(1, 0, 0)}, {}), 0U);
    for (const Scalar limit : {Scalar(0), Scalar(1e-30), std::numeric_limits<Scalar>::infinity()}) {
        ASSERT_EQ(regions.walk(Ray<Scalar>{V<Scalar>(-1, 9, 0), V<Scalar>(1, 0, 0), limit}, legs), 1U);
        EXPECT_EQ(legs[0].region, 5U);
        EXPECT_EQ(legs[0].exit, limit);
    }
    ASSERT_EQ(regions.walk(Ray<Scalar>{V<Scalar>(0.5, 0.5, 0.5), V<Scalar>(0, 0, 0)}, legs), 1U);
    EXPECT_EQ(legs[0].region, regions.region_at(V<Scalar>(0.5, 0.5, 0.5)));
    const CollisionMesh<Scalar> nothing(MeshView<Scalar>{{}, {}, {}});
    const Regions<Scalar> empty(nothing, {}, 4);
    EXPECT_EQ(empty.region_at(V<Scalar>(0, 0, 0)), 4U);
    ASSERT_EQ(empty.walk(Segment<Scalar>{V<Scalar>(0, 0, 0), V<Scalar>(1, 0, 0)}, legs), 1U);
    EXPECT_EQ(legs[0].region, 4U);
}

template <class Scalar>
class RegionsSoak : public ::testing::Test {};
TYPED_TEST_SUITE(RegionsSoak, Scalars, );

TYPED_TEST(RegionsSoak, walk_as_the_judge_says) { EXPECT_GT(judge_many<TypeParam>(10000, 15), 400000U); }

}  // namespace
}  // namespace pierce::test
