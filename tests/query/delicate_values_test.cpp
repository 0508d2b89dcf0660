// The values of hits for which a rounded computation is at its worst: they must be as good as all others.
//
// For floats the library takes values from the filter's numbers where their bound says that they are good enough. With
// a bound a thousand times looser, and with the care for denormal numbers taken out, every test passed: random hits are
// too easy. Here the segment starts close to a plane whose corners are far away (the fraction has few good digits), or
// passes it at a grazing angle (the weights have few); and fractions and coordinates are denormal. The judge is
// rational arithmetic.
#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <support/oracles.h>
#include <support/random.h>

namespace pierce::test {
namespace {

using V = Vec3<double>;
using Q = RationalOracle::Q;

template <class Scalar>
struct One {
    std::array<Vec3<Scalar>, 3> corners;
    Segment<Scalar> segment;

    [[nodiscard]] RationalOracle exact() const {
        const auto p = [](const Vec3<Scalar>& v) { return detail::to_point(v); };
        return {{p(segment.from), p(segment.to)}, {p(corners[0]), p(corners[1]), p(corners[2])}};
    }
    [[nodiscard]] std::optional<Hit<Scalar>> hit() const {
        const std::vector<IndexTriple> triangles = {{0, 1, 2}};
        return CollisionMesh<Scalar>({corners, triangles}).first_hit(segment, {.sides = Sides::both});
    }
};

struct Worst {
    int hits = 0;
    double fraction = 0;
    double weight = 0;

    void add(const One<float>& one) {
        const auto hit = one.hit();
        if (!hit) return;
        const RationalOracle exact = one.exact();
        ++hits;
        fraction = std::max(fraction, ulps(hit->exact_fraction, exact.fraction(), CGAL::to_double(exact.fraction())));
        for (std::size_t k = 0; k < 3; ++k)
            weight = std::max(weight, ulps(hit->barycentric[static_cast<int>(k)], exact.weight(k), 1));
    }
    void expect(const char* what) const {
        std::cout << what << ": " << hits << " hits; off by at most: fraction " << fraction << ", weights " << weight
                  << " units in the last place\n";
        EXPECT_GT(hits, 10'000) << what;
        // Promised is 1. Kept is what one correct rounding gives, 1/2 and for the weights, which are below 1, 1/4; and
        // a hair: a looser filter's numbers would show here long before they break the promise.
        EXPECT_LE(fraction, 0.5 + 0x1p-5) << what;
        EXPECT_LE(weight, 0.25 + 0x1p-5) << what;
    }
};

TEST(DelicateValues, of_a_start_close_to_a_plane_of_far_corners) {
    Random random(41);
    Worst worst;
    for (int i = 0; i < 150'000; ++i) {
        One<float> one;
        const V u = random.direction();
        const V v = random.direction();
        one.corners = {(1e6 * u).cast<float>(), (1e6 * v).cast<float>(), (-1e6 * (u + v)).cast<float>()};
        const auto at = [&](std::size_t k) -> V { return one.corners[k].cast<double>(); };
        const V normal = V(at(1) - at(0)).cross(V(at(2) - at(0))).normalized();
        const V middle = at(0).dot(normal) * normal;  // of the plane, nearest to the origin: there floats are fine
        // Heights at which rounding a double of 1e6 takes up to a ten-millionth of it; and fractions just below a power
        // of two, where a float's last place is the least of the fraction.
        const double above = std::exp(random.between(-9, -3));
        const double fraction = random.between(0.96, 0.999) * std::ldexp(1.0, -random.between_ints(0, 9));
        one.segment.from = (middle + above * normal).cast<float>();
        one.segment.to = (middle - above * (1 / fraction - 1) * normal).cast<float>();
        worst.add(one);
    }
    worst.expect("close to a plane");
}

TEST(DelicateValues, of_a_long_grazing_segment_and_a_small_face) {
    Random random(42);
    Worst worst;
    for (int i = 0; i < 150'000; ++i) {
        One<float> one;
        // The plane contains (p, q, 0) and (0, u, v), and all corners are exactly on it, as these have few digits. The
        // segment goes almost along (p, q, 0), is some thousand times as long as the face, and passes through the plane
        // by a hundred-thousandth of its length: what rounding does to its height, it does a hundred thousand times to
        // the place.
        const std::array<int, 4> few = {random.between_ints(1, 31), random.between_ints(-31, 31),
                                        random.between_ints(1, 31), random.between_ints(-31, 31)};
        const auto in_plane = [&](double r, double s) { return V(few[0] * r, few[1] * r + few[2] * s, few[3] * s); };
        const int size = random.between_ints(-14, -6);
        const auto some = [&](int low, int high, int exponent) {
            return std::ldexp(random.between_ints(low, high), exponent);
        };
        one.corners = {in_plane(some(-4095, 0, size - 12), some(1, 4095, size - 12)).cast<float>(),
                       in_plane(some(0, 4095, size - 12), some(1, 4095, size - 12)).cast<float>(),
                       in_plane(some(-2047, 2047, size - 12), some(-4095, -1, size - 12)).cast<float>()};
        const double slope = std::exp(random.between(-9, -5));
        const auto end = [&](double r) -> Vec3<float> { return (in_plane(r, 0) + V(0, 0, slope * r)).cast<float>(); };
        one.segment = {end(some(-4095, -2048, -12)), end(some(2048, 4095, -12))};
        worst.add(one);
    }
    worst.expect("long and grazing");
}

TEST(DelicateValues, a_denormal_fraction_is_a_lower_bound_where_the_point_has_moved) {
    // The segment starts some smallest doubles above the face and goes far aside, so that even this part of the way is
    // a way. The point keeps as far off as the start is, and the fraction belongs to it: 0 only where two of the
    // smallest doubles, which the bound takes off, leave nothing.
    Random random(43);
    const double tiny = std::numeric_limits<double>::denorm_min();
    int hits = 0;
    int with_fraction = 0;
    int moved = 0;
    for (int i = 0; i < 2'000; ++i) {
        One<double> one;
        one.corners = {V(-8, -8, 0), V(1e301, -8, 0), V(-8, 1e301, 0)};
        const double above = tiny * (1 + double(random.below(100)));
        one.segment = {V(0, 0, above), V(1e300 * random.unit(), 1e300 * random.unit(), -random.between(0.3, 3))};
        const auto hit = one.hit();
        ASSERT_TRUE(hit);
        const Q exact = one.exact().fraction();
        ++hits;
        ASSERT_LE(Q(hit->fraction), exact) << i;
        ASSERT_LE(ulps(hit->exact_fraction, exact, CGAL::to_double(exact)), 1) << i;
        ASSERT_TRUE(hit->fraction > 0 || hit->point == one.segment.from || exact <= Q(3 * tiny)) << i;
        ASSERT_GE(hit->point[2], above) << i;
        with_fraction += hit->fraction > 0 ? 1 : 0;
        moved += hit->point != one.segment.from ? 1 : 0;
    }
    EXPECT_EQ(hits, 2'000);
    EXPECT_GT(with_fraction, 1'500);
    EXPECT_GT(moved, 500);
}

// Never outside of the box of both ends: half of an odd number of smallest doubles is rounded, and twice that is beyond
// the end.
template <class Scalar>
void expect_points_in_the_box() {
    Random random(44);
    const Scalar tiny = std::numeric_limits<Scalar>::denorm_min();
    int moved = 0;
    for (int i = 0; i < 8'000; ++i) {
        One<Scalar> one;
        const auto plane = static_cast<Scalar>(random.between(-1, 1));
        one.corners = {Vec3<Scalar>(-1, -1, plane), Vec3<Scalar>(3, -1, plane), Vec3<Scalar>(-1, 3, plane)};
        const auto steps = [&] { return tiny * static_cast<Scalar>(random.between_ints(-9, 9)); };
        one.segment = {{steps(), steps(), 1}, {steps(), steps(), -1}};
        const auto hit = one.hit();
        ASSERT_TRUE(hit);
        moved += hit->fraction > 0 ? 1 : 0;
        for (int k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(one.segment.from[k], one.segment.to[k]);
            ASSERT_GE(hit->point[k], low) << i << ", coordinate " << k;
            ASSERT_LE(hit->point[k], high) << i << ", coordinate " << k;
        }
    }
    EXPECT_GT(moved, 6'000);
}

TEST(DelicateValues, points_lie_between_the_ends) {
    expect_points_in_the_box<float>();
    expect_points_in_the_box<double>();
}

}  // namespace
}  // namespace pierce::test
