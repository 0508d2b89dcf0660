// Cutting random polygons: without crossings, with holes, and as thin as needles.
#include <random>
#include <tuple>

#include "mesh/read_orient2d.h"
#include "read_test_lattice.h"

namespace pierce {
namespace {

using test::faults;
using test::Faults;
using test::LatticePoint;
using test::LatticePolygon;
using test::turn;
using test::twice_area;

bool segments_meet(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d) {
    const auto sign = [](std::int64_t x) { return x > 0 ? 1 : x < 0 ? -1 : 0; };
    const auto between = [](const LatticePoint& p, const LatticePoint& q, const LatticePoint& x) {
        return turn(p, q, x) == 0 && std::min(p[0], q[0]) <= x[0] && x[0] <= std::max(p[0], q[0]) &&
               std::min(p[1], q[1]) <= x[1] && x[1] <= std::max(p[1], q[1]);
    };
    return (sign(turn(a, b, c)) * sign(turn(a, b, d)) < 0 && sign(turn(c, d, a)) * sign(turn(c, d, b)) < 0) ||
           between(a, b, c) || between(a, b, d) || between(c, d, a) || between(c, d, b);
}

/// Points of a small lattice, so that many are on one line, in an order without crossings: two edges that meet are
/// turned around until none do. Empty if that leads nowhere, or two points are equal.
LatticePolygon random_simple_polygon(std::mt19937& random, std::size_t corners, std::int64_t side) {
    LatticePolygon p;
    while (p.size() < corners) {
        const LatticePoint point = {static_cast<std::int64_t>(random()) % side,
                                    static_cast<std::int64_t>(random()) % side};
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
                    const auto& [a, b, c] =
                        next(i) == j ? std::tie(p[i], p[j], p[next(j)]) : std::tie(p[j], p[i], p[next(i)]);
                    met = turn(a, b, c) == 0 && (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]) < 0;
                } else {
                    met = segments_meet(p[i], p[next(i)], p[j], p[next(j)]);
                }
                if (met) {
                    std::reverse(p.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                 p.begin() + static_cast<std::ptrdiff_t>(j) + 1);
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

// A face with a hole is written as one polygon that runs along a bridge to the hole, around it, and back. Its outline
// touches itself, so that triangles without area may be needed; none may be reversed.
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
        // From the corner at 0 to the hole's corner that is nearest to it in the order of x + y, then x: nothing is
        // between.
        std::rotate(hole.begin(),
                    std::min_element(hole.begin(), hole.end(),
                                     [](const auto& a, const auto& b) {
                                         return std::array{a[0] + a[1], a[0]} < std::array{b[0] + b[1], b[0]};
                                     }),
                    hole.end());
        LatticePolygon polygon = {outer[0]};
        polygon.insert(polygon.end(), hole.begin(), hole.end());
        polygon.push_back(hole[0]);
        polygon.insert(polygon.end(), outer.begin(), outer.end());
        std::rotate(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(random() % polygon.size()),
                    polygon.end());
        EXPECT_EQ(faults(polygon).reversed, 0U) << i;
    }
}

/// Two directions of about 2^28 that enclose a parallelogram of area 1 or -1: too little to be seen in rounded
/// products.
std::array<LatticePoint, 2> nearly_parallel(std::mt19937& random) {
    LatticePoint one = {1, 0};
    LatticePoint other = {0, 1};
    while (one[0] + one[1] < (1 << 27)) {  // by adding multiples to each other, which leaves the area as it is
        const auto times = 1 + static_cast<std::int64_t>(random() % 3);
        one = {one[0] + times * other[0], one[1] + times * other[1]};
        std::swap(one, other);
    }
    return {one, other};
}

TEST(ReadPolygon, TheExactTurnIsThatOfIntegers) {
    std::mt19937 random(3);
    for (int i = 0; i < 20000; ++i) {
        const auto [one, other] = nearly_parallel(random);
        const LatticePoint c = {static_cast<std::int64_t>(random() >> 2), static_cast<std::int64_t>(random() >> 2)};
        const LatticePoint a = {c[0] + one[0], c[1] + one[1]};
        const LatticePoint b = {c[0] + other[0], c[1] + other[1]};
        const LatticePoint on_line = {c[0] + 2 * one[0], c[1] + 2 * one[1]};
        const auto point = [](const LatticePoint& p) {
            return detail::Point2{static_cast<double>(p[0]), static_cast<double>(p[1])};
        };
        ASSERT_EQ(std::abs(turn(a, b, c)), 1);
        ASSERT_EQ(detail::orient2d(point(a), point(b), point(c)), turn(a, b, c));
        ASSERT_EQ(detail::orient2d_exact(point(a), point(b), point(c)), turn(a, b, c));
        ASSERT_EQ(detail::orient2d(point(a), point(on_line), point(c)), 0);
    }
}

// Kettner, Mehlhorn, Pion, Schirra, Yap 2008, "Classroom Examples of Robustness Problems in Geometric Computations":
// points next to (0.5, 0.5) against the line through (12, 12) and (24, 24). Here the differences of coordinates are
// rounded too.
TEST(ReadPolygon, TheExactTurnIsRightNextToADiagonal) {
    constexpr double step = 0x1p-53;
    const detail::Point2 q = {12, 12};
    const detail::Point2 r = {24, 24};
    for (int x = 0; x < 64; ++x) {
        for (int y = 0; y < 64; ++y) {
            const detail::Point2 p = {0.5 + x * step, 0.5 + y * step};
            const int left = (p[1] > p[0] ? 1 : 0) - (p[1] < p[0] ? 1 : 0);
            ASSERT_EQ(detail::orient2d(p, q, r), left);
            ASSERT_EQ(detail::orient2d(q, r, p), left);
            ASSERT_EQ(detail::orient2d(r, p, q), left);
            ASSERT_EQ(detail::orient2d(q, p, r), -left);
        }
    }
}

TEST(ReadPolygon, CutsNeedlesThatRoundingWouldTurn) {
    std::mt19937 random(4);
    for (int i = 0; i < 2000; ++i) {
        const auto [one, other] = nearly_parallel(random);
        const LatticePoint end = {one[0] + other[0], one[1] + other[1]};
        LatticePolygon polygon = {{0, 0}, one, end, other};
        if (i % 2 == 0) {  // with a reflex corner, at end
            polygon = {{0, 0}, {end[0] + one[0], end[1] + one[1]}, end, {end[0] + other[0], end[1] + other[1]}};
        }
        std::rotate(polygon.begin(), polygon.begin() + i / 2 % 4, polygon.end());
        const Faults fault = faults(polygon);
        ASSERT_EQ(fault.reversed + fault.straight, 0U) << i;
    }
}

}  // namespace
}  // namespace pierce
