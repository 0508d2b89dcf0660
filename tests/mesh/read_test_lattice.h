// Polygons with integer corners, whose cuts can be checked exactly.
//
// The proof of a correct cut is the same for all: triangles that have the outline of the polygon and all turn the same
// way as it does cover it once, because at each point as many of them lie as the outline winds around it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "mesh/read_polygon.h"

namespace pierce::test {

using LatticePoint = std::array<std::int64_t, 2>;
using LatticePolygon = std::vector<LatticePoint>;

inline std::int64_t turn(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
    return (a[0] - c[0]) * (b[1] - c[1]) - (a[1] - c[1]) * (b[0] - c[0]);
}

inline std::int64_t twice_area(const LatticePolygon& polygon) {
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

/// Cuts a polygon, put on a plane that leans towards the given axis by the given shears, and counts the triangles that
/// turn against it, or do not turn.
struct Faults {
    std::size_t reversed = 0;
    std::size_t straight = 0;
};
inline Faults faults(const LatticePolygon& polygon, int axis = 2, double lean_x = 0, double lean_y = 0) {
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

}  // namespace pierce::test
