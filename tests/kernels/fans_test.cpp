// Meshes taken apart into fans.
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include <pierce/fans.h>
#include <pierce/pierce.h>
#include <support/meshes.h>

namespace pierce::test {
namespace {

using kernels::TriangleFan;
using D = Vec3<double>;

/// Every triangle once, each with its own corners in its own orientation, neighbours in a fan joined.
template <class Scalar>
std::size_t expect_cover(const TriangleSoup<Scalar>& soup, std::size_t most = k_most_in_fan) {
    const std::vector<Fan> fans = fans_of(soup.view(), most);
    std::vector<int> covered(soup.triangles.size());
    std::size_t numbers = 0;
    for (const Fan& fan : fans) {
        EXPECT_EQ(fan.ring.size(), fan.triangles.size() + 1);
        EXPECT_GE(fan.triangles.size(), 1U);
        EXPECT_LE(fan.triangles.size(), most);
        for (std::size_t k = 0; k < fan.triangles.size(); ++k) {
            ++covered[fan.triangles[k]];
            IndexTriple t = soup.triangles[fan.triangles[k]];
            const IndexTriple expected = {fan.apex, fan.ring[k], fan.ring[k + 1]};
            for (int turns = 0; turns < 2 && t != expected; ++turns) t = {t[1], t[2], t[0]};
            EXPECT_EQ(t, expected);
        }
        const auto stored = prepare(soup.view(), fan);
        EXPECT_EQ(stored.triangles(), fan.triangles.size());
        numbers += 6 * (fan.triangles.size() + 1);
    }
    for (const int times : covered) EXPECT_EQ(times, 1);
    std::printf("%zu triangles in %zu fans: %.2f triangles a fan, %.2f numbers a triangle\n", soup.triangles.size(),
                fans.size(), double(soup.triangles.size()) / double(fans.size()),
                double(numbers) / double(soup.triangles.size()));
    return fans.size();
}

TEST(Fans, CoverEveryTriangleOnce) {
    const auto sphere = bumpy_sphere(20);
    // A perfect matching of one-rings would be a sixth.
    EXPECT_LT(expect_cover(sphere), sphere.triangles.size() * 2 / 5);
    expect_cover(terrain(20, 0.1, 1));
    expect_cover(polycube(4, 0.5, 1, 3));  // edges with four faces, vertices where several sheets meet
    expect_cover(shards(300, 4));          // nothing joined
    TriangleSoup<double> doubled = bumpy_sphere(3);
    doubled.triangles.insert(doubled.triangles.end(), doubled.triangles.begin(), doubled.triangles.end());
    expect_cover(doubled);
    TriangleSoup<double> odd = terrain(3, 0, 1);
    odd.triangles.push_back({0, 0, 1});  // names a vertex twice
    odd.triangles.push_back({0, 1, 2});  // without area
    odd.triangles.push_back({1, 0, 5});  // turned against its neighbour
    expect_cover(odd);
    EXPECT_TRUE(fans_of(TriangleSoup<double>{}.view()).empty());
    // Two triangles that share a long edge: each has a basis at the corner that it names first, but not at the ends of
    // the edge.
    const double s = 1.5 * std::ldexp(1.0, kernels::k_fan_range<double>);
    TriangleSoup<double> long_edge;
    long_edge.positions = {{0, 0, 0}, {s, 0, 0}, {-s, s / 2, 0}, {0, s, 0}};
    long_edge.triangles = {{0, 1, 2}, {3, 2, 1}};
    EXPECT_EQ(expect_cover(long_edge), 2U);
    odd.triangles.push_back({0, 1, 99});
    EXPECT_THROW((void)fans_of(odd.view()), MeshError);
}

// A double cone over a polygon with 50 corners: two vertices of valence 50. Cut into as few parts as will do, equally
// long but for one.
TEST(Fans, HaveAtMostTheMembersThatAreAskedFor) {
    TriangleSoup<double> cone;
    cone.positions = {{0, 0, 1}, {0, 0, -1}};
    for (std::uint32_t k = 0; k < 50; ++k) {
        cone.positions.emplace_back(std::cos(0.02 * 6.2831853 * k), std::sin(0.02 * 6.2831853 * k), 0);
        cone.triangles.push_back({0, 2 + k, 2 + (k + 1) % 50});
        cone.triangles.push_back({1, 2 + (k + 1) % 50, 2 + k});
    }
    EXPECT_EQ(k_most_in_fan, 16U);
    for (const auto& [most, fans] : {std::pair{50U, 2U}, {49U, 4U}, {16U, 8U}, {7U, 16U}, {1U, 100U}})
        EXPECT_EQ(expect_cover(cone, most), fans);
    EXPECT_EQ(fans_of(cone.view(), 0).size(), 100U);
    for (const Fan& fan : fans_of(cone.view())) EXPECT_GE(fan.triangles.size(), 12U);
}

// All fans of a closed mesh, one after the other, find what its triangles tested exactly find.
TEST(Fans, OfAMeshAnswerAsTheMesh) {
    const TriangleSoup<double> sphere = bumpy_sphere(12);
    const CollisionMesh<double> mesh(sphere.view());
    const std::vector<Fan> fans = fans_of(sphere.view());
    std::vector<TriangleFan::Stored<double>> stored;
    for (const Fan& fan : fans) stored.push_back(prepare(sphere.view(), fan));
    Random random(6);
    int hits = 0;
    for (int i = 0; i < 2'000; ++i) {
        const D from = 2 * random.direction();
        const D to = 0.8 * random.in_cube();
        double best = 2;
        std::uint32_t face = ~0U;
        for (std::size_t f = 0; f < fans.size(); ++f)
            if (const auto hit = kernels::triangle_fan.test(stored[f], from, to); hit && hit->fraction < best) {
                best = hit->fraction;
                face = fans[f].triangles[hit->triangle];
            }
        const auto truth = mesh.first_hit({from, to});
        ASSERT_EQ(truth.has_value(), face != ~0U);
        if (!truth) continue;
        ++hits;
        EXPECT_EQ(face, truth->face);
        EXPECT_NEAR(best, truth->exact_fraction, 1e-12);
    }
    EXPECT_GT(hits, 1'000);
}

}  // namespace
}  // namespace pierce::test
