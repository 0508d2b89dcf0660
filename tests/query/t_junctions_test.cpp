// T-junctions are found at every size of coordinates, within rounding of the edge and not beyond, wherever the grid's
// cells begin.
#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/meshes.h>

namespace pierce::test {
namespace {

using V = Vec3<double>;

// Above the edge from a to b one triangle; below it two, which meet at m. Each with vertices of its own.
TriangleSoup<double> seam(const V& a, const V& m, const V& b, const V& up) {
    TriangleSoup<double> soup;
    add_triangle(soup, a, b, a + up);
    add_triangle(soup, m, a, m - up);
    add_triangle(soup, b, m, m - up);
    return soup;
}

template <class Scalar>
std::size_t t_junctions(const TriangleSoup<double>& soup) {
    return CollisionMesh<Scalar>(moved<Scalar>(soup, 1, V(0, 0, 0)).view()).mesh_report().t_junctions;
}

// A vertex exactly in the middle of an edge, on a lattice of `unit`: among denormal doubles the allowance for rounding
// underflowed to zero, lengths were divided by it, and no T-junction was found below 1e-307.
template <class Scalar>
void exact_at_all_sizes(std::initializer_list<double> units) {
    for (const double unit : units) {
        const auto at = [&](int x, int y, int z) -> V { return {x * unit, y * unit, z * unit}; };
        EXPECT_EQ(t_junctions<Scalar>(seam(at(0, 0, 0), at(2, 0, 0), at(4, 0, 0), at(0, 4, 0))), 1U) << unit;
        EXPECT_EQ(t_junctions<Scalar>(seam(at(-3, 1, 2), at(-1, 0, 2), at(3, -2, 2), at(0, 1, 2))), 1U) << unit;
        // The next point of the lattice lies beside it, and one beyond the end on its line only.
        EXPECT_EQ(t_junctions<Scalar>(seam(at(0, 0, 0), at(2, 1, 0), at(4, 0, 0), at(0, 4, 0))), 0U) << unit;
        EXPECT_EQ(t_junctions<Scalar>(seam(at(0, 0, 0), at(0, 0, 1), at(4, 0, 0), at(0, 4, 0))), 0U) << unit;
    }
}

TEST(TJunctions, are_found_at_every_size) {
    exact_at_all_sizes<float>({1, 1e30, 1e-37, 0x1p-126, 0x1p-140, 0x1p-149, 0x1p125});
    exact_at_all_sizes<double>({1, 1e300, 1e-300, 1e-307, 0x1p-1022, 1e-308, 1e-310, 0x1p-1074, 0x1p1021});
}

TEST(TJunctions, are_found_on_edges_far_shorter_than_their_coordinates_and_far_thinner) {
    const double tiny = std::numeric_limits<double>::denorm_min();
    EXPECT_EQ(t_junctions<double>(seam(V(1, 0, 0), V(1, tiny, 0), V(1, 2 * tiny, 0), V(1, 0, 0))), 1U);
    EXPECT_EQ(t_junctions<double>(seam(V(1, 0, 0), V(1, 1e-300, 0), V(1, 3e-300, 0), V(0, 0, 1))), 1U);
    EXPECT_EQ(t_junctions<double>(seam(V(1e308, 0, 0), V(1e308, 1e300, 0), V(1e308, 3e300, 0), V(0, 0, 1e300))), 1U);
}

// 2^-23 in float and 2^-52 in double times the largest coordinate, four times: what a point that was put on the edge
// and rounded stays within. (Measured over 20 million: half of it. The distance once was taken from the foot on the
// edge, which errs by up to 5.4 units in double: now and then one in the middle of a long edge was missed.)
template <class Scalar>
void rounded_ones(double near, double far) {
    Random random(4);
    const double step = std::numeric_limits<Scalar>::epsilon();
    int beside = 0;
    for (int i = 0; i < 5000; ++i) {
        const double size = std::exp(random.between(-40, 40));
        const V a = V(size * random.in_cube()).cast<Scalar>().template cast<double>();
        V b = size * random.in_cube();
        if (random.chance(0.3)) b = -a + 1e-3 * b;
        b = b.cast<Scalar>().template cast<double>();
        const V up = size * V(random.direction().cross(b - a).normalized());
        const V m = a + random.between(0.1, 0.9) * (b - a);
        ASSERT_EQ(t_junctions<Scalar>(seam(a, m, b, up)), 1U) << i;
        const double unit = step * std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
        const V off = (b - a).cross(up).normalized() * unit;
        ASSERT_EQ(t_junctions<Scalar>(seam(a, m + near * off, b, up)), 1U) << i;
        ASSERT_EQ(t_junctions<Scalar>(seam(a, m + far * off, b, up)), 0U) << i;
        ++beside;
    }
    EXPECT_EQ(beside, 5000);
}

TEST(TJunctions, are_found_within_rounding_and_not_beyond) {
    rounded_ones<float>(1.5, 8);
    rounded_ones<double>(1, 8);
}

// A ladder of edges at every whole height up to 2310 = 2 x 3 x 5 x 7 x 11, so that borders between cells fall on
// heights unless there is one cell, or a number of them prime to all of these. Each edge has one vertex a hair above
// it, within rounding, and one a hair below: one of the two lies across the border, and outside of the edge's own box.
TEST(TJunctions, a_hair_across_a_border_of_cells_are_found) {
    constexpr int k_rungs = 2310;
    TriangleSoup<double> soup;
    std::size_t expected = 0;
    for (int rung = 0; rung <= k_rungs; ++rung) {
        add_triangle(soup, V(-3000, rung, 0), V(3000, rung, 0), V(0, rung, 4));
        for (const int way : {-1, 1}) {
            if (rung + way < 0 || rung + way > k_rungs) continue;  // so that the lowest and highest box end on a rung
            const double x = 500 * way;
            const double y = rung + way * 3 * 0x1p-23 * 3000;
            add_triangle(soup, V(x, y, 0), V(x + 1, y, -1), V(x - 1, y, -1));
            ++expected;
        }
    }
    EXPECT_EQ(t_junctions<float>(soup), expected);
}

}  // namespace
}  // namespace pierce::test
