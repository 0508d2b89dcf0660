// Every decision is that of exact arithmetic: the exact room, and the filter where it is certain, against CGAL and
// rational numbers.
#include <gtest/gtest.h>
#include <exact/fraction.h>
#include <kernel/filter.h>
#include <support/oracles.h>
#include <support/pairs.h>

namespace pierce::test {
namespace {

using detail::Decision;
using detail::Filtered;
using detail::Verdict;

struct Tally {
    std::int64_t decisions = 0;
    std::int64_t hits = 0;
    std::int64_t certain = 0;
    std::int64_t undefined = 0;  // for CGAL
};

// What the traversal does with one triangle: the filter, and the exact room where that is in doubt. Both must agree
// with the judge.
void check(const Pair& pair, Sides sides, bool truth, Tally& tally) {
    const Decision decision = detail::decide(pair.path, pair.corners, sides);
    ASSERT_EQ(decision.hit, truth) << describe(pair);
    ++tally.decisions;
    tally.hits += truth ? 1 : 0;
    if (detail::has_zero_area(pair.corners)) return;
    detail::Measured measured;
    detail::measure_path<double>(pair.corners, pair.path, measured);
    const Filtered filtered = detail::filter(measured, sides);
    if (filtered.verdict == Verdict::doubtful) return;
    ++tally.certain;
    ASSERT_EQ(filtered.verdict == Verdict::hit, truth) << "the filter was certain: " << describe(pair);
    if (!truth) return;
    ASSERT_EQ(filtered.decision.side, decision.side) << describe(pair);
    ASSERT_EQ(filtered.decision.feature, decision.feature) << describe(pair);
    ASSERT_EQ(filtered.decision.at_start, decision.at_start) << describe(pair);
    ASSERT_TRUE(detail::fraction_at_most(pair.path, pair.corners, filtered.latest)) << describe(pair);
    ASSERT_FALSE(detail::fraction_at_most(pair.path, pair.corners, std::nextafter(filtered.earliest, -1)))
        << describe(pair);
}

constexpr std::array<double, 3> k_offsets = {0, 1e3, 1e6};
constexpr std::array<double, 5> k_scales = {1e-6, 1e-3, 1, 1e3, 1e6};
constexpr std::array<Sides, 3> k_sides = {Sides::front, Sides::back, Sides::both};

template <class Scalar, class Judge>
Tally run(std::int64_t each, std::uint64_t seed, Judge&& judge) {
    Tally all;
    Random random(seed);
    for (std::size_t f = 0; f < k_family_names.size(); ++f) {
        Tally tally;
        for (double offset : k_offsets)
            for (double scale : k_scales)
                for (std::int64_t i = 0; i < each; ++i) {
                    const Pair pair = make_pair_of<Scalar>(static_cast<Family>(f), scale, offset, random);
                    judge(pair, k_sides[static_cast<std::size_t>(i % 3)], tally);
                    if (::testing::Test::HasFatalFailure()) return all;
                }
        std::cout << k_family_names[f] << ": " << tally.decisions << " decisions, " << tally.hits << " hits, "
                  << tally.certain << " by the filter, " << tally.undefined << " undefined for CGAL\n";
        // A family that never hits, or always does, would prove nothing.
        EXPECT_GT(tally.hits, tally.decisions / 1000) << k_family_names[f];
        EXPECT_LT(tally.hits, tally.decisions) << k_family_names[f];
        all.decisions += tally.decisions;
        all.undefined += tally.undefined;
    }
    return all;
}

template <class Scalar>
void against_cgal(std::int64_t each, std::uint64_t seed) {
    const Tally all = run<Scalar>(each, seed, [](const Pair& pair, Sides sides, Tally& tally) {
        const CgalOracle cgal(pair.path, pair.corners);
        if (cgal.defined()) {
            check(pair, sides, cgal.hit(sides), tally);
        } else {
            ++tally.undefined;
            check(pair, sides, RationalOracle(pair.path, pair.corners).hit(sides), tally);
        }
    });
    EXPECT_GE(all.decisions - all.undefined, 5'000'000);
}

// 9 families x 15 places x 56,000 for each scalar type; more than ten million of them are judged by CGAL.
TEST(Decisions, agree_with_cgal_in_float) { against_cgal<float>(56'000, 1); }
TEST(Decisions, agree_with_cgal_in_double) { against_cgal<double>(56'000, 2); }

// Within how many units in the last place of `Scalar` is `value` of the exact one?
double ulps(double value, const CGAL::Gmpq& exact) {
    const double near = CGAL::to_double(exact);
    const double ulp = std::nextafter(std::abs(near), std::numeric_limits<double>::infinity()) - std::abs(near);
    return std::abs(CGAL::to_double((CGAL::Gmpq(value) - exact) / CGAL::Gmpq(ulp)));
}

template <class Scalar>
void against_rationals(std::int64_t each, std::uint64_t seed) {
    double worst = 0;
    run<Scalar>(each, seed, [&](const Pair& pair, Sides sides, Tally& tally) {
        const RationalOracle rational(pair.path, pair.corners);
        check(pair, sides, rational.hit(sides), tally);
        const Decision decision = detail::decide(pair.path, pair.corners, sides);
        if (!decision.hit) return;
        const detail::Measures measures = detail::measure(pair.path, pair.corners);
        worst = std::max(worst, ulps(measures.fraction, rational.fraction()));
        int zeros = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            worst = std::max(worst, ulps(measures.barycentric[k], rational.weight(k)));
            zeros += rational.weight(k) == 0 ? 1 : 0;
            const bool off = decision.feature == Feature::edge && (decision.feature_index + 2U) % 3 == k;
            const bool all = decision.feature == Feature::vertex && decision.feature_index == k;
            ASSERT_TRUE(!off || rational.weight(k) == 0) << describe(pair);
            ASSERT_TRUE(!all || rational.weight(k) == 1) << describe(pair);
        }
        ASSERT_EQ(static_cast<int>(decision.feature), zeros) << describe(pair);
        ASSERT_EQ(decision.at_start, rational.from_side() == 0) << describe(pair);
    });
    std::cout << "worst error " << worst << " ulp\n";
    EXPECT_LT(worst, 0.505);
    EXPECT_GT(worst, 0.45);  // a test that sees no rounding at all looks at the wrong thing
}

TEST(Decisions, agree_with_rationals_in_float) { against_rationals<float>(300, 3); }
TEST(Decisions, agree_with_rationals_in_double) { against_rationals<double>(300, 4); }

}  // namespace
}  // namespace pierce::test
