// Builds that once took for ever: the loop that looks for cells large enough, at the ends of the range of numbers.
#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include <pierce/pierce.h>
#include <support/meshes.h>

namespace pierce::test {
namespace {

using V = Vec3<double>;

/// Triangles side by side on z = 0, each about as large as `edge`.
TriangleSoup<double> row(std::size_t count, double edge) {
    TriangleSoup<double> soup;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = static_cast<double>(i) * edge;
        add_triangle(soup, V(x, 0, 0), V(x + edge, 0, 0), V(x, edge, 0));
    }
    return soup;
}

// The cells of a grid were at most 2^1023 wide once, so a box beyond 9e307 never was a single one, for which the loop
// waited. 4.4e307 was built.
TEST(BuildEnds, for_a_triangle_as_wide_as_the_range_of_doubles) {
    for (const double reach : {4.4e307, 4.6e307, 1.7e308}) {
        for (const std::size_t max_grid_bytes : {std::size_t{0}, std::size_t{100}}) {
            TriangleSoup<double> soup = row(max_grid_bytes == 0 ? 1000 : 0, 1);
            add_triangle(soup, V(-reach, -reach, -5), V(reach, -reach, -5), V(0, reach, -5));
            for (const Broadphase broadphase : {Broadphase::tree, Broadphase::grid}) {
                const CollisionMesh<double> mesh(soup.view(),
                                                 {.broadphase = broadphase, .max_grid_bytes = max_grid_bytes});
                EXPECT_TRUE(std::isfinite(mesh.statistics().cell_size));
                const auto near = mesh.first_hit({V(500.25, 0.25, 1), V(500.25, 0.25, -10)});
                ASSERT_TRUE(near);
                EXPECT_EQ(near->face, max_grid_bytes == 0 ? 500U : 0U);
                const auto far = mesh.first_hit({V(-1e307, 0, 0), V(-1e307, 0, -10)});
                ASSERT_TRUE(far);
                EXPECT_EQ(far->face, soup.triangles.size() - 1);
            }
        }
    }
}

// Half of its extent is 0: its units were the caller's, in which no step is small enough, and all steps were tried.
TEST(BuildEnds, for_triangles_as_small_as_numbers_go) {
    constexpr double k_least = std::numeric_limits<double>::denorm_min();
    const std::vector<V> positions = {V(0, 0, 0), V(k_least, 0, 0), V(0, k_least, 0)};
    const std::vector<IndexTriple> triangles = {{0, 1, 2}};
    for (const Broadphase broadphase : {Broadphase::tree, Broadphase::grid}) {
        const CollisionMesh<double> mesh({positions, triangles}, {.broadphase = broadphase});
        EXPECT_TRUE(mesh.any_hit({V(0, 0, 1), V(0, 0, -1)}));
        EXPECT_FALSE(mesh.any_hit({V(k_least, k_least, 1), V(k_least, k_least, -1)}));
    }
}

// No memory is touched: the view only says that there are so many.
TEST(BuildEnds, at_once_for_more_triangles_than_there_are_places) {
    const std::vector<V> positions = {V(0, 0, 0), V(1, 0, 0), V(0, 1, 0)};
    const std::vector<IndexTriple> triangles = {{0, 1, 2}};
    const MeshView<double> view{positions, std::span(triangles.data(), std::size_t{1} << 28)};
    try {
        const CollisionMesh<double> mesh(view);
        ADD_FAILURE() << "is not refused";
    } catch (const MeshError& error) {
        EXPECT_NE(std::string(error.what()).find("268435456"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("268435455"), std::string::npos) << error.what();
    }
}

struct CountedCalls {
    mutable int calls = 0;
    void operator()(std::size_t parts, Task task) const {
        ++calls;
        for (std::size_t i = 0; i < parts; ++i) task(i);
    }
};

// The number of cells along an axis has a limit. All smaller sizes gave the same ones, and each was tried: 2,900 passes
// for 1e-300.
TEST(BuildEnds, soon_for_cells_that_are_far_too_small) {
    const TriangleSoup<double> soup = row(20'000, 1.0 / 20'000);
    const CountedCalls counted;
    const CollisionMesh<double> mesh(
        soup.view(), {.broadphase = Broadphase::grid, .cell_size = 1e-300, .executor = std::ref(counted)});
    EXPECT_GT(counted.calls, 3);
    EXPECT_LT(counted.calls, 100);
    EXPECT_TRUE(mesh.any_hit({V(0.5 + 1e-5, 1e-5, 1), V(0.5 + 1e-5, 1e-5, -1)}));
}

// In units of its own size the mesh's distance from the origin overflowed, and the lattice's corner was sought for
// ever.
template <class Scalar>
void expect_flat_mesh_far_away(double far, double size, bool refused) {
    using P = Vec3<Scalar>;
    TriangleSoup<Scalar> soup;
    const auto at = [&](double x, double z) { return P(Vec3<double>(size * x, far, size * z).cast<Scalar>()); };
    for (int i = 0; i < 100; ++i) {
        const auto first = static_cast<std::uint32_t>(soup.positions.size());
        for (const P& p : {at(i, 0), at(i, 1), at(i + 1, 0)}) soup.positions.push_back(p);
        soup.triangles.push_back({first, first + 1, first + 2});
    }
    for (const Broadphase broadphase : {Broadphase::tree, Broadphase::grid}) {
        const BuildOptions options{.broadphase = broadphase};
        if (refused) {
            EXPECT_THROW(CollisionMesh<Scalar>(soup.view(), options), MeshError) << far << ' ' << size;
            continue;
        }
        const CollisionMesh<Scalar> mesh(soup.view(), options);
        P from = at(37.25, 0.25);
        P to = from;
        from[1] = static_cast<Scalar>(far * 1.5);
        to[1] = static_cast<Scalar>(far * 0.5);
        const auto hit = mesh.first_hit({from, to}, {.sides = Sides::both});
        ASSERT_TRUE(hit) << far << ' ' << size;
        EXPECT_EQ(hit->face, 37U);
        EXPECT_EQ(mesh.locate(at(37.25, 0.25)).place, Place::on_surface);
    }
}

TEST(BuildEnds, for_flat_meshes_that_are_nothing_beside_their_distance_from_the_origin) {
    expect_flat_mesh_far_away<double>(-3.64e297, 3e-59, true);
    expect_flat_mesh_far_away<double>(1e308, 1e-300, true);
    expect_flat_mesh_far_away<float>(1e38, 1e-30, true);
    expect_flat_mesh_far_away<double>(1e20, 1e-20, false);
    expect_flat_mesh_far_away<float>(1e10, 1e-10, false);
}

}  // namespace
}  // namespace pierce::test
