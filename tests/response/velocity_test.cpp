// Velocities after contacts: slide and bounce by their formulas, the nearest of several planes against a search, and a
// surface that moves.
#include <gtest/gtest.h>

#include "ramps.h"

namespace pierce::test {
namespace {

TEST(Velocities, a_slide_loses_what_goes_into_the_surface) {
    const V n = V(1, 2, 2) / 3;
    const V v(3, -1, -2);
    const V left = slide(v, n);
    EXPECT_NEAR(left.dot(n), 0, 1e-15);
    EXPECT_LT((left - (v - v.dot(n) * n)).norm(), 1e-15);
    EXPECT_EQ(slide(V(-v), n), V(-v)) << "out of it nothing is lost";
    EXPECT_EQ(slide(V(0, 0, -5), V(0, 0, 1)), V(0, 0, 0));
    // Seen from a surface that comes, it goes in faster; one that goes away faster than it is left alone.
    EXPECT_LT((slide(V(1, 0, -2), V(0, 0, 1), V(7, 0, 3)) - V(1, 0, 3)).norm(), 1e-15);
    EXPECT_EQ(slide(V(1, 0, -2), V(0, 0, 1), V(7, 0, -3)), V(1, 0, -2));
}

TEST(Velocities, a_bounce_gives_back_its_restitution) {
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const V n = random.direction();
        V v = 10 * random.in_cube();
        if (v.dot(n) > 0) v = -v;
        const double e = random.unit();
        const double mu = i % 3 == 0 ? 0 : random.unit();
        const V with = i % 2 == 0 ? V(V::Zero()) : V(random.in_cube());
        const V seen = v - with;
        if (seen.dot(n) > 0) continue;
        const V after = bounce(v, n, e, mu, with) - with;
        EXPECT_NEAR(after.dot(n), -e * seen.dot(n), 1e-13);
        const V along = seen - seen.dot(n) * n;
        const V along_after = after - after.dot(n) * n;
        const double less = std::min(along.norm(), mu * (1 + e) * -seen.dot(n));
        EXPECT_NEAR(along_after.norm(), along.norm() - less, 1e-13);
        EXPECT_GE(along_after.dot(along), -1e-13) << "friction does not turn it round";
        if (mu > 0) continue;
        EXPECT_NEAR(after.squaredNorm(), seen.squaredNorm() - (1 - e * e) * std::pow(seen.dot(n), 2), 1e-12);
    }
    EXPECT_EQ(bounce(V(1, 0, 2), V(0, 0, 1), 0.5, 0.5), V(1, 0, 2)) << "it goes out already";
    EXPECT_EQ(bounce(V(1, 2, -2), V(0, 0, 1), 1), V(1, 2, 2));
    EXPECT_EQ(bounce(V(0.1, 0, -2), V(0, 0, 1), 0, 0.5), V(0, 0, 0));
}

// The nearest velocity that goes into no plane, by Dykstra's alternating projections (1983), which know no cases.
V nearest_by_dykstra(const V& v, const std::vector<V>& normals) {
    V x = v;
    std::vector<V> correction(normals.size(), V::Zero());
    for (int round = 0; round < 20'000; ++round)
        for (std::size_t i = 0; i < normals.size(); ++i) {
            const V y = x + correction[i];
            x = y - std::min(0.0, y.dot(normals[i])) * normals[i];
            correction[i] = y - x;
        }
    return x;
}

TEST(Velocities, several_planes_leave_the_nearest_velocity) {
    Random random(2);
    int kinds[4] = {};
    for (int i = 0; i < 300; ++i) {
        std::vector<V> normals;
        const std::size_t count = 1 + random.below(5);
        const V up = random.direction();
        for (std::size_t k = 0; k < count; ++k) {
            const V n = random.direction();
            normals.push_back(random.chance(0.5) ? V((n + 1.2 * up).normalized()) : n);
        }
        const V v = 3 * random.in_cube();
        const V left = slide(v, normals);
        const V expected = nearest_by_dykstra(v, normals);
        EXPECT_LT((left - expected).norm(), 1e-3 * v.norm()) << i;
        int held = 0;
        for (const V& n : normals) {
            EXPECT_GE(left.dot(n), -1e-14 * v.norm());
            held += std::abs(left.dot(n)) < 1e-9 ? 1 : 0;
        }
        ++kinds[left == V(V::Zero()) ? 3 : std::min(held, 2)];
        std::reverse(normals.begin(), normals.end());
        EXPECT_LT((slide(v, normals) - left).norm(), 1e-13 * v.norm()) << "the order of planes does not matter";
    }
    for (const int kind : kinds) EXPECT_GT(kind, 5);  // free, a plane, a crease, a stop: all of them came
}

TEST(Velocities, planes_that_differ_by_rounding_are_one) {
    using F = Vec3<float>;
    const F n = F(1, 2, 3).normalized();
    F m = n;
    m[0] = std::nextafter(m[0], 2.0F);
    const F v(5, -4, -3);
    const F one = slide(v, std::vector<F>{n});
    EXPECT_LT((slide(v, std::vector<F>{n, m}) - one).norm(), 1e-5F);
    EXPECT_LT((slide(v, std::vector<F>{m, n}) - one).norm(), 1e-5F);
    EXPECT_EQ(slide(F(-n * 3), std::vector<F>{n, m}), F(0, 0, 0)) << "what rounding leaves of it is nothing";
}

TEST(Velocities, extreme_and_meaningless_numbers_are_total) {
    const double huge = 1e300;
    EXPECT_LT((slide(V(huge, 0, -huge), std::vector<V>{V(0, 0, 1), V(0, 1, 0)}) / huge - V(1, 0, 0)).norm(), 1e-14);
    EXPECT_LT((bounce(V(huge, 0, -huge), V(0, 0, 1), 0.5, 0.25) / huge - V(0.625, 0, 0.5)).norm(), 1e-14);
    EXPECT_LT((bounce(V(1e-300, 0, -1e-300), V(0, 0, 1), 0.5, 0.25) * 1e300 - V(0.625, 0, 0.5)).norm(), 1e-14);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(bounce(V(nan, 0, -1), V(0, 0, 1), 0.5, 0.25).allFinite());
    EXPECT_FALSE(slide(V(1, nan, -1), V(0, 0, 1)).allFinite());
    EXPECT_FALSE(slide(V(1, nan, -1), std::vector<V>{V(0, 0, 1)}).allFinite());
    (void)slide(V(1, 2, -1), std::vector<V>{V(0, nan, 1), V(0, 0, 1)});
    EXPECT_EQ(slide(V(1, 2, -1), std::vector<V>{}), V(1, 2, -1));
}

}  // namespace
}  // namespace pierce::test
