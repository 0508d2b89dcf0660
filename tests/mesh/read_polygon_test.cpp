// Cutting polygons. The proof of a correct cut is the same for all: triangles that have the outline of the polygon and all turn
// the same way as it does cover it once, because at each point as many of them lie as the outline winds around it.
#include "read_test_support.h"

#include <cstdint>
#include <numeric>
#include <random>
#include <set>

#include "mesh/read_polygon.h"

namespace pierce {
namespace {

using LatticePoint = std::array<std::int64_t, 2>;
using LatticePolygon = std::vector<LatticePoint>;

std::int64_t turn(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
    return (a[0] - c[0]) * (b[1] - c[1]) - (a[1] - c[1]) * (b[0] - c[0]);
}

std::int64_t twice_area(const LatticePolygon& polygon) {
    std::int64_t area = 0;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        area += turn(polygon[0], polygon[i - 1], polygon[i]);
    }
    return area;
}

/// The triangles into which a polygon of these positions, in this order, is cut.
template <class Scalar>
std::vector<IndexTriple> cut(const std::vector<Vec3<Scalar>>& positions) {
    std::vector<IndexTriple> triangles;
    for (std::uint32_t i = 2; i < positions.size(); ++i) {
        triangles.push_back({0, i - 1, i});
    }
    detail::PolygonCutter<Scalar>(positions).cut(triangles);
    return triangles;
}

/// Cuts a polygon, put on a plane that leans towards the given axis by the given shears, and counts the triangles that turn
/// against it, or do not turn.
struct Faults {
    std::size_t reversed = 0;
    std::size_t straight = 0;
};
Faults faults(const LatticePolygon& polygon, int axis = 2, double lean_x = 0, double lean_y = 0) {
    std::vector<Vec3<double>> positions;
    for (const LatticePoint& point : polygon) {
        const auto x = static_cast<double>(point[0]);
        const auto y = static_cast<double>(point[1]);
        Vec3<double> position;
        position[(axis + 1) % 3] = x;
        position[(axis + 2) % 3] = y;
        position[axis] = lean_x * x + lean_y * y;
        positions.push_back(position);
    }
    const std::vector<IndexTriple> triangles = cut(positions);
    EXPECT_EQ(triangles.size(), polygon.size() - 2);
    const std::int64_t area = twice_area(polygon);
    std::int64_t sum = 0;
    std::set<std::array<std::uint32_t, 2>> edges;
    Faults found;
    for (const auto& [a, b, c] : triangles) {
        const std::int64_t turned = turn(polygon[a], polygon[b], polygon[c]);
        sum += turned;
        found.straight += turned == 0 ? 1U : 0U;
        found.reversed += (turned < 0) == (area > 0) && turned != 0 ? 1U : 0U;
        for (const auto& edge : {std::array{a, b}, std::array{b, c}, std::array{c, a}}) {
            EXPECT_TRUE(edges.insert(edge).second) << "an edge is used twice in one direction";
        }
    }
    EXPECT_EQ(sum, area);
    // Every edge of the polygon is there once; every other edge has a partner that runs the other way.
    for (const auto& [from, to] : edges) {
        const bool outer = to == (from + 1) % polygon.size();
        EXPECT_NE(edges.contains({to, from}), outer) << from << " " << to;
    }
    return found;
}

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
    expect_cut({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}, "square with the middles of its edges");
    expect_cut({{0, 0}, {6, 0}, {6, 6}, {5, 1}, {4, 6}, {3, 1}, {2, 6}, {1, 1}, {0, 6}}, "teeth whose gaps end on one line");
    expect_cut({{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 2}, {7, 2}, {7, 7}, {2, 7}, {2, 4}, {5, 4}, {5, 5}, {3, 5}, {3, 6},
                {6, 6}, {6, 3}, {1, 3}, {1, 8}, {8, 8}, {8, 1}, {0, 1}}, "spiral");
}

TEST(ReadPolygon, KeepsTheFanOfAConvexPolygon) {
    const auto mesh = test::read("obj", "v 0 0 0\nv 2 0 0\nv 3 1 0\nv 2 2 0\nv 0 2 0\nf 2 3 4 5 1\n");
    EXPECT_EQ(mesh.triangles, (std::vector<IndexTriple>{{1, 2, 3}, {1, 3, 4}, {1, 4, 0}}));
}

TEST(ReadPolygon, CutsTheShorterWayThroughAConcaveQuad) {
    const auto mesh = test::read<float>("obj", "v 0 0 7\nv 4 0 7\nv 1 1 7\nv 0 4 7\nf 2 3 4 1\nf 1 4 3 2\n");
    for (const IndexTriple& triangle : mesh.triangles) {  // both halves meet at the reflex corner and the one opposite
        EXPECT_TRUE(std::count(triangle.begin(), triangle.end(), 0U) == 1 && std::count(triangle.begin(), triangle.end(), 2U) == 1);
    }
    EXPECT_EQ(mesh.faces, (std::vector<std::uint32_t>{0, 0, 1, 1}));
}

bool segments_meet(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d) {
    const auto sign = [](std::int64_t x) { return x > 0 ? 1 : x < 0 ? -1 : 0; };
    const auto between = [](const LatticePoint& p, const LatticePoint& q, const LatticePoint& x) {
        return turn(p, q, x) == 0 && std::min(p[0], q[0]) <= x[0] && x[0] <= std::max(p[0], q[0]) &&
               std::min(p[1], q[1]) <= x[1] && x[1] <= std::max(p[1], q[1]);
    };
    return (sign(turn(a, b, c)) * sign(turn(a, b, d)) < 0 && sign(turn(c, d, a)) * sign(turn(c, d, b)) < 0) ||
           between(a, b, c) || between(a, b, d) || between(c, d, a) || between(c, d, b);
}

/// Points of a small lattice, so that many are on one line, in an order without crossings: two edges that meet are turned
/// around until none do. Empty if that leads nowhere, or two points are equal.
LatticePolygon random_simple_polygon(std::mt19937& random, std::size_t corners, std::int64_t side) {
    LatticePolygon p;
    while (p.size() < corners) {
        const LatticePoint point = {static_cast<std::int64_t>(random()) % side, static_cast<std::int64_t>(random()) % side};
        if (std::find(p.begin(), p.end(), point) == p.end()) {
            p.push_back(point);
        }
    }
    const auto next = [&](std::size_t i) { return (i + 1) % corners; };
    for (std::size_t tries = 0; tries < 200 * corners; ++tries) {
        bool met = false;
        for (std::size_t i = 0; i < corners && !met; ++i) {
            for (std::size_t j = i + 1; j < corners && !met; ++j) {
                const bool neighbours = next(i) == j || next(j) == i;
                if (neighbours) {
                    const auto& [a, b, c] = next(i) == j ? std::tie(p[i], p[j], p[next(j)]) : std::tie(p[j], p[i], p[next(i)]);
                    met = turn(a, b, c) == 0 && (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]) < 0;
                } else {
                    met = segments_meet(p[i], p[next(i)], p[j], p[next(j)]);
                }
                if (met) {
                    std::reverse(p.begin() + static_cast<std::ptrdiff_t>(i) + 1, p.begin() + static_cast<std::ptrdiff_t>(j) + 1);
                    if (neighbours || tries % 16 == 15) {
                        std::swap(p[random() % corners], p[random() % corners]);
                    }
                }
            }
        }
        if (!met) {
            return p;
        }
    }
    return {};
}

TEST(ReadPolygon, CutsRandomSimplePolygons) {
    std::mt19937 random(20240501);
    std::size_t found = 0;
    for (int i = 0; i < 3000; ++i) {
        const std::size_t corners = 4 + random() % 21;
        const std::int64_t side = 5 + static_cast<std::int64_t>(random()) % 20;
        const LatticePolygon polygon = random_simple_polygon(random, corners, side);
        if (!polygon.empty()) {
            ++found;
            const Faults fault = faults(polygon, i % 3, 0.125 * (i % 7), 0.125);
            ASSERT_EQ(fault.reversed + fault.straight, 0U) << i;
        }
    }
    EXPECT_GT(found, 2000U);
}

// A face with a hole is written as one polygon that runs along a bridge to the hole, around it, and back. Its outline touches
// itself, so that triangles without area may be needed; none may be reversed.
TEST(ReadPolygon, CutsKeyholes) {
    std::mt19937 random(7);
    for (int i = 0; i < 500; ++i) {
        const LatticePolygon outer = {{0, 0}, {40, 0}, {40, 40}, {0, 40}};
        LatticePolygon hole = random_simple_polygon(random, 3 + random() % 8, 20);
        if (hole.empty()) {
            continue;
        }
        if (twice_area(hole) > 0) {
            std::reverse(hole.begin(), hole.end());
        }
        for (LatticePoint& point : hole) {
            point = {point[0] + 10, point[1] + 10};
        }
        // From the corner at 0 to the hole's corner that is nearest to it in the order of x + y, then x: nothing is between.
        std::rotate(hole.begin(), std::min_element(hole.begin(), hole.end(), [](const auto& a, const auto& b) {
            return std::array{a[0] + a[1], a[0]} < std::array{b[0] + b[1], b[0]};
        }), hole.end());
        LatticePolygon polygon = {outer[0]};
        polygon.insert(polygon.end(), hole.begin(), hole.end());
        polygon.push_back(hole[0]);
        polygon.insert(polygon.end(), outer.begin(), outer.end());
        std::rotate(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(random() % polygon.size()), polygon.end());
        EXPECT_EQ(faults(polygon).reversed, 0U) << i;
    }
}

TEST(ReadPolygon, CutsNeedlesThatRoundingWouldTurn) {
    // The third corner is on the left of the line from the first to the last by less than a rounding error of the products.
    const double e = 0x1p-52;
    std::vector<Vec3<double>> positions = {{1, 1, 0}, {3, 3, 0}, {2 + 2 * e, 2 + 4 * e, 0}, {0.5, 0.5 + e, 0}};
    for (int start = 0; start < 4; ++start) {
        std::rotate(positions.begin(), positions.begin() + 1, positions.end());
        for (const auto& [a, b, c] : cut(positions)) {
            const auto flat = [&](std::uint32_t i) { return detail::Point2{positions[i][0], positions[i][1]}; };
            EXPECT_GT(detail::orient2d_exact(flat(a), flat(b), flat(c)), 0);
        }
    }
}

TEST(ReadPolygon, TheExactTurnIsThatOfIntegers) {
    std::mt19937_64 random(3);
    for (int i = 0; i < 20000; ++i) {
        std::array<LatticePoint, 3> lattice;
        std::array<detail::Point2, 3> points;
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t axis = 0; axis < 2; ++axis) {
                // The third point close to the line of the others, far from the origin.
                const auto far = static_cast<std::int64_t>(random() % (1ULL << 30));
                lattice[k][axis] = k < 2 ? far : (lattice[0][axis] + lattice[1][axis]) / 2 + static_cast<std::int64_t>(random() % 3) - 1;
                points[k][axis] = static_cast<double>(lattice[k][axis]);
            }
        }
        const std::int64_t exact = turn(lattice[0], lattice[1], lattice[2]);
        const int sign = exact > 0 ? 1 : exact < 0 ? -1 : 0;
        ASSERT_EQ(detail::orient2d(points[0], points[1], points[2]), sign);
        ASSERT_EQ(detail::orient2d_exact(points[0], points[1], points[2]), sign);
    }
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
            EXPECT_TRUE(std::count(triangle.begin(), triangle.end(), 1U) == 1 && std::count(triangle.begin(), triangle.end(), 3U) == 1)
                << scale;
        }
    }
}

TEST(ReadPolygon, CutsPolygonsThatCanNotBeCut) {
    const std::vector<std::vector<Vec3<float>>> polygons = {
        {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}},                                     // bow tie: no area
        {{0, 0, 0}, {3, 3, 0}, {3, 0, 0}, {0, 2, 0}},                                     // bow tie
        {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}},                          // a point
        {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}, {3, 3, 3}},                          // a line
        {{0, 3, 0}, {2, -3, 0}, {-3, 1, 0}, {3, 1, 0}, {-2, -3, 0}},                      // pentagram
        {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 0}, {0, 1, 0}},               // repeated corners
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},  // twice around
        {{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 0, 0}}};                         // with a spike
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
    LatticePolygon comb, star, circle;
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
    }
    for (const LatticePolygon& polygon : {comb, star, circle}) {
        EXPECT_EQ(faults(polygon).reversed, 0U);
    }
}

}  // namespace
}  // namespace pierce
