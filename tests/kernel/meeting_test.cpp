// The volumes of a meeting and all values from them stay within their bounds, in double and in twice that precision:
// against GMP's integers.
// And values in twice the precision are the same bits with fused operations and without.
#include <exact/decide.h>
#include <kernel/backends.h>
#include <kernel/evaluate.h>
#include <kernel/filter.h>
#include <support/pairs.h>
#include <support/whole.h>

namespace pierce::test {
namespace {

using namespace detail;

using FinePair = BasicDoubleDouble<detail::Pair, Dekker>;

struct Exact {
    using Vector = std::array<mpz_class, 3>;

    Exact(const Corners& corners, const Path& path) {
        const auto minus = [](const Point& x, const Point& y) {
            Vector difference;
            for (std::size_t k = 0; k < 3; ++k) difference[k] = whole(x[k], k_unit) - whole(y[k], k_unit);
            return difference;
        };
        const auto cross = [](const Vector& x, const Vector& y) {
            return Vector{x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
        };
        const auto dot = [](const Vector& x, const Vector& y) {
            return mpz_class(x[0] * y[0] + x[1] * y[1] + x[2] * y[2]);
        };
        const Vector a = minus(corners[0], path.from);
        const Vector b = minus(corners[1], path.from);
        const Vector c = minus(corners[2], path.from);
        d = minus(path.to, path.from);
        // The volumes around the path's start, not the formula under test.
        w = {dot(d, cross(b, c)), dot(d, cross(c, a)), dot(d, cross(a, b))};
        s = w[0] + w[1] + w[2];
        v = dot(a, cross(b, c));
        n = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    }

    Vector n, w, d;
    mpz_class s, v;
};

struct Tally {
    int pairs = 0;
    int tame = 0;
    int zeros = 0;      ///< bars of 0
    int values = 0;     ///< hits whose values are as good as is asked for
    double volume = 0;  ///< largest error in parts of its bound
    double value = 0;
    double place = 0;
};

template <class Number>
void judge(const test::Pair& pair, double tolerance, Tally& tally) {
    constexpr double u = Arithmetic<Number>::unit;
    ++tally.pairs;
    Measured measured;
    measure_path<double>(pair.corners, pair.path, measured);
    if (!measured.tame) return;
    ++tally.tame;
    Meeting<Number> meeting;
    meet(measured.lines, meeting);
    const Exact exact(pair.corners, pair.path);
    const auto check = [&](const char* what, const auto& x, const mpz_class& z, double bound, int places) {
        tally.zeros += bound == 0 ? 1 : 0;
        const double error = error_in(bound, x, z, places);
        tally.volume = std::max(tally.volume, error);
        EXPECT_LE(error, 1) << what << ": " << describe(pair);
    };
    check("n", lane(meeting.nr.x, 0), exact.n[0], 5 * u * measured.bar_nr.x[0], 2 * k_unit);
    check("n", lane(meeting.nr.y, 0), exact.n[1], 5 * u * measured.bar_nr.y[0], 2 * k_unit);
    check("n", lane(meeting.nr.z, 0), exact.n[2], 5 * u * measured.bar_nr.z[0], 2 * k_unit);
    check("s", lane(meeting.sb, 0), exact.s, 9 * u * measured.bar_sb[0], 3 * k_unit);
    check("v", lane(meeting.vc, 0), exact.v, 9 * u * measured.bar_vc[0], 3 * k_unit);
    check("w_b", lane(meeting.sb, 1), exact.w[1], 9 * u * measured.bar_sb[1], 3 * k_unit);
    check("w_c", -lane(meeting.vc, 1), exact.w[2], 9 * u * measured.bar_vc[1], 3 * k_unit);
    const auto a = lane(meeting.sb, 0) - lane(meeting.sb, 1) - -lane(meeting.vc, 1);
    check("w_a", a, exact.w[0], 12 * u * (measured.bar_sb[0] + measured.bar_sb[1] + measured.bar_vc[1]), 3 * k_unit);
    check("v - s", lane(meeting.vc, 0) - lane(meeting.sb, 0), exact.v - exact.s,
          10 * u * (measured.bar_sb[0] + measured.bar_vc[0]), 3 * k_unit);

    Values values;
    evaluate<double, TwoPairs>(measured, meeting, 1, values);
    const double length = values.length;
    for (std::size_t k = 0; k < 3; ++k) {
        const double error = error_in(values.normal_errors[k], values.normal[k], exact.n[k], 2 * k_unit);
        EXPECT_LE(error, 1) << "normal: " << describe(pair);
        const double bound = values.normal_error < length ? values.normal_error + 0x1p-52 * length : HUGE_VAL;
        EXPECT_LE(bound == HUGE_VAL ? 0 : error_in(bound, values.normal[k], exact.n[k], 2 * k_unit), 1)
            << describe(pair);
    }
    if (!decide(pair.path, pair.corners, Sides::both).hit || !std::isfinite(values.weight_error)) return;
    // |x - y / s| <= e is |x s - y| <= e |s|, and a rounding of x, which is at most 1.
    const auto near = [&](const char* what, double x, const mpz_class& y, double bound) {
        const mpz_class error = abs(whole(x, k_unit) * exact.s - (y << k_unit));
        const double parts =
            mpq_class(error, whole(bound + (u < 0x1p-60 ? 0x1p-53 * x + 0x1p-1074 : 0), k_unit) * abs(exact.s)).get_d();
        tally.value = std::max(tally.value, parts);
        EXPECT_LE(parts, 1 + 0x1p-20) << what << ": " << describe(pair);
    };
    near("fraction", values.weights[3], exact.v, values.fraction_error + 0x1p-1000);
    for (std::size_t k = 0; k < 3; ++k) near("weight", values.weights[k], exact.w[k], values.weight_error);
    for (std::size_t k = 0; k < 3; ++k) {
        const mpz_class from = whole(pair.path.from[k], k_unit);
        const mpz_class error =
            abs((whole(values.high[k], k_unit) + whole(values.low[k], k_unit) - from) * exact.s - exact.v * exact.d[k]);
        const mpz_class bound = whole(values.error[k], k_unit) * abs(exact.s);
        EXPECT_LE(error, bound) << "place: " << describe(pair);
        if (bound != 0) tally.place = std::max(tally.place, mpq_class(error, bound).get_d());
    }
    const mpz_class far = whole(values.distance * (1 - 0x1p-51), 3 * k_unit);
    EXPECT_LE(far, abs(exact.v)) << "distance: " << describe(pair);
    if (values.fraction_error <= tolerance * values.weights[3] && values.weight_error <= tolerance &&
        values.normal_error <= tolerance * length)
        ++tally.values;
}

// Pairs of all families, as they come (`power` 0) or scaled, beyond the ends of the range too, where one axis may be
// squeezed. Some are flat along an axis.
test::Pair pair_of(Random& random) {
    const auto family = static_cast<Family>(random.below(k_family_names.size()));
    test::Pair pair = make_pair_of<double>(family, 1, random.chance(0.5) ? 0 : std::exp(random.between(0, 14)), random);
    const int power = random.chance(0.7)   ? 0
                      : random.chance(0.5) ? random.between_ints(-201, -100)
                                           : random.between_ints(100, 201);
    const std::size_t axis = random.below(3);
    const int squeezed = power - (random.chance(0.2) ? random.between_ints(0, 220) : 0);
    const bool flat = random.chance(0.1);
    for (Point* p : {&pair.path.from, &pair.path.to, &pair.corners[0], &pair.corners[1], &pair.corners[2]})
        for (std::size_t k = 0; k < 3; ++k) (*p)[k] = std::ldexp((*p)[k], k == axis ? squeezed : power);
    if (flat)
        for (Point& p : pair.corners) p[axis] = pair.corners[0][axis];
    return pair;
}

template <class Number>
Tally tally_of(int count, double tolerance) {
    Random random(10);
    Tally tally;
    for (int i = 0; i < count; ++i) judge<Number>(pair_of(random), tolerance, tally);
    std::cout << tally.pairs << " pairs, " << tally.tame << " in range, " << tally.zeros << " bars of 0, values of "
              << tally.values << " hits good enough; in parts of bounds: volumes " << tally.volume << ", values "
              << tally.value << ", places " << tally.place << '\n';
    EXPECT_GT(tally.tame, count / 2);
    EXPECT_LT(tally.tame, count);
    EXPECT_GT(tally.zeros, count / 20);
    EXPECT_GT(tally.values, count / 20);
    return tally;
}

TEST(Meeting, volumes_and_values_in_double_stay_within_their_bounds) {
    const Tally tally = tally_of<detail::Pair>(30'000, 0x1p-29);
    // A judge that sees no error looks at the wrong thing. (The unit allows for any rounding mode: twice what is lost
    // here.)
    EXPECT_GT(tally.volume, 0.05);
    EXPECT_GT(tally.value, 0.01);
    EXPECT_GT(tally.place, 0.01);
}
TEST(Meeting, volumes_and_values_in_twice_the_precision_stay_within_their_bounds) {
    const Tally tally = tally_of<FinePair>(30'000, 0x1p-58);
    EXPECT_GT(tally.volume, 0.002);
    EXPECT_GT(tally.value, 0.5);
    EXPECT_GT(tally.place, 0.0005);
}

/// What the two tables differ in; empty: nothing. Vectors of values have three numbers.
template <class Scalar>
std::string difference(const NarrowKernels<Scalar>& one, const NarrowKernels<Scalar>& two, const test::Pair& pair,
                       Random& random, int& hits) {
    std::array<Scalar, 9> numbers{};
    for (std::size_t k = 0; k < 9; ++k) numbers[k] = static_cast<Scalar>(pair.corners[k / 3][k % 3]);
    const Row<Scalar> row{numbers.data(), 1};
    const auto sides = std::array{Sides::front, Sides::back, Sides::both}[random.below(3)];
    Filtered x{};
    Filtered y{};
    Measured of_x;
    Measured of_y;
    one.filter(row, pair.path.from.data(), pair.path.to.data(), pair.path.ray, sides, x, of_x);
    two.filter(row, pair.path.from.data(), pair.path.to.data(), pair.path.ray, sides, y, of_y);
    if (x.verdict != y.verdict || x.decision.hit != y.decision.hit || x.decision.at_start != y.decision.at_start)
        return "verdict";
    if (x.verdict != Verdict::miss && (x.earliest != y.earliest || x.latest != y.latest)) return "interval";
    const double grain = std::ldexp(1.0, random.between_ints(-60, 10));
    for (const auto evaluate : {&NarrowKernels<Scalar>::evaluate, &NarrowKernels<Scalar>::evaluate_finely}) {
        Values v{};
        Values w{};
        Rounded<Scalar> r{};
        Rounded<Scalar> s{};
        (one.*evaluate)(of_x, Sides::front, grain, v, r);
        (two.*evaluate)(of_y, Sides::front, grain, w, s);
        const auto same = [](const auto& p, const auto& q, std::size_t count) {
            return std::memcmp(p, q, count * sizeof *p) == 0;
        };
        if (v.weight_error != w.weight_error) return "good";
        if (!std::isfinite(v.weight_error)) continue;
        ++hits;
        if (!same(v.weights, w.weights, 4) || v.fraction_error != w.fraction_error) return "weights";
        if (!same(v.normal, w.normal, 3) || !same(v.normal_errors, w.normal_errors, 3) ||
            v.normal_error != w.normal_error || v.length != w.length || v.length_error != w.length_error ||
            v.distance != w.distance)
            return "normal";
        if (!same(v.high, w.high, 3) || !same(v.low, w.low, 3) || !same(v.error, w.error, 3)) return "place";
        if (!same(v.position, w.position, 3) || v.rounded != w.rounded || v.located != w.located) return "position";
        if (!same(v.point, w.point, 3) || v.tried != w.tried) return "point";
        if (!same(r.point, s.point, 3) || !same(r.position, s.position, 3) || !same(r.normal, s.normal, 3) ||
            !same(r.weights, s.weights, 4))
            return "rounded";
    }
    return {};
}

template <class Scalar>
void compare_narrow_phases() {
    Random random(12);
    int hits = 0;
    for (int i = 0; i < 300'000; ++i) {
        test::Pair pair = pair_of(random);
        // Out of the range that fused operations and halves agree in: products lose what neither can have.
        const double scale =
            sizeof(Scalar) == 8 && random.chance(0.1) ? std::ldexp(1.0, -random.between_ints(240, 480)) : 1;
        for (Point* p : {&pair.path.from, &pair.path.to, &pair.corners[0], &pair.corners[1], &pair.corners[2]})
            for (double& x : *p) {
                x = static_cast<double>(static_cast<Scalar>(scale * x));
                if (!std::isfinite(x)) x = 0;  // no number in this Scalar
            }
        pair.path.ray = random.chance(0.2);
        for (const Backend* backend : backends())
            ASSERT_EQ(difference(k_narrow.of<Scalar>(), backend->narrow->of<Scalar>(), pair, random, hits), "")
                << backend->name << ' ' << describe(pair);
    }
    EXPECT_GT(hits, 30'000);
}

// A weight of exactly 2^-200: the least that is known to be good.
TEST(Meeting, narrow_phases_agree_at_the_end_of_their_range) {
    test::Pair pair;
    pair.corners = {Point{0, 0, 0}, {0x1p100, 0, 0}, {0, 0x1p100, 0}};
    pair.path = {.from = {0x1p-100, 0x1p98, 1}, .to = {0x1p-100, 0x1p98, -1}};
    Random random(13);
    for (const Backend* backend : backends()) {
        int hits = 0;
        EXPECT_EQ(difference(k_narrow.of<double>(), backend->narrow->of<double>(), pair, random, hits), "");
        EXPECT_EQ(hits, 2);
    }
}

TEST(Meeting, narrow_phases_of_floats_are_the_same_bits_with_fused_operations) { compare_narrow_phases<float>(); }
TEST(Meeting, narrow_phases_of_doubles_are_the_same_bits_with_fused_operations) { compare_narrow_phases<double>(); }

}  // namespace
}  // namespace pierce::test
