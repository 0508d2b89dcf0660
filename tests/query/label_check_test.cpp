// Whether labels agree is found out, and where they do not.
#include <numeric>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <pierce/pierce.h>
#include <support/region_models.h>

namespace pierce::test {
namespace {

template <class Scalar>
LabelReport check(const RegionModel<Scalar>& model, std::uint32_t outside = 0) {
    const CollisionMesh<Scalar> mesh(model.soup.view());
    return Regions<Scalar>(mesh, model.labels, outside).check();
}

template <class Scalar>
class LabelCheck : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(LabelCheck, Scalars, );

TYPED_TEST(LabelCheck, finds_nothing_in_models_that_agree) {
    for (const double offset : {0.0, 1000.0}) {
        const Vec3<double> shift(offset, 2 * offset, -offset);
        for (std::uint64_t seed = 0; seed < 5; ++seed) {
            const auto cubes = ColouredCubes(5, 4, 1, seed).model.as<TypeParam>(1, shift);
            EXPECT_EQ(check(cubes).to_string(), "the labels agree: each point has one region\n");
            EXPECT_TRUE(check(RegionModel<TypeParam>{apart(cubes.soup), cubes.labels}).agree());
        }
        EXPECT_TRUE(check(nested_model(6, 3).as<TypeParam>(1, shift)).agree());
    }
    EXPECT_TRUE(check(RegionModel<TypeParam>{}, 7).agree());
}

TYPED_TEST(LabelCheck, names_a_face_whose_label_is_wrong) {
    const auto right = nested_model(4, 3).as<TypeParam>(1, Vec3<double>(0, 0, 0));
    Random random(8);
    for (int i = 0; i < 40; ++i) {
        auto model = right;
        const auto face = static_cast<std::uint32_t>(random.below(model.labels.size()));
        FaceRegions& label = model.labels[face];
        (random.chance(0.5) ? label.front : label.behind) = 99;
        const LabelReport report = check(model);
        EXPECT_EQ(report.edges, 3U);
        ASSERT_EQ(report.edge_list.size(), 3U);
        for (const auto& where : report.edge_list) {
            EXPECT_TRUE(where.faces[0] == face || where.faces[1] == face);
            EXPECT_TRUE(where.regions[0] == 99 || where.regions[1] == 99);
        }
        EXPECT_FALSE(report.agree());
    }
}

TYPED_TEST(LabelCheck, asks_for_one_region_around_a_border) {
    RegionModel<TypeParam> model;
    add_triangle(model.soup, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    model.labels = {{0, 1}};
    EXPECT_EQ(check(model).edges, 3U);
    model.labels = {{0, 0}};  // a sheet within one region
    EXPECT_TRUE(check(model).agree());
    EXPECT_EQ(check(model, 4).floating, 1U);
}

TYPED_TEST(LabelCheck, finds_a_part_that_lies_in_another_region_than_it_says) {
    const auto box = [](double size, std::uint32_t front, std::uint32_t behind) {
        RegionModel<TypeParam> model;
        model.soup = moved<TypeParam>(polycube(1, 1, 1, 1), size, Vec3<double>(-size / 2, -size / 2, -size / 2));
        model.labels.resize(model.soup.triangles.size(), {front, behind});
        return model;
    };
    auto model = box(4, 0, 1);
    model.add(box(2, 1, 2));
    model.add(box(1, 2, 3));
    EXPECT_TRUE(check(model).agree()) << check(model).to_string();
    for (FaceRegions& label : std::span(model.labels).subspan(12, 12)) label.front = 5;
    const LabelReport report = check(model);
    EXPECT_EQ(report.edges, 0U);
    EXPECT_EQ(report.floating, 1U);
    ASSERT_EQ(report.floating_list.size(), 1U);
    EXPECT_EQ(report.floating_list[0].regions, (std::array{5U, 1U}));
    EXPECT_EQ(report.to_string().substr(0, 2), "1 ");
    EXPECT_EQ(check(box(4, 0, 1), 9).floating, 1U);
}

// Two boxes whose walls lie in one plane, face upon face, as where volumes were never merged: they agree if one leaves
// room, of no thickness, for what is around both.
TYPED_TEST(LabelCheck, takes_any_order_of_faces_that_coincide) {
    RegionModel<TypeParam> model;
    const auto add_box = [&model](double x, std::uint32_t region) {
        append(model.soup, moved<TypeParam>(polycube(1, 1, 1, 1), 1, Vec3<double>(x, 0, 0)));
        model.labels.resize(model.soup.triangles.size(), {0, region});
    };
    add_box(0, 1);
    add_box(1, 2);
    EXPECT_TRUE(check(model).agree()) << check(model).to_string();
    add_box(0, 3);  // one box in another
    EXPECT_FALSE(check(model).agree());
}

// Up to twelve faces around an edge in any direction, some in one plane on either side of it, with the regions between
// them numbered by their true order.
TYPED_TEST(LabelCheck, knows_the_order_around_an_edge) {
    Random random(4);
    for (int round = 0; round < 300; ++round) {
        std::set<std::array<int, 2>> taken;
        std::vector<std::array<int, 2>> apex;
        const std::size_t count = 3 + random.below(10);
        while (apex.size() < count) {
            const std::array<int, 2> p = {random.between_ints(-4, 4), random.between_ints(-4, 4)};
            const int g = std::gcd(p[0], p[1]);
            if (g == 0 || !taken.insert({p[0] / g, p[1] / g}).second) continue;
            apex.push_back(p);
        }
        const auto upper = [](const std::array<int, 2>& p) { return p[1] > 0 || (p[1] == 0 && p[0] > 0); };
        std::sort(apex.begin(), apex.end(), [&](const auto& x, const auto& y) {
            if (upper(x) != upper(y)) return upper(x);
            return x[0] * y[1] - x[1] * y[0] > 0;
        });
        Eigen::Matrix3d map;
        do {
            for (int i = 0; i < 9; ++i) map.data()[i] = random.between_ints(-5, 5);
        } while (map.col(0).dot(map.col(1).cross(map.col(2))) <= 0.5);
        const double scale = std::ldexp(1.0, random.between_ints(-100, 100));
        const auto at = [&](int x, int y, int z) { return (scale * (map * Vec3<double>(x, y, z))).eval(); };
        RegionModel<TypeParam> model;
        for (std::size_t i = 0; i < count; ++i) {
            const auto before = static_cast<std::uint32_t>(i);
            const auto after = static_cast<std::uint32_t>((i + 1) % count);
            const Vec3<double> p = at(apex[i][0], apex[i][1], random.between_ints(-3, 3));
            if (random.chance(0.5)) {
                add_triangle(model.soup, at(0, 0, 0), at(0, 0, 1), p);
                model.labels.push_back({after, before});
            } else {
                add_triangle(model.soup, at(0, 0, 1), at(0, 0, 0), p);
                model.labels.push_back({before, after});
            }
        }
        // Each face has two borders, where it disagrees with itself.
        EXPECT_EQ(check(model).edges, 2 * count);
        std::swap(model.labels[0], model.labels[1 + random.below(count - 1)]);
        EXPECT_EQ(check(model).edges, 2 * count + 1);
    }
}

}  // namespace
}  // namespace pierce::test
