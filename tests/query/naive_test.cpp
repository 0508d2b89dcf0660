// The broadphase, the filter and the order of work change no bit of an answer: CollisionMesh against its naive twin.
#include <cstdlib>

#include <gtest/gtest.h>
#include <kernel/backends.h>
#include <pierce/collision_mesh.h>
#include <support/executors.h>
#include <support/meshes.h>
#include <support/segments.h>
#include <support/twins.h>

namespace pierce::test {
namespace {

template <class Scalar>
void compare(const std::string& name, const TriangleSoup<Scalar>& soup, int count, std::uint64_t seed,
             const BuildOptions& build = {}) {
    SCOPED_TRACE(name);
    Twins<Scalar> twins(soup, build);
    const Extent<Scalar> extent(soup.view());
    Random random(seed);
    compare_twins(twins, count, random, [&] { return mixed_segment(soup.view(), extent, random); });
    EXPECT_GT(twins.hits(), count / 20);
}

const Vec3<double> k_nowhere = {0, 0, 0};

TEST(Naive, sphere) {
    compare("float", moved<float>(bumpy_sphere(12), 1, k_nowhere), 4000, 1);
    compare("double", moved<double>(bumpy_sphere(12), 1, k_nowhere), 4000, 2);
    compare("float, far", moved<float>(bumpy_sphere(12), 100, {1e6, -1e6, 1e6}), 4000, 3);
    compare("double, far", moved<double>(bumpy_sphere(12), 1, {1e6, -1e6, 1e6}), 4000, 4);
    compare("tiny", moved<double>(bumpy_sphere(12), 1e-6, {1e3, 0, 0}), 2000, 5);
    compare("huge", moved<float>(bumpy_sphere(12), 1e6, {1e3, 0, 0}), 2000, 6);
}

TEST(Naive, lattice) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        compare("float", moved<float>(polycube(4, 0.5, 2, seed), 1, k_nowhere), 1500, 10 + seed);
        compare("double", moved<double>(polycube(4, 0.5, 2, seed), 1, {1e6, 1e6, 1e6}), 1500, 20 + seed);
    }
}

TEST(Naive, terrain_and_shards) {
    compare("terrain", moved<float>(terrain(20, 0.1, 1), 1, k_nowhere), 4000, 31);
    compare("flat terrain", moved<double>(terrain(20, 0, 1), 1, k_nowhere), 4000, 32);
    compare("shards", moved<float>(shards(500, 1), 1, k_nowhere), 4000, 33);
    compare("shards", moved<double>(shards(500, 2), 1000, {1e3, 1e3, 1e3}), 4000, 34);
}

TEST(Naive, any_resolution_gives_the_same_bits) {
    const auto soup = moved<float>(polycube(4, 0.5, 2, 7), 0.1, k_nowhere);
    for (const double cell : {1e-3, 0.01, 0.03, 0.1, 0.25, 1e300})
        compare("grid", soup, 1500, 41, {.cell_size = cell, .max_grid_bytes = std::size_t{1} << 24});
}

// Hits at the same fraction, of triangles of the same face and of others; faces that are in an order of their own.
TEST(Naive, faces_that_were_cut_into_triangles) {
    auto soup = moved<float>(polycube(4, 0.5, 2, 7), 0.1, k_nowhere);
    const auto count = static_cast<std::uint32_t>(soup.triangles.size());
    for (std::uint32_t i = 0; i < count; ++i) soup.faces.push_back((i / 4 * 37) % count);
    compare("faces", soup, 6000, 51);
}

TEST(Naive, built_in_parts_in_any_order_it_is_the_same) {
    const auto soup = moved<float>(terrain(150, 0.02, 3), 1, k_nowhere);
    const Extent<float> extent(soup.view());
    const CollisionMesh<float> one(soup.view());
    EXPECT_TRUE(one.statistics().nodes > 0 || one.statistics().grid_references > 0);
    const Reversed reversed;
    const Threads threads;
    for (const Executor executor : {Executor(reversed), Executor(threads)}) {
        const CollisionMesh<float> other(soup.view(), {.executor = executor});
        EXPECT_EQ(other.statistics().nodes, one.statistics().nodes);
        EXPECT_EQ(other.statistics().grid_references, one.statistics().grid_references);
        EXPECT_EQ(other.statistics().bytes, one.statistics().bytes);
        Random random(61);
        for (int i = 0; i < 5000; ++i) {
            const Segment<float> segment = mixed_segment(soup.view(), extent, random);
            QueryCounters counts;
            QueryCounters other_counts;
            const auto hit = one.first_hit(segment, {.counters = &counts});
            ASSERT_TRUE(same_answer(hit, other.first_hit(segment, {.counters = &other_counts}))) << to_text(segment);
            ASSERT_EQ(counts.nodes, other_counts.nodes);
            ASSERT_EQ(counts.clusters, other_counts.clusters);
            ASSERT_EQ(counts.triangles, other_counts.triangles);
        }
    }
}

// ctest runs all tests of queries for each of the machine's wide kernels, and for the grid.
TEST(Naive, uses_what_is_tested) {
    const char* backend = std::getenv("PIERCE_BACKEND");
    const char* broadphase = std::getenv("PIERCE_BROADPHASE");
    const MeshStatistics statistics = CollisionMesh<float>(MeshView<float>{}).statistics();
    EXPECT_EQ(statistics.backend, backend != nullptr ? backend : detail::backends().front()->name);
    EXPECT_EQ(statistics.broadphase == Broadphase::grid,
              broadphase != nullptr && std::string_view(broadphase) == "grid");
}

}  // namespace
}  // namespace pierce::test
