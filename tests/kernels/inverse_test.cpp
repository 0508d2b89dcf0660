// What is stored is what it should be: maps take the corners to the unit triangle, and nothing hits a triangle without
// area.
#include <cstdio>
#include <limits>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include <kernels/all_kernels.h>

namespace pierce::test {
namespace {

using Corners = std::array<Vec3<double>, 3>;

/// Triangles of moderate shape whose normal is largest along each axis, in either direction, in turn.
template <class Check>
void for_triangles(Check&& check) {
    Random random(11);
    std::array<int, 6> seen{};
    for (int i = 0; i < 20'000; ++i) {
        const Corners t = {random.in_cube(), random.in_cube(), random.in_cube()};
        const Margins m(t, random.in_cube(), random.in_cube());
        if (m.aspect > 50) continue;
        const Vec3<double> n = (t[1] - t[0]).cross(t[2] - t[0]);
        Eigen::Index axis = 0;
        n.cwiseAbs().maxCoeff(&axis);
        ++seen[static_cast<std::size_t>(axis + (n[axis] < 0 ? 3 : 0))];
        check(t, static_cast<std::size_t>(axis), n[axis] < 0);
    }
    for (const int count : seen) EXPECT_GT(count, 1'000);
}

constexpr double k_tolerance = 2e-12;  // 50^2 roundings, and a few

TEST(StoredForms, BaldwinAndWebersRowsInvertTheMapFromTheUnitTriangle) {
    for_triangles([](const Corners& t, std::size_t k, bool negative) {
        const auto stored = kernels::baldwin_weber_12.prepare(t[0], t[1], t[2]);
        Vec3<double> f = Vec3<double>::Zero();
        f[static_cast<Eigen::Index>(k)] = negative ? -1 : 1;
        // The columns of the source's matrix T, and what its inverse has to make of them.
        const std::array<Vec3<double>, 4> points = {t[0], t[1], t[2], t[0] + f};
        const std::array<std::array<double, 3>, 4> images = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        for (std::size_t p = 0; p < 4; ++p) {
            const auto x = kernels::triple(points[p]);
            EXPECT_NEAR(stored.u(x), images[p][0], k_tolerance);
            EXPECT_NEAR(stored.v(x), images[p][1], k_tolerance);
            EXPECT_NEAR(stored.height(x), images[p][2], k_tolerance);
        }
        EXPECT_EQ(stored.u.normal[k], 0);
        EXPECT_EQ(stored.v.normal[k], 0);
        EXPECT_EQ(stored.height.normal[k], f[static_cast<Eigen::Index>(k)]);
    });
}

TEST(StoredForms, NineNumbersAreTheTwelveWithoutWhatIsKnown) {
    for_triangles([](const Corners& t, std::size_t k, bool negative) {
        const auto nine = kernels::baldwin_weber_9.prepare(t[0], t[1], t[2]);
        ASSERT_EQ(nine.column, k + (negative ? 3U : 0U));
        const std::array<std::array<double, 3>, 3> images = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
        for (std::size_t p = 0; p < 3; ++p) {
            const auto x = kernels::from_column(nine.column, kernels::triple(t[p]));
            EXPECT_NEAR(nine.u(x), images[p][0], k_tolerance);
            EXPECT_NEAR(nine.v(x), images[p][1], k_tolerance);
            EXPECT_NEAR(x[0] + nine.height(x), images[p][2], k_tolerance);
        }
    });
}

TEST(StoredForms, BloomsPlanesReadOneAtTheOppositeCorner) {
    for_triangles([](const Corners& t, std::size_t, bool) {
        const auto stored = kernels::bloom.prepare(t[0], t[1], t[2]);
        const Vec3<double> n = (t[1] - t[0]).cross(t[2] - t[0]);
        for (std::size_t p = 0; p < 3; ++p) {
            const auto x = kernels::triple(t[p]);
            EXPECT_NEAR(stored.height(x), 0, k_tolerance);
            EXPECT_NEAR(stored.weight_c(x), p == 2 ? 1 : 0, k_tolerance);
            EXPECT_NEAR(stored.weight_a(x), p == 0 ? 1 : 0, k_tolerance);
            const auto above = kernels::triple<double>(t[p] + n);
            EXPECT_GT(stored.height(above), 0);
            EXPECT_NEAR(stored.weight_c(above), p == 2 ? 1 : 0, k_tolerance);  // the planes contain the normal
        }
    });
}

/// Segments through the middle of what would be the triangle, along many directions: how many hit it.
template <class Kernel, class Scalar>
int hits_of(const Kernel& kernel, const std::array<Vec3<Scalar>, 3>& t, Random& random) {
    int hits = 0;
    for (int i = 0; i < 50; ++i) {
        const Vec3<double> w = random.weights();
        const Vec3<double> x = w[0] * t[0].template cast<double>() + w[1] * t[1].template cast<double>() +
                               w[2] * t[2].template cast<double>();
        const Vec3<double> d = random.direction();
        hits += tested(kernel, t, Vec3<Scalar>((x + d).template cast<Scalar>()),
                       Vec3<Scalar>((x - d).template cast<Scalar>()))
                    ? 1
                    : 0;
    }
    return hits;
}

TEST(Degenerate, OnALatticeNoKernelHitsATriangleWithoutArea) {
    Random random(5);
    const auto small = [&random] {
        return Vec3<float>(float(random.between_ints(-8, 8)), float(random.between_ints(-8, 8)),
                           float(random.between_ints(-8, 8)));
    };
    for (int i = 0; i < 2'000; ++i) {
        const Vec3<float> a = small();
        const Vec3<float> step = small();
        const std::array<Vec3<float>, 3> t = {a, a + float(random.between_ints(-2, 2)) * step,
                                              a + float(random.between_ints(-2, 2)) * step};
        const Vec3<float> from = small();
        const Vec3<float> to = small();
        for_each_kernel(
            [&](const char* name, const auto& kernel) { EXPECT_FALSE(tested(kernel, t, from, to)) << name; });
        EXPECT_FALSE(tested(kernels::exact, t, from, to));
    }
}

TEST(Degenerate, EqualCornersAreNeverHitWhereANormalOrEdgeFunctionsAreComputed) {
    Random random(6);
    std::map<std::string, int> hits;
    for (int i = 0; i < 4'000; ++i) {
        std::array<Vec3<float>, 3> t = {random.in_cube().cast<float>(), random.in_cube().cast<float>(),
                                        random.in_cube().cast<float>()};
        const std::size_t k = random.below(3);
        t[k] = t[(k + 1) % 3];
        for_each_kernel([&](const char* name, const auto& kernel) { hits[name] += hits_of(kernel, t, random); });
        hits["exact"] += hits_of(kernels::exact, t, random);
    }
    for (const auto& [name, count] : hits) {
        std::printf("%-17s %d of 200000 segments hit a triangle with two equal corners\n", name.c_str(), count);
        if (name == "moller_trumbore")
            EXPECT_GT(count, 0) << name << ": its documentation says that it can";
        else
            EXPECT_EQ(count, 0) << name;
    }
}

TEST(Degenerate, ASegmentThatIsAPointOrNotANumberNeverHits) {
    const std::array<Vec3<double>, 3> t = {Vec3<double>{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto never = [&](const char* name, const auto& kernel) {
        EXPECT_TRUE(tested(kernel, t, {1, 1, 1}, {1, 1, -1})) << name;
        EXPECT_FALSE(tested(kernel, t, {1, 1, 0}, {1, 1, 0})) << name;
        EXPECT_FALSE(tested(kernel, t, {1, 1, 0}, {2, 1, 0})) << name;  // in the plane
        for (int k = 0; k < 3; ++k) {
            Vec3<double> from(1, 1, 1);
            Vec3<double> to(1, 1, -1);
            from[k] = nan;
            EXPECT_FALSE(tested(kernel, t, from, to)) << name;
            from[k] = 1;
            to[k] = nan;
            EXPECT_FALSE(tested(kernel, t, from, to)) << name;
            for (std::size_t corner = 0; corner < 3; ++corner) {
                std::array<Vec3<double>, 3> broken = t;
                broken[corner][k] = nan;
                EXPECT_FALSE(tested(kernel, broken, {1, 1, 1}, {1, 1, -1})) << name;
            }
        }
    };
    for_each_kernel(never);
    never("exact", kernels::exact);
}

}  // namespace
}  // namespace pierce::test
