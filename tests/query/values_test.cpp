// The values of a hit are those of the true intersection, within the units in the last place that hit.h documents:
// against rational numbers, for float and double, on generic and on delicate pairs, whichever arithmetic they came
// from.
#include <gtest/gtest.h>
#include <kernel/evaluate.h>
#include <pierce/pierce.h>
#include <query/values.h>
#include <support/oracles.h>
#include <support/pairs.h>

namespace pierce::test {
namespace {

using Q = RationalOracle::Q;

template <class Scalar>
void check_values() {
    Random random(21);
    double fraction = 0;
    double weight = 0;
    double normal = 0;
    int hits = 0;
    // Hits by the arithmetic that their values needed, and queries whose verified point needed the exact side of a
    // plane.
    int coarse = 0;
    int fine = 0;
    int exact_values = 0;
    int exact_sides = 0;
    for (int i = 0; i < 30'000; ++i) {
        const auto family = static_cast<Family>(random.below(k_family_names.size()));
        const double offset = std::array{0.0, 1e3, 1e6}[random.below(3)];
        const double scale = std::array{1e-3, 1.0, 1e3}[random.below(3)];
        const Pair pair = make_pair_of<Scalar>(family, scale, offset, random);
        const auto vec = [](const detail::Point& p) { return Vec3<double>(p[0], p[1], p[2]).cast<Scalar>().eval(); };
        const TriangleSoup<Scalar> soup{
            {vec(pair.corners[0]), vec(pair.corners[1]), vec(pair.corners[2])}, {{0, 1, 2}}, {}};
        const CollisionMesh<Scalar> mesh(soup.view());
        QueryCounters counters;
        const auto hit =
            mesh.first_hit({vec(pair.path.from), vec(pair.path.to)}, {.sides = Sides::both, .counters = &counters});
        const RationalOracle exact(pair.path, pair.corners);
        ASSERT_EQ(hit.has_value(), exact.hit(Sides::both)) << describe(pair);
        if (!hit) continue;
        ++hits;
        constexpr double tolerance = detail::k_tolerance<Scalar>;
        detail::Measured measured;
        detail::Values values;
        detail::measure_path<Scalar>(pair.corners, pair.path, measured);
        detail::evaluate<Scalar, detail::TwoPairs>(measured, measured.meeting, 1, values);
        if (counters.exact_values > 0)
            ++exact_values;
        else if (values.weight_error <= tolerance && values.fraction_error <= tolerance * values.weights[3] &&
                 values.normal_error <= tolerance * values.length)
            ++coarse;
        else
            ++fine;
        exact_sides += counters.exact_sides > 0 ? 1 : 0;
        fraction = std::max(fraction, ulps(hit->exact_fraction, exact.fraction(), CGAL::to_double(exact.fraction())));
        ASSERT_LE(Q(double(hit->fraction)), exact.fraction()) << "a lower bound: " << describe(pair);
        // Exactly 0 is what these are, not nearly.
        ASSERT_TRUE(!hit->at_start || hit->exact_fraction == 0) << describe(pair);
        for (int k = 0; k < 3; ++k) {
            const bool off = hit->feature == Feature::edge     ? k == (hit->feature_index + 2) % 3
                             : hit->feature == Feature::vertex ? k != hit->feature_index
                                                               : false;
            ASSERT_TRUE(!off || hit->barycentric[k] == 0) << describe(pair);
        }
        Vec3<double> direction;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto at = static_cast<int>(k);
            weight = std::max(weight, ulps(hit->barycentric[at], exact.weight(k), 1));
            ASSERT_GE(hit->barycentric[at], 0) << describe(pair);
            ASSERT_LE(hit->barycentric[at], 1) << describe(pair);
            direction[at] = exact.normal_ratio(k);
        }
        direction.normalize();
        for (int k = 0; k < 3; ++k) normal = std::max(normal, ulps(hit->normal[k], Q(direction[k]), 1));
    }
    std::cout << hits << " hits; off by at most: fraction " << fraction << ", weights " << weight << ", normal "
              << normal << " units in the last place; " << coarse << " in double, " << fine << " in double-double, "
              << exact_values << " exact; sides of " << exact_sides << " exact\n";
    EXPECT_GT(hits, 3000);
    EXPECT_GT(fine, 500);
    // For float few are left: those of edges and corners are known from volumes, and bounds are rarely too wide.
    EXPECT_GT(exact_values, sizeof(Scalar) == sizeof(float) ? 10 : 500);
    // For float, double-double says the side wherever it says the place.
    EXPECT_GT(exact_sides, sizeof(Scalar) == sizeof(double) ? 10 : -1);
    if (std::is_same_v<Scalar, float>)
        EXPECT_GT(coarse, 500);
    else
        EXPECT_EQ(coarse, 0);
    EXPECT_LE(fraction, 1);
    EXPECT_LE(weight, 1);
    EXPECT_LE(normal, 4);
    EXPECT_GT(fraction, 0.4);  // a comparison that sees no rounding looks at the wrong thing
}

TEST(Values, are_within_their_documented_error_in_float) { check_values<float>(); }
TEST(Values, are_within_their_documented_error_in_double) { check_values<double>(); }

}  // namespace
}  // namespace pierce::test
