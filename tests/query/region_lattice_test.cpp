// Walks through the edges and vertices of cubes in many colours, against cells that are looked up.
#include <gtest/gtest.h>

#include <pierce/pierce.h>
#include <support/region_models.h>

namespace pierce::test {
namespace {

template <class Scalar>
using V = Vec3<Scalar>;

/// The colours that a moved flight goes through, cell by cell.
std::vector<std::uint32_t> colours_of(const ColouredCubes& cubes, const std::array<int, 3>& from,
                                      const std::array<int, 3>& to) {
    const int edge = static_cast<int>(cubes.edge);
    struct Plane {
        int past;  ///< how far it is from the start: the fraction is past / way
        int way;
        std::size_t axis;
        bool up;
    };
    std::vector<Plane> planes;
    std::array<int, 3> cell{};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto floor_of = [edge](int x) { return (x >= 0 ? x : x - edge + 1) / edge; };
        cell[k] = floor_of(from[k]);
        const int last = floor_of(to[k]);
        for (int c = cell[k]; c < last; ++c) planes.push_back({(c + 1) * edge - from[k], to[k] - from[k], k, true});
        for (int c = cell[k]; c > last; --c) planes.push_back({from[k] - c * edge, from[k] - to[k], k, false});
    }
    // Moved upwards, a flight comes to a plane earlier if it goes up, later if down; most so along x, then y.
    std::sort(planes.begin(), planes.end(), [](const Plane& x, const Plane& y) {
        const int left = x.past * y.way;
        const int right = y.past * x.way;
        if (left != right) return left < right;
        if (x.axis == y.axis) return false;
        return x.axis < y.axis ? x.up : !y.up;
    });
    std::vector<std::uint32_t> out = {cubes.at(cell)};
    for (const Plane& plane : planes) {
        cell[plane.axis] += plane.up ? 1 : -1;
        if (cubes.at(cell) != out.back()) out.push_back(cubes.at(cell));
    }
    return out;
}

/// Segments between points of a lattice four times as fine as the cells, most of them aimed at edges and vertices.
template <class Scalar>
void walk_the_lattice(std::size_t models, std::size_t segments, std::uint64_t seed) {
    Random random(seed);
    std::size_t meetings = 0;
    for (std::size_t m = 0; m < models; ++m) {
        const ColouredCubes cubes(4, 3, 4, seed + m);
        const double offset = m % 3 == 0 ? 0 : m % 3 == 1 ? 1000 : -65536;
        const V<double> shift(offset, -offset, 2 * offset);
        const RegionModel<Scalar> model = cubes.model.as<Scalar>(1, shift);
        const CollisionMesh<Scalar> mesh(model.soup.view());
        const Regions<Scalar> regions(mesh, model.labels);
        const auto at = [&](const std::array<int, 3>& p) {
            return (V<double>(p[0], p[1], p[2]) + shift).template cast<Scalar>().eval();
        };
        for (std::size_t i = 0; i < segments; ++i) {
            std::array<int, 3> from{};
            std::array<int, 3> way{};
            const int step = random.chance(0.5) ? 4 : 2;
            for (std::size_t k = 0; k < 3; ++k) from[k] = step * random.between_ints(-4 / step, 20 / step);
            for (std::size_t k = 0; k < 3; ++k) way[k] = 2 * random.between_ints(-3, 3) * random.between_ints(1, 2);
            const std::array<int, 3> middle = {from[0] + way[0], from[1] + way[1], from[2] + way[2]};
            const std::array<int, 3> to = {middle[0] + way[0], middle[1] + way[1], middle[2] + way[2]};
            const std::vector<std::uint32_t> expected = colours_of(cubes, from, to);
            std::array<Leg<Scalar>, 64> legs;
            const Segment<Scalar> segment{at(from), at(to)};
            const std::size_t count = regions.walk(segment, legs);
            ASSERT_EQ(count, expected.size()) << said(segment);
            for (std::size_t j = 0; j < count; ++j) {
                ASSERT_EQ(legs[j].region, expected[j]) << said(segment) << " leg " << j;
                ASSERT_TRUE(legs[j].consistent) << said(segment) << " leg " << j;
                meetings += j > 0 && legs[j].entry == legs[j].exit ? 1U : 0U;
            }
            ASSERT_EQ(regions.region_at(at(from)), expected.front()) << said(segment);
            ASSERT_EQ(regions.region_at(at(to)), expected.back()) << said(segment);
            // In two steps, and as a ray.
            std::array<Leg<Scalar>, 64> first;
            std::array<Leg<Scalar>, 64> second;
            const std::size_t a = regions.walk(Segment<Scalar>{at(from), at(middle)}, first);
            const std::size_t b = regions.walk(Segment<Scalar>{at(middle), at(to)}, second);
            ASSERT_EQ(a + b, count + 1) << said(segment);
            for (std::size_t j = 0; j + 1 < a; ++j) ASSERT_EQ(first[j].face, legs[j].face) << said(segment);
            for (std::size_t j = 0; j < b; ++j) ASSERT_EQ(second[j].face, legs[a - 1 + j].face) << said(segment);
            const V<Scalar> direction = at(middle) - at(from);
            ASSERT_EQ(regions.walk(Ray<Scalar>{at(from), direction, 2}, first), count) << said(segment);
            for (std::size_t j = 0; j < count; ++j) ASSERT_EQ(first[j].face, legs[j].face) << said(segment);
        }
    }
    EXPECT_GT(meetings, models * segments / 20);
}

template <class Scalar>
class RegionLattice : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(RegionLattice, Scalars, );

TYPED_TEST(RegionLattice, walk_through_edges_and_vertices_of_cubes) { walk_the_lattice<TypeParam>(9, 1000, 7); }

// A flight along the diagonal meets three planes in each vertex: moved, those across x first, then y, then z, if it
// goes up; z first if down.
TYPED_TEST(RegionLattice, come_one_after_the_other_in_a_vertex) {
    using Scalar = TypeParam;
    const ColouredCubes all(2, 1000000, 1, 3);  // eight colours
    const RegionModel<Scalar> model = all.model.as<Scalar>(1, V<double>(0, 0, 0));
    const CollisionMesh<Scalar> mesh(model.soup.view());
    const Regions<Scalar> regions(mesh, model.labels);
    std::array<Leg<Scalar>, 16> legs;
    const Segment<Scalar> up{V<Scalar>(0.5, 0.5, 0.5), V<Scalar>(1.5, 1.5, 1.5)};
    ASSERT_EQ(regions.walk(up, legs), 4U);
    const std::array<std::array<int, 3>, 4> cells = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(legs[i].region, all.at(cells[i]));
    EXPECT_EQ(legs[0].exit, Scalar(0.5));
    EXPECT_EQ(legs[1].exit, Scalar(0.5));
    EXPECT_EQ(legs[2].exit, Scalar(0.5));
    EXPECT_EQ(legs[3].exit, Scalar(1));
    ASSERT_EQ(regions.walk(Segment<Scalar>{up.to, up.from}, legs), 4U);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(legs[i].region, all.at(cells[3 - i]));
}

template <class Scalar>
class RegionLatticeSoak : public ::testing::Test {};
TYPED_TEST_SUITE(RegionLatticeSoak, Scalars, );

TYPED_TEST(RegionLatticeSoak, a_million_walks_through_edges_and_vertices) {
    walk_the_lattice<TypeParam>(60, 20000, 17);
}

}  // namespace
}  // namespace pierce::test
