// Builds and batches on the threads of oneTBB give the bits that they give on one.
#include <atomic>

#include <gtest/gtest.h>
#include <pierce/tbb.h>
#include <query/batch_world.h>
#include <support/expect_hit.h>

namespace pierce::test {
namespace {

TEST(Tbb, runs_each_part_once) {
    const Executor executor = tbb_executor();
    std::vector<std::atomic<int>> runs(1000);
    executor(runs.size(), [&](std::size_t part) { ++runs[part]; });
    for (const auto& run : runs) EXPECT_EQ(run, 1);
    executor(0, [&](std::size_t) { ADD_FAILURE() << "there is no part"; });
}

template <class Scalar>
void compare() {
    // Large enough for several parts of a build.
    const TriangleSoup<Scalar> soup = moved<Scalar>(terrain(150, 0.02, 3), 1, Vec3<double>::Zero());
    const CollisionMesh<Scalar> mesh(soup.view());
    const CollisionMesh<Scalar> other(soup.view(), {.executor = tbb_executor()});
    EXPECT_EQ(other.statistics().bytes, mesh.statistics().bytes);
    EXPECT_EQ(other.statistics().grid_references, mesh.statistics().grid_references);
    const std::vector<Segment<Scalar>> segments = batch_segments(soup.view(), 20'000, 1);
    std::vector<std::optional<Hit<Scalar>>> out(segments.size());
    QueryCounters counters;
    const std::size_t count = other.first_hits(segments, out, {.counters = &counters}, tbb_executor());
    EXPECT_EQ(counters.queries, segments.size());
    std::size_t expected = 0;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const auto hit = mesh.first_hit(segments[i]);
        ASSERT_TRUE(same_answer(out[i], hit)) << i << ": " << to_text(segments[i]);
        expected += hit ? 1U : 0U;
    }
    EXPECT_EQ(count, expected);
    EXPECT_GT(count, segments.size() / 10);
}

TEST(Tbb, changes_no_bit_in_float) { compare<float>(); }
TEST(Tbb, changes_no_bit_in_double) { compare<double>(); }

}  // namespace
}  // namespace pierce::test
