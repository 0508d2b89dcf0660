// The tree, the grid and the naive twin give the same bits where a broadphase is most likely to skip what it must not:
// in walls of cells, through corners, along edges, at both ends of the range of numbers.
#include <gtest/gtest.h>
#include <support/hard_segments.h>
#include <support/meshes.h>
#include <support/twins.h>

namespace pierce::test {
namespace {

/// `cell` in units of the mesh before it is scaled; 0 leaves it to the library.
template <class Scalar>
void compare(const TriangleSoup<double>& soup, double scale, const Vec3<double>& offset, double cell, int count,
             std::uint64_t seed) {
    const TriangleSoup<Scalar> scaled = moved<Scalar>(soup, scale, offset);
    Twins<Scalar> twins(scaled, {.cell_size = cell * scale, .max_grid_bytes = std::size_t{1} << 22});
    const Extent<Scalar> extent(scaled.view());
    Random random(seed);
    compare_twins(twins, count, random,
                  [&] { return hard_segment(scaled.view(), extent, twins.cell_size(), random); });
    EXPECT_GT(twins.hits(), count / 40);
}

const Vec3<double> k_nowhere = {0, 0, 0};

// Cells of the lattice's own size, and of a half: faces in walls, and vertices in corners of cells.
template <class Scalar>
void lattice(int count) {
    for (const double cell : {1.0, 2.0}) compare<Scalar>(polycube(3, 0.5, 2, 1), 1, k_nowhere, cell, count, 1);
    compare<Scalar>(polycube(3, 0.5, 2, 2), 1, {1e6, -1e6, 1e6}, 1, count, 2);
    compare<Scalar>(polycube(3, 0.5, 1, 3), 0.1, {0.3, -0.7, 100}, 1, count, 3);
}

template <class Scalar>
void sphere(int count) {
    compare<Scalar>(bumpy_sphere(4), 1, k_nowhere, 0, count, 11);
    compare<Scalar>(bumpy_sphere(4), 1, {1e3, 1e4, -1e5}, 0.1, count, 12);
    compare<Scalar>(terrain(9, 0, 1), 1, {0, 0, 0.1}, 0.25, count, 13);
    compare<Scalar>(shards(150, 1), 1, k_nowhere, 0, count, 14);
}

// Powers of two scale exactly: a lattice stays one, also among subnormal numbers.
template <class Scalar>
void range(int count) {
    using Limits = std::numeric_limits<Scalar>;
    const double largest = std::ldexp(1.0, Limits::max_exponent - 4);
    const auto least = static_cast<double>(Limits::denorm_min());
    compare<Scalar>(polycube(3, 0.5, 2, 4), largest, k_nowhere, 1, count, 21);
    compare<Scalar>(polycube(3, 0.5, 4, 5), least, k_nowhere, 2, count, 22);
    compare<Scalar>(bumpy_sphere(3), 7 * largest, k_nowhere, 0, count, 23);
    compare<Scalar>(bumpy_sphere(3), 1e4 * least, k_nowhere, 0, count, 24);
    compare<Scalar>(bumpy_sphere(3), static_cast<double>(Limits::min()), k_nowhere, 0.1, count, 25);
}

TEST(NaiveHard, lattice_in_float) { lattice<float>(1500); }
TEST(NaiveHard, lattice_in_double) { lattice<double>(1500); }
TEST(NaiveHard, sphere_in_float) { sphere<float>(1500); }
TEST(NaiveHard, sphere_in_double) { sphere<double>(1500); }
TEST(NaiveHard, ends_of_the_range_in_float) { range<float>(1000); }
TEST(NaiveHard, ends_of_the_range_in_double) { range<double>(1000); }

// 26 meshes: ten million segments together.
constexpr int k_many = 400'000;
TEST(NaiveHardSoak, lattice_in_float) { lattice<float>(k_many); }
TEST(NaiveHardSoak, lattice_in_double) { lattice<double>(k_many); }
TEST(NaiveHardSoak, sphere_in_float) { sphere<float>(k_many); }
TEST(NaiveHardSoak, sphere_in_double) { sphere<double>(k_many); }
TEST(NaiveHardSoak, ends_of_the_range_in_float) { range<float>(k_many); }
TEST(NaiveHardSoak, ends_of_the_range_in_double) { range<double>(k_many); }

}  // namespace
}  // namespace pierce::test
