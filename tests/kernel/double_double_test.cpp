// Double-double numbers lose no more than is said of each operation, and the formulas written with them stay within their bounds: against
// GMP's integers, on which every double is a whole multiple of 2^-1074.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <exact/decide.h>
#include <kernel/plane.h>
#include <support/pairs.h>

namespace pierce::test {
namespace {

using namespace detail;

constexpr int k_unit = 1074;  // of a coordinate; products have twice as many binary places, and so on

// x 2^places, which must be whole.
mpz_class whole(double x, int places) {
    int exponent = 0;
    const double fraction = std::frexp(x, &exponent);
    mpz_class z(std::ldexp(fraction, 53));
    const int shift = exponent - 53 + places;
    if (shift >= 0) return z << static_cast<mp_bitcnt_t>(shift);
    EXPECT_EQ(((z >> static_cast<mp_bitcnt_t>(-shift)) << static_cast<mp_bitcnt_t>(-shift)), z) << x;
    return z >> static_cast<mp_bitcnt_t>(-shift);
}
mpz_class whole(const DoubleDouble& x, int places) { return whole(x.high, places) + whole(x.low, places); }

// The error of x in units of `bound`: z 2^-places is what x should be.
template <class Number>
double error_in(double bound, const Number& x, const mpz_class& z, int places) {
    const mpz_class error = abs(whole(x, places) - z);
    if (error == 0) return 0;
    const mpz_class limit = whole(bound, places);
    return limit == 0 ? HUGE_VAL : mpq_class(error, limit).get_d();
}

constexpr double v = 0x1p-53;

// A number within 2^power, its low part within j v 2^power, both as large as that or much smaller.
DoubleDouble number(int power, int j, Random& random) {
    const double high = std::ldexp(random.between(-1, 1), random.chance(0.2) ? power - random.between_ints(0, 60) : power);
    const double low = std::ldexp(random.between(-j * v, j * v), random.chance(0.2) ? power - random.between_ints(0, 40) : power);
    return {high, low};
}

// The largest error of an operation in units of what is said of it, and of its result's low part.
struct Worst {
    double error = 0;
    double low = 0;
};

// Sums and products of numbers whose low parts are up to nine units, the most in use; `around`: of the binary exponents.
std::array<Worst, 2> worst_of_operations(int pairs, int around) {
    Random random(7);
    Worst sum;
    Worst product;
    for (int i = 0; i < pairs; ++i) {
        const int j = random.between_ints(1, 9);
        const int k = random.between_ints(1, 9);
        const int of_x = around + random.between_ints(-30, 30);
        const int of_y = random.chance(0.5) ? of_x : around + random.between_ints(-30, 30);
        const double size_x = std::ldexp(1, of_x);
        const double size_y = std::ldexp(1, of_y);
        const DoubleDouble x = number(of_x, j, random);
        DoubleDouble y = number(of_y, k, random);
        if (of_x == of_y && random.chance(0.5)) y.high = -x.high * (1 + random.between_ints(-3, 3) * 0x1p-52);
        const mpz_class exact_x = whole(x, k_unit);
        const mpz_class exact_y = whole(y, k_unit);

        const int most = std::max(j, k);
        const DoubleDouble s = random.chance(0.5) ? x + y : x - -y;
        sum.error = std::max(sum.error, error_in((2 * most + 1) * v * v * (size_x + size_y), s, exact_x + exact_y, k_unit));
        sum.low = std::max(sum.low, std::abs(s.low) / ((most + 1) * v * (size_x + size_y)));

        const DoubleDouble p = x * y;
        const double bound = (1 + 3 * (j + k) + j * k) * v * v * size_x * size_y + 0x1p-1071;
        product.error = std::max(product.error, error_in(bound, p, exact_x * exact_y, 2 * k_unit));
        product.low = std::max(product.low, std::abs(p.low) / ((1 + j + k) * v * size_x * size_y + 0x1p-1071));
    }
    return {sum, product};
}

TEST(DoubleDouble, sums_and_products_lose_no_more_than_is_said) {
    const auto [sum, product] = worst_of_operations(1'000'000, 0);
    std::cout << "in parts of the bounds: sums " << sum.error << ", products " << product.error << '\n';
    constexpr double hair = 1 + 0x1p-40;
    EXPECT_LE(sum.error, hair);
    EXPECT_LE(sum.low, hair);
    EXPECT_LE(product.error, hair);
    EXPECT_LE(product.low, hair);
    // A judge that sees no error looks at the wrong thing.
    EXPECT_GT(sum.error, 0.3);
    EXPECT_GT(product.error, 0.1);
}

TEST(DoubleDouble, underflow_loses_no_more_than_is_said) {
    for (const int around : {-960, -540, -500}) {
        const auto [sum, product] = worst_of_operations(50'000, around);
        EXPECT_LE(sum.error, 1 + 0x1p-40) << around;
        EXPECT_LE(product.error, 1 + 0x1p-40) << around;
        EXPECT_LE(product.low, 1 + 0x1p-40) << around;
    }
    // What the bound allows for does happen.
    const DoubleDouble tiny = DoubleDouble{0x1.8p-540, 0} * DoubleDouble{0x1.0000001p-540, 0};
    EXPECT_NE(whole(tiny, 2 * k_unit), whole(0x1.8p-540, k_unit) * whole(0x1.0000001p-540, k_unit));
}

TEST(DoubleDouble, sums_and_products_of_doubles_are_exact) {
    Random random(8);
    for (int i = 0; i < 300'000; ++i) {
        const double x = std::ldexp(random.between(-1, 1), random.between_ints(-300, 300));
        const double y = random.chance(0.5) ? std::ldexp(random.between(-1, 1), random.between_ints(-300, 300))
                                            : -x * (1 + random.between_ints(-9, 9) * 0x1p-50);
        EXPECT_EQ(whole(two_sum(x, y), k_unit), whole(x, k_unit) + whole(y, k_unit)) << x << ' ' << y;
        EXPECT_EQ(whole(two_product(x, y), 2 * k_unit), whole(x, k_unit) * whole(y, k_unit)) << x << ' ' << y;
        EXPECT_EQ(two_sum(x, y).high, x + y);
        EXPECT_EQ(two_product(x, y).high, x * y);
    }
    for (const double x : {0x1p602, -0x1.fffffffffffffp602}) {  // the largest that plane.h multiplies
        const double y = 0x1.fffffffffffffp300;
        EXPECT_EQ(whole(two_product(x, y), 2 * k_unit), whole(x, k_unit) * whole(y, k_unit));
    }
}

TEST(DoubleDouble, quotients_are_rounded_once) {
    Random random(9);
    double worst = 0;
    for (int i = 0; i < 300'000; ++i) {
        // High parts that cancelled: the low one is up to a thousandth of it.
        const auto cancelled = [&] {
            const double high = (random.chance(0.5) ? 1 : -1) * std::ldexp(random.between(0.5, 1), random.between_ints(-200, 200));
            return DoubleDouble{high, high * random.between(-1, 1) * std::ldexp(1, -random.between_ints(10, 60))};
        };
        const DoubleDouble x = cancelled();
        const DoubleDouble y = cancelled();
        const double q = Arithmetic<DoubleDouble>::Divisor(y)(x);
        // |q - x / y| in units of |x / y| is |q y - x| / |x|.
        const mpz_class exact = whole(x, k_unit) << k_unit;
        const mpz_class error = abs(whole(q, k_unit) * whole(y, k_unit) - exact);
        worst = std::max(worst, mpq_class(error, abs(exact)).get_d());
    }
    EXPECT_LE(worst, v + 0x1p-100);
    EXPECT_GT(worst, v * 0.99);
}

// The numbers of a plane and a meeting, exact.
struct Exact {
    using Vector = std::array<mpz_class, 3>;

    Exact(const Corners& corners, const Path& path) {
        const auto minus = [](const Point& x, const Point& y) {
            Vector d;
            for (std::size_t k = 0; k < 3; ++k) d[k] = whole(x[k], k_unit) - whole(y[k], k_unit);
            return d;
        };
        const auto cross = [](const Vector& x, const Vector& y) {
            return Vector{x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
        };
        const auto dot = [](const Vector& x, const Vector& y) { return mpz_class(x[0] * y[0] + x[1] * y[1] + x[2] * y[2]); };
        const Vector a = minus(corners[0], path.from);
        const Vector b = minus(corners[1], path.from);
        const Vector c = minus(corners[2], path.from);
        const Vector d = minus(path.to, path.from);
        // The volumes around the path's start, not the formula under test.
        w = {dot(d, cross(b, c)), dot(d, cross(c, a)), dot(d, cross(a, b))};
        s = w[0] + w[1] + w[2];
        v = dot(a, cross(b, c));
        n = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    }

    Vector n, w;
    mpz_class s, v;
};

struct Tally {
    int pairs = 0;
    int tame = 0;
    int sides = 0;
    int normals = 0;
    int values = 0;
    double worst = 0;  ///< error in parts of its bound
};

template <class Number>
void judge(const Pair& pair, double tolerance, Tally& tally) {
    using A = Arithmetic<Number>;
    const Plane<Number> plane(pair.corners);
    const Meeting<Number> meeting(plane, pair.path);
    const Exact exact(pair.corners, pair.path);
    const auto check = [&](const char* what, const Number& x, const mpz_class& z, double bound, int places) {
        const double error = error_in(bound, x, z, places);
        tally.worst = std::max(tally.worst, error);
        EXPECT_LE(error, 1) << what << ": " << describe(pair);
    };
    ++tally.pairs;
    if (plane.tame) {
        const double bound = 8 * A::unit * (plane.size * plane.size);
        check("n", plane.n.x, exact.n[0], bound, 2 * k_unit);
        check("n", plane.n.y, exact.n[1], bound, 2 * k_unit);
        check("n", plane.n.z, exact.n[2], bound, 2 * k_unit);
    }
    EXPECT_FALSE(plane.has_area() && has_zero_area(pair.corners)) << describe(pair);
    if (plane.has_normal(tolerance)) {
        ++tally.normals;
        const double most = largest(plane.normal);
        const double bound = (tolerance + v) * (1 + 2 * tolerance) * most;
        EXPECT_LE(error_in(bound, plane.normal.x, exact.n[0], 2 * k_unit), 1) << describe(pair);
        EXPECT_LE(error_in(bound, plane.normal.y, exact.n[1], 2 * k_unit), 1) << describe(pair);
        EXPECT_LE(error_in(bound, plane.normal.z, exact.n[2], 2 * k_unit), 1) << describe(pair);
    }
    for (const Point& point : {pair.path.from, pair.path.to}) {
        const int side = plane.side(point);
        if (side == plane.doubtful) continue;
        ++tally.sides;
        EXPECT_EQ(side, side_of(pair.corners, point)) << describe(pair);
    }
    if (!meeting.tame) return;
    ++tally.tame;
    check("v", meeting.v, exact.v, meeting.ev, 3 * k_unit);
    check("s", meeting.s, exact.s, meeting.es, 3 * k_unit);
    check("w_a", meeting.w.x, exact.w[0], meeting.ea, 3 * k_unit);
    check("w_b", meeting.w.y, exact.w[1], meeting.ea, 3 * k_unit);
    check("w_c", meeting.w.z, exact.w[2], meeting.ea, 3 * k_unit);
    if (!decide(pair.path, pair.corners, Sides::both).hit || !meeting.within(tolerance)) return;
    ++tally.values;
    // |x - y / s| <= e y / s, or e for a weight, is |x s - y| <= e |y|, or e |s|.
    const typename A::Divisor over_s(meeting.s);
    const auto near = [&](double x, const mpz_class& y, const mpz_class& scale) {
        const mpz_class error = abs((whole(x, k_unit) * exact.s) - (y << k_unit));
        return (error << 80) <= (abs(scale) << k_unit) * mpz_class((tolerance + v) * (1 + 2 * tolerance) * 0x1p80);
    };
    EXPECT_TRUE(near(over_s(meeting.v), exact.v, exact.v)) << "fraction: " << describe(pair);
    EXPECT_TRUE(near(over_s(meeting.w.x), exact.w[0], exact.s)) << "weight of a: " << describe(pair);
    EXPECT_TRUE(near(over_s(meeting.w.y), exact.w[1], exact.s)) << "weight of b: " << describe(pair);
    EXPECT_TRUE(near(over_s(meeting.w.z), exact.w[2], exact.s)) << "weight of c: " << describe(pair);
}

// Pairs of all families, as they come (`power` 0) or scaled to the ends of the range, where one axis may be squeezed to denormal numbers.
template <class Number>
Tally tally_of(int count, double tolerance) {
    Random random(10);
    Tally tally;
    for (int i = 0; i < count; ++i) {
        const auto family = static_cast<Family>(random.below(k_family_names.size()));
        Pair pair = make_pair_of<double>(family, 1, random.chance(0.5) ? 0 : std::exp(random.between(0, 14)), random);
        const int power = random.chance(0.5) ? 0 : random.chance(0.5) ? random.between_ints(-310, -280) : random.between_ints(270, 300);
        const std::size_t axis = random.below(3);
        const int squeezed = power - (random.chance(0.2) ? random.between_ints(0, 780) : 0);
        for (Point* p : {&pair.path.from, &pair.path.to, &pair.corners[0], &pair.corners[1], &pair.corners[2]})
            for (std::size_t k = 0; k < 3; ++k) (*p)[k] = std::ldexp((*p)[k], k == axis ? squeezed : power);
        judge<Number>(pair, tolerance, tally);
    }
    std::cout << tally.pairs << " pairs, " << tally.tame << " in range, " << tally.values << " values and " << tally.normals
              << " normals good enough, " << tally.sides << " sides certain; errors up to " << tally.worst << " of their bounds\n";
    EXPECT_GT(tally.tame, count / 2);
    EXPECT_LT(tally.tame, count);
    EXPECT_GT(tally.values, count / 20);
    EXPECT_GT(tally.normals, count / 3);
    EXPECT_GT(tally.sides, count / 2);
    return tally;
}

TEST(DoubleDouble, planes_and_meetings_stay_within_their_bounds) { EXPECT_GT(tally_of<DoubleDouble>(40'000, 0x1p-58).worst, 0.001); }
TEST(Plane, planes_and_meetings_stay_within_their_bounds) { EXPECT_GT(tally_of<double>(40'000, 0x1p-29).worst, 0.02); }

TEST(Plane, sides_in_planes_along_two_axes_are_certain) {
    const Corners corners = {Point{0.1, 0.2, 0.7}, {1e3, 0.3, 0.7}, {0.2, 7.1, 0.7}};
    EXPECT_EQ(Plane<double>(corners).side({5.3, 1e-9, 0.7}), 0);
    EXPECT_EQ(Plane<DoubleDouble>(corners).side({5.3, 1e-9, 0.7}), 0);
    EXPECT_EQ(Plane<double>(corners).side({5.3, 1e-9, 0.8}), 1);
    EXPECT_EQ(Plane<DoubleDouble>(corners).side({5.3, 1e-9, std::nextafter(0.7, 1)}), 1);
    EXPECT_EQ(Plane<double>(corners).side(corners[0]), 0);
    // In an oblique plane zero is never certain, though it may well be true.
    const Corners oblique = {Point{0, 0, 0}, {1, 1, 0}, {1, 0, 1}};
    EXPECT_EQ(Plane<DoubleDouble>(oblique).side({2, 1, 1}), Plane<DoubleDouble>::doubtful);
}

}  // namespace
}  // namespace pierce::test
