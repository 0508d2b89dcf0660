// Every triangle with an area is in one record, with its corners to the bit; boxes, bounds and counts are right.
#include <algorithm>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include <cluster/make_clusters.h>
#include <exact/decide.h>
#include <support/cluster_meshes.h>
#include <support/executors.h>

namespace pierce::test {
namespace {

using detail::ClusterBuild;
using detail::Corners;

template <class Scalar>
ClusterBuild<Scalar> clusters_of(const MeshView<Scalar>& mesh, const Executor& executor = {}) {
    const detail::MadePlain<Scalar> plain(mesh, executor);
    return detail::make_clusters(plain.mesh(), detail::has_zero_area, executor);
}

template <class Scalar>
void expect_sound(const MeshView<Scalar>& mesh, const char* what) {
    SCOPED_TRACE(what);
    const ClusterBuild<Scalar> build = clusters_of(mesh);
    std::vector<int> listed(mesh.triangles.size(), 0);
    std::vector<bool> taken(mesh.triangles.size() + 1, false);
    std::array<double, 3> low, high;
    low.fill(HUGE_VAL);
    high.fill(-HUGE_VAL);
    double largest = 0;
    std::uint32_t last_key = 0;
    for (const auto& box : build.boxes) {
        ASSERT_LE(last_key, box.key);
        last_key = box.key;
        ASSERT_LT(box.key, 1U << 30);
        const unsigned n = detail::count_of(box.ref);
        std::array<double, 3> l, h;
        l.fill(HUGE_VAL);
        h.fill(-HUGE_VAL);
        for (unsigned lane = 0; lane < n; ++lane) {
            ASSERT_FALSE(taken[detail::first_of(box.ref) + lane]);
            taken[detail::first_of(box.ref) + lane] = true;
            const std::uint32_t number = build.clusters.triangle(box.ref, lane);
            ASSERT_LT(number, mesh.triangles.size());
            ++listed[number];
            const Corners corners = build.clusters.corners(box.ref, lane);
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t k = 0; k < 3; ++k) {
                    const auto original =
                        static_cast<double>(mesh.positions[mesh.triangles[number][c]][static_cast<int>(k)]);
                    ASSERT_EQ(std::memcmp(&corners[c][k], &original, sizeof original), 0);
                    l[k] = std::min(l[k], original);
                    h[k] = std::max(h[k], original);
                    largest = std::max(largest, std::abs(original));
                }
        }
        const auto unit = static_cast<Scalar>(build.unit);
        for (std::size_t k = 0; k < 3; ++k) {
            ASSERT_EQ(box.low[k], static_cast<Scalar>(l[k]) * unit);
            ASSERT_EQ(box.high[k], static_cast<Scalar>(h[k]) * unit);
            low[k] = std::min(low[k], l[k]);
            high[k] = std::max(high[k], h[k]);
        }
    }
    std::vector<std::uint32_t> degenerate;
    for (std::size_t i = 0; i < listed.size(); ++i) {
        const IndexTriple& t = mesh.triangles[i];
        const auto corner = [&](std::size_t c) { return detail::to_point(mesh.positions[t[c]]); };
        const bool none = detail::has_zero_area({corner(0), corner(1), corner(2)});
        if (none) degenerate.push_back(static_cast<std::uint32_t>(i));
        ASSERT_EQ(listed[i], none ? 0 : 1) << "triangle " << i;
    }
    EXPECT_EQ(build.degenerate, degenerate);
    EXPECT_EQ(build.largest, largest);
    int exponent = 0;
    EXPECT_EQ(std::frexp(build.unit, &exponent), 0.5);
    double extent = 0;
    for (std::size_t k = 0; k < 3 && !build.boxes.empty(); ++k) {
        EXPECT_EQ(build.low[k], low[k]);
        EXPECT_EQ(build.high[k], high[k]);
        extent = std::max(extent, high[k] * build.unit - low[k] * build.unit);
    }
    using Limits = std::numeric_limits<Scalar>;
    const bool tiny = build.unit == std::ldexp(1.0, Limits::max_exponent - 1);
    EXPECT_GE(extent, tiny || build.boxes.empty() ? 0 : 0.5);
    EXPECT_LE(extent, 1);

    const detail::ClusterRef empty = build.clusters.empty;
    EXPECT_EQ(detail::count_of(empty), 1U);
    EXPECT_FALSE(taken[detail::first_of(empty)]);
    EXPECT_EQ(build.clusters.triangle(empty, 0), detail::k_no_triangle);
    EXPECT_EQ(build.clusters.corners(empty, 0), (Corners{}));
    const Scalar* behind = build.clusters.record(empty) + detail::k_row_count;
    ASSERT_LE(behind + detail::k_beyond_records, build.clusters.records.end());
    EXPECT_TRUE(std::all_of(behind, behind + detail::k_beyond_records, [](Scalar x) { return x == 0; }));

    for (const Executor& executor : {Executor(Reversed()), Executor(Threads())}) {
        const ClusterBuild<Scalar> other = clusters_of(mesh, executor);
        ASSERT_EQ(other.boxes.size(), build.boxes.size());
        EXPECT_EQ(other.unit, build.unit);
        EXPECT_EQ(other.degenerate, build.degenerate);
        for (std::size_t i = 0; i < build.boxes.size(); ++i) {
            const auto& a = build.boxes[i];
            const auto& b = other.boxes[i];
            ASSERT_TRUE(a.ref == b.ref && a.key == b.key && std::equal(a.low, a.low + 3, b.low) &&
                        std::equal(a.high, a.high + 3, b.high));
            ASSERT_EQ(std::memcmp(build.clusters.record(a.ref), other.clusters.record(b.ref),
                                  sizeof(Scalar) * detail::k_row_count * detail::count_of(a.ref)),
                      0);
        }
    }
}

template <class Scalar>
class MakeClusters : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(MakeClusters, Scalars);

TYPED_TEST(MakeClusters, AllSizesOfScenes) {
    expect_sound(random_soup<TypeParam>(30000, 0.02, 1, 0, 1).view(), "unit cube");
    expect_sound(random_soup<TypeParam>(3000, 1, 1, 0, 2).view(), "large faces");
    for_each_extreme_soup<TypeParam>([](const auto& soup, const char* what) { expect_sound(soup.view(), what); });
    expect_sound(teapot_in_stadium<TypeParam>(20000, 1e-5).view(), "teapot");
}

TYPED_TEST(MakeClusters, AllSizesInOneScene) { expect_sound(nested_soup_of_all_sizes<TypeParam>(12).view(), "nested"); }

TYPED_TEST(MakeClusters, OneTriangleAgainAndAgain) {
    TriangleSoup<TypeParam> soup;
    add_triangle(soup, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    expect_sound(soup.view(), "one");
    soup.triangles.assign(100000, soup.triangles[0]);
    expect_sound(soup.view(), "many");
}

TYPED_TEST(MakeClusters, NothingWithAnArea) {
    TriangleSoup<TypeParam> soup;
    expect_sound(soup.view(), "nothing");
    for (int i = 0; i < 1000; ++i) add_triangle<TypeParam>(soup, {0, 1, 2}, {double(i), 1, 2}, {double(-i), 1, 2});
    expect_sound(soup.view(), "lines");
    EXPECT_EQ(clusters_of(soup.view()).boxes.size(), 0U);
}

// Far vertices that no triangle has neither move the lattice of the keys nor count for the bounds, whatever they are.
TYPED_TEST(MakeClusters, VerticesWithoutTriangles) {
    TriangleSoup<TypeParam> soup = random_soup<TypeParam>(5000, 0.02, 1, 0, 7);
    const ClusterBuild<TypeParam> before = clusters_of(soup.view());
    for (const TypeParam far :
         {TypeParam(1e30), std::numeric_limits<TypeParam>::infinity(), std::numeric_limits<TypeParam>::quiet_NaN()}) {
        soup.positions.push_back({far, far, -far});
        expect_sound(soup.view(), "far vertices");
        EXPECT_EQ(clusters_of(soup.view()).boxes.size(), before.boxes.size());
    }
}

}  // namespace
}  // namespace pierce::test
