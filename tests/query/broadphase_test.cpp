// Which broadphase there is, is for the caller to say, then for the environment; what it says of itself; and that its
// options are checked.
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/environment_variable.h>
#include <support/executors.h>
#include <support/meshes.h>
#include <support/segments.h>

namespace pierce::test {
namespace {

struct Environment : EnvironmentVariable {
    explicit Environment(const char* value) : EnvironmentVariable("PIERCE_BROADPHASE", value) {}
};

Broadphase chosen(Broadphase wanted) {
    const TriangleSoup<float> soup = moved<float>(bumpy_sphere(4), 1, {0, 0, 0});
    return CollisionMesh<float>(soup.view(), {.broadphase = wanted}).statistics().broadphase;
}

TEST(BroadphaseChoice, is_the_callers_then_the_environments_then_the_tree) {
    for (const char* nothing : {static_cast<const char*>(nullptr), ""}) {
        const Environment environment(nothing);
        EXPECT_EQ(chosen({}), Broadphase::tree);
        EXPECT_EQ(chosen(Broadphase::automatic), Broadphase::tree);
        EXPECT_EQ(chosen(Broadphase::grid), Broadphase::grid);
    }
    for (const auto& [name, broadphase] : {std::pair{"tree", Broadphase::tree}, {"grid", Broadphase::grid}}) {
        const Environment environment(name);
        EXPECT_EQ(chosen(Broadphase::automatic), broadphase);
        EXPECT_EQ(chosen(Broadphase::tree), Broadphase::tree);
        EXPECT_EQ(chosen(Broadphase::grid), Broadphase::grid);
    }
}

TEST(BroadphaseChoice, refuses_what_there_is_not) {
    for (const std::string wrong : {"trees", "Grid", " grid", "0"}) {
        const Environment environment(wrong.c_str());
        EXPECT_EQ(chosen(Broadphase::tree), Broadphase::tree);
        try {
            chosen(Broadphase::automatic);
            ADD_FAILURE() << wrong << " is not refused";
        } catch (const std::invalid_argument& error) {
            for (const std::string& part :
                 {"'" + wrong + "'", std::string("PIERCE_BROADPHASE"), std::string("tree"), std::string("grid")})
                EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
    }
    EXPECT_THROW(chosen(static_cast<Broadphase>(7)), std::invalid_argument);
}

TEST(BroadphaseStatistics, are_those_of_what_was_built) {
    const TriangleSoup<double> soup = moved<double>(bumpy_sphere(12), 10, {1e3, 0, 0});
    const MeshStatistics tree = CollisionMesh<double>(soup.view(), {.broadphase = Broadphase::tree}).statistics();
    EXPECT_GT(tree.nodes, 10U);
    EXPECT_EQ(tree.cell_size, 0);
    EXPECT_EQ(tree.grid_references, 0U);
    const MeshStatistics grid = CollisionMesh<double>(soup.view(), {.broadphase = Broadphase::grid}).statistics();
    EXPECT_EQ(grid.nodes, 0U);
    EXPECT_EQ(grid.clusters, tree.clusters);
    EXPECT_GE(grid.grid_references, grid.clusters);
    EXPECT_GT(grid.cell_size, 0.1);  // in the caller's units: clusters are some 4 wide
    EXPECT_LT(grid.cell_size, 20);
    const double cell = 1.5;
    const BuildOptions options{.broadphase = Broadphase::grid, .cell_size = cell, .max_grid_bytes = 1 << 24};
    EXPECT_EQ(CollisionMesh<double>(soup.view(), options).statistics().cell_size, cell);
    // Less memory, larger cells. What the rest of the mesh takes is the same.
    BuildOptions less = options;
    less.max_grid_bytes = 1 << 13;
    const MeshStatistics small = CollisionMesh<double>(soup.view(), less).statistics();
    EXPECT_GT(small.cell_size, cell);
    EXPECT_LE(small.bytes + tree.nodes * 256, tree.bytes + less.max_grid_bytes);
    EXPECT_EQ(CollisionMesh<double>(MeshView<double>{}, options).statistics().cell_size, 0);
}

TEST(BroadphaseOptions, are_checked) {
    const TriangleSoup<float> soup = moved<float>(bumpy_sphere(4), 1, {0, 0, 0});
    for (const Broadphase broadphase : {Broadphase::tree, Broadphase::grid}) {
        for (const double wrong : {-1.0, -1e-300, std::numeric_limits<double>::quiet_NaN()}) {
            try {
                const CollisionMesh<float> mesh(soup.view(), {.broadphase = broadphase, .cell_size = wrong});
                ADD_FAILURE() << wrong << " is not refused";
            } catch (const std::invalid_argument& error) {
                EXPECT_NE(std::string(error.what()).find("BuildOptions::cell_size"), std::string::npos) << error.what();
            }
        }
        // The least and the largest are cells as good as any: as small as memory allows, and one for all.
        for (const double cell : {5e-324, 1e-300, 1e300, std::numeric_limits<double>::infinity()}) {
            const CollisionMesh<float> mesh(soup.view(), {.broadphase = broadphase, .cell_size = cell});
            EXPECT_TRUE(mesh.any_hit({{3, 0, 0}, {0, 0, 0}}));
        }
    }
    const auto references = [&](double cell) {
        return CollisionMesh<float>(soup.view(), {.broadphase = Broadphase::grid, .cell_size = cell})
            .statistics()
            .grid_references;
    };
    EXPECT_GT(references(5e-324), 4 * references(1e300)) << "the least size is one, and not the choice of the library";
    EXPECT_EQ(references(1e300), CollisionMesh<float>(soup.view()).statistics().clusters);
}

// Cells come nearest first, and a hit ends the walk: the far side of the sphere is not looked at.
TEST(BroadphaseCounters, count_cells_and_clusters_and_stop_at_a_hit) {
    const TriangleSoup<double> soup = bumpy_sphere(40);
    const CollisionMesh<double> mesh(soup.view(), {.broadphase = Broadphase::grid});
    const auto clusters = mesh.statistics().clusters;
    Random random(3);
    QueryCounters first;
    QueryCounters all;
    QueryCounters any;
    for (int i = 0; i < 200; ++i) {
        const Vec3<double> d = random.direction();
        const Segment<double> through{3 * d, -3 * d};
        (void)mesh.first_hit(through, {.counters = &first});
        (void)mesh.all_hits(through, {}, {.sides = Sides::both, .counters = &all});
        (void)mesh.any_hit(through, {.counters = &any});
    }
    EXPECT_GT(any.nodes, 200U);
    EXPECT_GT(any.clusters, 200U);
    EXPECT_LT(all.clusters, 200 * clusters / 20);
    EXPECT_LT(any.nodes, all.nodes * 2 / 3);
    EXPECT_LT(any.clusters, all.clusters * 2 / 3);
    EXPECT_LT(first.clusters, all.clusters * 2 / 3);
    EXPECT_GE(all.triangles, 400U);
}

}  // namespace
}  // namespace pierce::test
