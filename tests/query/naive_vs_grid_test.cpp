// The grid, the filter and the order of work change no bit of an answer: CollisionMesh against its naive twin.
#include <cstdlib>

#include <gtest/gtest.h>
#include <kernel/backends.h>
#include <pierce/collision_mesh.h>
#include <support/executors.h>
#include <support/expect_hit.h>
#include <support/meshes.h>
#include <support/naive.h>
#include <support/segments.h>

namespace pierce::test {
namespace {

template <class Scalar>
void compare(const std::string& name, const TriangleSoup<Scalar>& soup, int count, std::uint64_t seed,
             const BuildOptions& build = {}) {
    SCOPED_TRACE(name);
    const CollisionMesh<Scalar> mesh(soup.view(), build);
    const NaiveMesh<Scalar> naive(soup.view());
    const Extent<Scalar> extent(soup.view());
    Random random(seed);
    int hits = 0;
    std::array<Hit<Scalar>, 4> some;
    std::array<Hit<Scalar>, 4> expected;
    for (int i = 0; i < count; ++i) {
        const Segment<Scalar> segment = mixed_segment(soup.view(), extent, random);
        QueryOptions options;
        options.sides = std::array{Sides::front, Sides::back, Sides::both}[random.below(3)];
        if (random.chance(0.2)) options.max_fraction = random.unit();
        const auto hit = mesh.first_hit(segment, options);
        ASSERT_TRUE(same_answer(hit, naive.first_hit(segment, options))) << i << ": " << to_text(segment);
        ASSERT_EQ(mesh.any_hit(segment, options), hit.has_value()) << i << ": " << to_text(segment);
        hits += hit.has_value() ? 1 : 0;
        if (i % 4 != 0) continue;
        const std::size_t total = mesh.all_hits(segment, some, options);
        ASSERT_EQ(total, naive.all_hits(segment, expected, options)) << i << ": " << to_text(segment);
        for (std::size_t k = 0; k < std::min(total, some.size()); ++k)
            ASSERT_TRUE(same_bits(some[k], expected[k]))
                << i << ", hit " << k << ": " << to_text(segment) << "\n  " << to_text(std::optional(some[k])) << "\n  "
                << to_text(std::optional(expected[k]));
    }
    EXPECT_GT(hits, count / 20);
}

const Vec3<double> k_nowhere = {0, 0, 0};

TEST(NaiveVsGrid, sphere) {
    compare("float", moved<float>(bumpy_sphere(12), 1, k_nowhere), 4000, 1);
    compare("double", moved<double>(bumpy_sphere(12), 1, k_nowhere), 4000, 2);
    compare("float, far", moved<float>(bumpy_sphere(12), 100, {1e6, -1e6, 1e6}), 4000, 3);
    compare("double, far", moved<double>(bumpy_sphere(12), 1, {1e6, -1e6, 1e6}), 4000, 4);
    compare("tiny", moved<double>(bumpy_sphere(12), 1e-6, {1e3, 0, 0}), 2000, 5);
    compare("huge", moved<float>(bumpy_sphere(12), 1e6, {1e3, 0, 0}), 2000, 6);
}

TEST(NaiveVsGrid, lattice) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        compare("float", moved<float>(polycube(4, 0.5, 2, seed), 1, k_nowhere), 1500, 10 + seed);
        compare("double", moved<double>(polycube(4, 0.5, 2, seed), 1, {1e6, 1e6, 1e6}), 1500, 20 + seed);
    }
}

TEST(NaiveVsGrid, terrain_and_shards) {
    compare("terrain", moved<float>(terrain(20, 0.1, 1), 1, k_nowhere), 4000, 31);
    compare("flat terrain", moved<double>(terrain(20, 0, 1), 1, k_nowhere), 4000, 32);
    compare("shards", moved<float>(shards(500, 1), 1, k_nowhere), 4000, 33);
    compare("shards", moved<double>(shards(500, 2), 1000, {1e3, 1e3, 1e3}), 4000, 34);
}

TEST(NaiveVsGrid, any_resolution_gives_the_same_bits) {
    const auto soup = moved<float>(polycube(4, 0.5, 2, 7), 0.1, k_nowhere);
    for (const double cell : {1e-3, 0.01, 0.03, 0.1, 0.25, 1e300})
        compare("grid", soup, 1500, 41, {.cell_size = cell, .max_grid_bytes = std::size_t{1} << 24});
}

// Hits at the same fraction, of triangles of the same face and of others; faces that are in an order of their own.
TEST(NaiveVsGrid, faces_that_were_cut_into_triangles) {
    auto soup = moved<float>(polycube(4, 0.5, 2, 7), 0.1, k_nowhere);
    const auto count = static_cast<std::uint32_t>(soup.triangles.size());
    for (std::uint32_t i = 0; i < count; ++i) soup.faces.push_back((i / 4 * 37) % count);
    compare("faces", soup, 6000, 51);
}

TEST(NaiveVsGrid, built_in_parts_in_any_order_it_is_the_same) {
    const auto soup = moved<float>(terrain(150, 0.02, 3), 1, k_nowhere);
    const Extent<float> extent(soup.view());
    const CollisionMesh<float> one(soup.view());
    const Reversed reversed;
    const Threads threads;
    for (const Executor executor : {Executor(reversed), Executor(threads)}) {
        const CollisionMesh<float> other(soup.view(), {.executor = executor});
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

// ctest runs all of these for each of the machine's wide kernels.
TEST(NaiveVsGrid, uses_the_backend_that_is_tested) {
    const char* backend = std::getenv("PIERCE_BACKEND");
    EXPECT_EQ(CollisionMesh<float>(MeshView<float>{}).statistics().backend,
              backend != nullptr ? backend : detail::backends().front()->name);
}

}  // namespace
}  // namespace pierce::test
