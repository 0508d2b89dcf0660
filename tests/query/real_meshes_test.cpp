// On real meshes the grid and the naive twin give the same bits: 14 meshes, 10^5 segments each for both scalar types,
// of all lengths.
#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/expect_hit.h>
#include <support/naive.h>
#include <support/real_meshes.h>
#include <support/segments.h>

namespace pierce::test {
namespace {

class RealMeshes : public ::testing::TestWithParam<std::string_view> {};

template <class Scalar>
void compare(std::string_view name, int count, std::uint64_t seed) {
    const TriangleSoup<Scalar> soup = real_mesh<Scalar>(name);
    const CollisionMesh<Scalar> mesh(soup.view());
    const NaiveMesh<Scalar> naive(soup.view());
    const Extent<Scalar> extent(soup.view());
    Random random(seed);
    int hits = 0;
    int featured = 0;
    std::array<Hit<Scalar>, 4> all;
    std::array<Hit<Scalar>, 4> expected;
    for (int i = 0; i < count; ++i) {
        const Segment<Scalar> segment = mixed_segment(soup.view(), extent, random);
        const QueryOptions options{.sides = std::array{Sides::front, Sides::back, Sides::both}[random.below(3)]};
        const auto hit = mesh.first_hit(segment, options);
        ASSERT_TRUE(same_answer(hit, naive.first_hit(segment, options)))
            << name << ' ' << i << ": " << to_text(segment);
        ASSERT_EQ(mesh.any_hit(segment, options), hit.has_value()) << name << ' ' << i << ": " << to_text(segment);
        hits += hit ? 1 : 0;
        featured += hit && hit->feature != Feature::face ? 1 : 0;
        if (i % 16 != 0) continue;
        const std::size_t total = mesh.all_hits(segment, all, options);
        ASSERT_EQ(total, naive.all_hits(segment, expected, options)) << name << ' ' << i << ": " << to_text(segment);
        for (std::size_t k = 0; k < std::min(total, all.size()); ++k)
            ASSERT_TRUE(same_bits(all[k], expected[k]))
                << name << ' ' << i << ", hit " << k << ": " << to_text(segment);
    }
    std::cout << name << ": " << soup.triangles.size() << " triangles, " << count << " segments, " << hits << " hits, "
              << featured << " on edges and vertices\n";
    EXPECT_GT(hits, count / 10);
    EXPECT_LT(hits, count * 9 / 10);
    EXPECT_GT(featured, count / 1000);
}

TEST_P(RealMeshes, grid_equals_naive_in_float) { compare<float>(GetParam(), 50'000, 1); }
TEST_P(RealMeshes, grid_equals_naive_in_double) { compare<double>(GetParam(), 50'000, 2); }

INSTANTIATE_TEST_SUITE_P(Debian, RealMeshes, ::testing::ValuesIn(k_real_meshes),
                         [](const auto& param) { return std::string(param.param); });

}  // namespace
}  // namespace pierce::test
