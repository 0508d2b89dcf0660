// The exact room for coordinates whose exponents have nothing to do with one another, against rational numbers:
// subnormal, huge and ordinary ones in one triangle. The other tests scale all coordinates alike and never leave the
// integers of a fixed width.
#include <gtest/gtest.h>
#include <exact/crossing.h>
#include <exact/fraction.h>
#include <exact/planes.h>
#include <support/oracles.h>
#include <support/random.h>

namespace pierce::test {
namespace {

using namespace detail;
using Q = CGAL::Gmpq;

enum class Spread { hundred, rest_on_zero, all, lattice };

struct Pair {
    Path path;
    Corners corners;
};

Pair make(Spread spread, Random& random) {
    Point axis = {1, 1, 1};
    if (spread == Spread::lattice)
        for (double& x : axis) x = std::exp2(random.between_ints(-1000, 1000));
    const auto coordinate = [&](std::size_t k) {
        const double x = random.between(-1, 1);
        switch (spread) {
            case Spread::hundred: return x * std::exp2(random.between(-330, 330));
            case Spread::all: return x * std::exp2(random.between(-1074, 1020));
            case Spread::lattice: return axis[k] * random.between_ints(-3, 3);
            case Spread::rest_on_zero: break;
        }
        return x;
    };
    Pair pair{};
    for (std::size_t k = 0; k < 3; ++k) {
        for (Point& corner : pair.corners) corner[k] = coordinate(k);
        pair.path.from[k] = coordinate(k);
        pair.path.to[k] = coordinate(k);
    }
    if (spread == Spread::rest_on_zero) {
        for (Point& corner : pair.corners) corner[2] = 0;
        pair.path.from[2] = (random.chance(0.5) ? 5e-324 : 1.2345e-300) * (random.chance(0.5) ? 1 : -1);
        pair.path.to[2] = pair.path.from[2] > 0 ? -0.01 : 0.01;
        if (random.chance(0.3)) std::swap(pair.path.from, pair.path.to);
    }
    if (random.chance(0.1)) pair.path.from = pair.corners[0];
    if (random.chance(0.1)) pair.path.to = pair.corners[1];
    return pair;
}

double ulps(double value, const Q& exact) {
    const double ulp = std::nextafter(std::abs(value), std::numeric_limits<double>::infinity()) - std::abs(value);
    return std::abs(CGAL::to_double((Q(value) - exact) / Q(ulp)));
}

void check_values(const Pair& pair, const RationalOracle& exact, Random& random, double& worst) {
    const auto& [path, corners] = pair;
    const Measures values = measure(path, corners);
    if (values.fraction > 1e-300) worst = std::max(worst, ulps(values.fraction, exact.fraction()));
    for (std::size_t k = 0; k < 3; ++k)
        if (values.barycentric[k] > 1e-300) worst = std::max(worst, ulps(values.barycentric[k], exact.weight(k)));
    for (const double limit :
         {values.fraction, std::nextafter(values.fraction, 0.0), std::nextafter(values.fraction, 1.0), random.unit()})
        ASSERT_EQ(fraction_at_most(path, corners, limit), Q(limit) >= exact.fraction());
    // Of one that shares its edge, as it is or with its third corner moved.
    Corners other = {corners[1], corners[0], corners[2]};
    if (random.chance(0.5))
        for (double& x : other[2]) x *= random.between(0.9, 1.1);
    const RationalOracle second(path, other);
    if (!second.hit(Sides::front) && !second.hit(Sides::back)) return;
    const int order = compare_fractions(path, corners, other);
    ASSERT_EQ((order > 0) - (order < 0), static_cast<int>(CGAL::compare(exact.fraction(), second.fraction())));
}

TEST(Exponents, of_any_spread_give_exact_answers) {
    Random random(8);
    for (const Spread spread : {Spread::hundred, Spread::rest_on_zero, Spread::all, Spread::lattice}) {
        int hits = 0;
        double worst = 0;
        for (int i = 0; i < 10'000; ++i) {
            const Pair pair = make(spread, random);
            const auto& [path, corners] = pair;
            const auto sides = static_cast<Sides>(random.below(3));
            const RationalOracle exact(path, corners);
            ASSERT_EQ(decide(path, corners, sides).hit, exact.hit(sides)) << i;
            ASSERT_EQ(side_of(corners, path.from), static_cast<int>(CGAL::sign(exact.from_side()))) << i;
            ASSERT_EQ(has_zero_area(corners), exact.zero_area()) << i;
            const int crossed = crossing(path, corners);
            ASSERT_EQ(crossing({path.to, path.from}, corners), -crossed) << i;
            ASSERT_EQ(crossing(path, {corners[0], corners[2], corners[1]}), -crossed) << i;
            const bool generic = exact.from_side() != 0 && exact.to_side() != 0 && exact.weight(0) != 0 &&
                                 exact.weight(1) != 0 && exact.weight(2) != 0;
            if (generic) {
                ASSERT_EQ(crossed, !exact.hit(Sides::both) ? 0 : exact.from_side() > 0 ? 1 : -1) << i;
            }
            if (exact.hit(sides)) {
                ++hits;
                check_values(pair, exact, random, worst);
                if (HasFatalFailure()) return;
            }
            if (exact.zero_area()) continue;
            const Point normal = exact_planes(corners).normal;
            const double largest = std::max({std::abs(normal[0]), std::abs(normal[1]), std::abs(normal[2])});
            for (std::size_t k = 0; k < 3; ++k) ASSERT_NEAR(normal[k] / largest, exact.normal_ratio(k), 0x1p-51) << i;
        }
        EXPECT_GT(hits, 500);
        EXPECT_LT(worst, 0.505);
        EXPECT_GT(worst, 0.45);
    }
}

}  // namespace
}  // namespace pierce::test
