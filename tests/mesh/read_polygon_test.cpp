// Cutting polygons made by hand: convex, concave, touching themselves, impossible, and large.
#include <cmath>
#include <random>
#include <set>

#include "read_test_lattice.h"
#include "read_test_support.h"

namespace pierce {
namespace {

using test::cut;
using test::faults;
using test::Faults;
using test::LatticePoint;
using test::LatticePolygon;

void expect_cut(const LatticePolygon& polygon, const char* name) {
    LatticePolygon turned(polygon.rbegin(), polygon.rend());
    for (const LatticePolygon& either : {polygon, turned}) {
        for (std::size_t start = 0; start < std::min<std::size_t>(either.size(), 12); ++start) {
            LatticePolygon rotated = either;
            std::rotate(rotated.begin(), rotated.begin() + static_cast<std::ptrdiff_t>(start), rotated.end());
            for (int axis = 0; axis < 3; ++axis) {
                const Faults found = faults(rotated, axis, 0.5, -0.25);
                EXPECT_EQ(found.reversed, 0U) << name;
                EXPECT_EQ(found.straight, 0U) << name;
            }
        }
    }
}

TEST(ReadPolygon, CutsShapesByHand) {
    expect_cut({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, "square");
    expect_cut({{0, 0}, {4, 0}, {1, 1}, {0, 4}}, "concave quad");
    expect_cut({{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 1}, {1, 1}, {1, 4}, {0, 4}}, "U");
    expect_cut({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, "L");
    expect_cut({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}},
               "square with the middles of its edges");
    expect_cut({{0, 0}, {6, 0}, {6, 6}, {5, 1}, {4, 6}, {3, 1}, {2, 6}, {1, 1}, {0, 6}},
               "teeth whose gaps end on one line");
    expect_cut({{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 2}, {7, 2}, {7, 7}, {2, 7}, {2, 4}, {5, 4},
                {5, 5}, {3, 5}, {3, 6}, {6, 6}, {6, 3}, {1, 3}, {1, 8}, {8, 8}, {8, 1}, {0, 1}},
               "spiral");
}

TEST(ReadPolygon, CutsOutlinesThatTouchThemselves) {
    // A spike reaches the opposite edge from inside: a triangle that goes by corners strictly inside would cross it.
    EXPECT_EQ(faults({{0, 0}, {10, 0}, {10, 10}, {6, 10}, {5, 0}, {4, 10}, {0, 10}}).reversed, 0U);
    // With every corner twice no corner turns, until those on a line with their neighbours are cut off.
    LatticePolygon twice;
    for (const LatticePoint& point : LatticePolygon{{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 1}, {1, 1}, {1, 4}, {0, 4}}) {
        twice.insert(twice.end(), 2, point);
    }
    for (std::size_t start = 0; start < twice.size(); ++start) {
        std::rotate(twice.begin(), twice.begin() + 1, twice.end());
        EXPECT_EQ(faults(twice).reversed, 0U);
    }
}

TEST(ReadPolygon, KeepsTheFanOfAConvexPolygon) {
    const auto mesh = test::read("obj", "v 0 0 0\nv 2 0 0\nv 3 1 0\nv 2 2 0\nv 0 2 0\nf 2 3 4 5 1\n");
    EXPECT_EQ(mesh.triangles, (std::vector<IndexTriple>{{1, 2, 3}, {1, 3, 4}, {1, 4, 0}}));
}

TEST(ReadPolygon, CutsTheShorterWayThroughAConcaveQuad) {
    const auto mesh = test::read<float>("obj", "v 0 0 7\nv 4 0 7\nv 1 1 7\nv 0 4 7\nf 2 3 4 1\nf 1 4 3 2\n");
    for (const IndexTriple& triangle : mesh.triangles) {  // both halves meet at the reflex corner and the one opposite
        EXPECT_TRUE(std::count(triangle.begin(), triangle.end(), 0U) == 1 &&
                    std::count(triangle.begin(), triangle.end(), 2U) == 1);
    }
    EXPECT_EQ(mesh.faces, (std::vector<std::uint32_t>{0, 0, 1, 1}));
}

TEST(ReadPolygon, CutsAtEveryScale) {
    for (const double scale : {1e-310, 1e-200, 1e-30, 1e30, 1e200, 1e307}) {
        std::vector<Vec3<double>> positions = {{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}};
        for (auto& position : positions) {
            position *= scale;
        }
        std::rotate(positions.begin(), positions.begin() + 1, positions.end());
        const std::vector<IndexTriple> triangles = cut(positions);
        for (const IndexTriple& triangle : triangles) {  // the reflex corner is now at 1, the one opposite at 3
            EXPECT_TRUE(std::count(triangle.begin(), triangle.end(), 1U) == 1 &&
                        std::count(triangle.begin(), triangle.end(), 3U) == 1)
                << scale;
        }
    }
}

TEST(ReadPolygon, CutsPolygonsThatCanNotBeCut) {
    const std::vector<std::vector<Vec3<float>>> polygons = {
        {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}},                                              // bow tie: no area
        {{0, 0, 0}, {3, 3, 0}, {3, 0, 0}, {0, 2, 0}},                                              // bow tie
        {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}},                                   // a point
        {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}, {3, 3, 3}},                                   // a line
        {{0, 3, 0}, {2, -3, 0}, {-3, 1, 0}, {3, 1, 0}, {-2, -3, 0}},                               // pentagram
        {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 0}, {0, 1, 0}},                        // repeated corners
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},  // twice around
        {{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 0, 0}}};                                  // with a spike
    for (const auto& polygon : polygons) {
        const auto triangles = cut(polygon);
        EXPECT_EQ(triangles.size(), polygon.size() - 2);
        std::set<std::uint32_t> used;
        for (const IndexTriple& triangle : triangles) {
            used.insert(triangle.begin(), triangle.end());
        }
        EXPECT_EQ(used.size(), polygon.size()) << "every corner is kept";
        EXPECT_LT(*used.rbegin(), polygon.size());
    }
}

// A wrong bound here would show as a test that takes minutes.
TEST(ReadPolygon, CutsLargePolygons) {
    const int n = 100000;
    std::mt19937 random(5);
    LatticePolygon comb, star, circle, hedgehog;
    for (int i = 0; i < n / 2; ++i) {  // teeth upwards, then back along the bottom
        comb.push_back({2 * i, i % 2 == 0 ? 10 : 100000});
    }
    for (int i = n / 2; i-- > 0;) {
        comb.push_back({2 * i, 0});
    }
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * 3.141592653589793 * i / n;
        const double radius = i % 2 == 0 ? 1e9 : 5e8;
        star.push_back({std::llround(radius * std::cos(angle)), std::llround(radius * std::sin(angle))});
        circle.push_back({std::llround(1e9 * std::cos(angle)), std::llround(1e9 * std::sin(angle))});
        const double random_radius = 5e8 + static_cast<double>(random() % 500000000);
        hedgehog.push_back(
            {std::llround(random_radius * std::cos(angle)), std::llround(random_radius * std::sin(angle))});
    }
    for (const LatticePolygon& polygon : {comb, star, circle, hedgehog}) {
        EXPECT_EQ(faults(polygon).reversed, 0U);
    }
}

}  // namespace
}  // namespace pierce
