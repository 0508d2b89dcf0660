// Swept spheres against a judge in rational numbers.
#include <gtest/gtest.h>

#include <pierce/collision_mesh.h>
#include <support/sphere_cases.h>
#include <support/sphere_oracle.h>

#include <exact/decide.h>
#include <point.h>

namespace pierce::test {
namespace {

using detail::Corners;
using detail::Path;
using detail::to_path;
using detail::to_point;

template <class Scalar>
std::vector<Corners> corners_of(const TriangleSoup<Scalar>& soup) {
    std::vector<Corners> out;
    for (const IndexTriple& t : soup.triangles) {
        const Corners corners = {to_point(soup.positions[t[0]]), to_point(soup.positions[t[1]]),
                                 to_point(soup.positions[t[2]])};
        if (!detail::has_zero_area(corners)) out.push_back(corners);
    }
    return out;
}

struct Tally {
    int cases = 0, hits = 0, at_start = 0, overlapping = 0, stayed = 0;
    std::uint64_t exact = 0, retreats = 0;
};

template <class Scalar>
void judge(const TriangleSoup<Scalar>& soup, const CollisionMesh<Scalar>& mesh, const SphereCase<Scalar>& c,
           Tally& tally) {
    const Path path = to_path(c.step);
    const auto radius = static_cast<double>(c.radius);
    QueryCounters counters;
    const auto hit = mesh.sweep_sphere(c.step, c.radius, {.counters = &counters});
    tally.exact += counters.exact_decisions;
    tally.retreats += counters.retreats;
    ++tally.cases;
    const SphereOracle oracle(path, radius);
    const std::vector<Corners> all = corners_of(soup);
    if (!hit) {
        for (const Corners& corners : all) ASSERT_FALSE(oracle.hits(corners)) << "missed";
        return;
    }
    ++tally.hits;
    ASSERT_GE(hit->fraction, 0);
    ASSERT_LE(hit->fraction, 1);
    // Not later than the true time, and earlier by at most 2^-21 and a rounding.
    const auto fraction = static_cast<double>(hit->fraction);
    mpq_class later = mpq_class(fraction) * (1 + mpq_class(1, 1 << 23)) + mpq_class(1, 1 << 21);
    if (later > 1) later = 1;
    bool any = false;
    for (const Corners& corners : all) {
        ASSERT_FALSE(fraction > 0 && oracle.hits(corners, fraction)) << "the time is later than the true one";
        any = any || oracle.hits(corners, later);
    }
    ASSERT_TRUE(any) << "the time is too early, or nothing is hit";
    // What is named is hit, at the time.
    const IndexTriple& t = soup.triangles[hit->triangle];
    const Corners named = {to_point(soup.positions[t[0]]), to_point(soup.positions[t[1]]),
                           to_point(soup.positions[t[2]])};
    ASSERT_TRUE(oracle.hits(named, later));
    ASSERT_EQ(hit->overlap > 0, hit->at_start && oracle.gap(named) < 0);
    if (hit->at_start) {
        ++tally.at_start;
        ASSERT_LE(oracle.gap(named), 0);
        ASSERT_EQ(hit->fraction, 0);
        ASSERT_TRUE(hit->center == c.step.from);
    }
    if (hit->overlap > 0) ++tally.overlapping;
    // The center, and the way to it.
    const Vec3<Scalar> center = hit->center;
    if (center == c.step.from) {
        ++tally.stayed;
    } else {
        const SphereOracle way({path.from, to_point(center)}, radius);
        for (const Corners& corners : all) ASSERT_FALSE(way.hits(corners)) << "the way to the center is not clear";
        const SphereOracle rest({to_point(center), to_point(center)}, radius);
        for (const Corners& corners : all)
            ASSERT_FALSE(oracle.gap(corners) >= 0 && rest.gap(corners) < 0) << "the center penetrates";
    }
    ASSERT_NEAR(hit->normal.norm(), 1, 1e-6);
}

template <class Scalar>
void run(int meshes, int cases_each, std::uint64_t seed) {
    Random random(seed);
    Tally tally;
    for (int m = 0; m < meshes && !::testing::Test::HasFatalFailure(); ++m) {
        const double offset = random.chance(0.6) ? 0 : random.chance(0.5) ? 1e3 : 1e6;
        const double scale = random.chance(0.5) ? 1 : std::pow(10.0, random.between(-3, 3));
        const TriangleSoup<Scalar> soup = moved<Scalar>(small_mesh(random), scale, {offset, -offset, offset});
        const CollisionMesh<Scalar> mesh(soup.view());
        for (int i = 0; i < cases_each; ++i) {
            const SphereCase<Scalar> c = sphere_case(soup, random, scale);
            judge(soup, mesh, c, tally);
            if (::testing::Test::HasFatalFailure()) {
                const auto& s = c.step;
                std::printf("mesh %d case %d radius %a\nfrom %a %a %a\nto %a %a %a\n", m, i, double(c.radius),
                            double(s.from[0]), double(s.from[1]), double(s.from[2]), double(s.to[0]), double(s.to[1]),
                            double(s.to[2]));
                for (const IndexTriple& t : soup.triangles)
                    for (const auto v : t)
                        std::printf("  %a %a %a\n", double(soup.positions[v][0]), double(soup.positions[v][1]),
                                    double(soup.positions[v][2]));
                return;
            }
        }
    }
    std::printf("%d cases: %d hits, %d at the start, %d of them overlapping, %d stayed; %llu exact, %llu retreats\n",
                tally.cases, tally.hits, tally.at_start, tally.overlapping, tally.stayed,
                static_cast<unsigned long long>(tally.exact), static_cast<unsigned long long>(tally.retreats));
    EXPECT_GT(tally.hits, tally.cases / 3);
    EXPECT_GT(tally.cases - tally.hits, tally.cases / 10);
    EXPECT_GT(tally.at_start, tally.cases / 100);
    EXPECT_GT(tally.at_start, tally.overlapping);
    EXPECT_LT(tally.stayed, tally.hits / 2);
}

TEST(SphereJudge, SweepsAreThoseOfRationalArithmetic) {
    run<float>(100, 30, 1);
    run<double>(60, 30, 2);
}
TEST(SphereJudgeSoak, SweepsAreThoseOfRationalArithmeticFloat) { run<float>(16'000, 40, 3); }
TEST(SphereJudgeSoak, SweepsAreThoseOfRationalArithmeticDouble) { run<double>(10'000, 40, 4); }

}  // namespace
}  // namespace pierce::test
