// Double-double numbers lose no more than is said of each operation: against GMP's integers, on which every double is a
// whole multiple of 2^-1074.
#include <support/random.h>
#include <support/whole.h>

namespace pierce::test {
namespace {

using namespace detail;

constexpr double v = 0x1p-53;

// A number within 2^power, its low part within j v 2^power, both as large as that or much smaller.
DoubleDouble number(int power, int j, Random& random) {
    const double high =
        std::ldexp(random.between(-1, 1), random.chance(0.2) ? power - random.between_ints(0, 60) : power);
    const double low =
        std::ldexp(random.between(-j * v, j * v), random.chance(0.2) ? power - random.between_ints(0, 40) : power);
    return {high, low};
}

// The largest error of an operation in units of what is said of it, and of its result's low part.
struct Worst {
    double error = 0;
    double low = 0;
};

// Sums and products of numbers whose low parts are up to nine units, the most in use; `around`: of the binary
// exponents.
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
        sum.error =
            std::max(sum.error, error_in((2 * most + 1) * v * v * (size_x + size_y), s, exact_x + exact_y, k_unit));
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
    for (const double x : {0x1p602, -0x1.fffffffffffffp602}) {  // the largest that meeting.h multiplies
        const double y = 0x1.fffffffffffffp300;
        EXPECT_EQ(whole(two_product(x, y), 2 * k_unit), whole(x, k_unit) * whole(y, k_unit));
    }
}

TEST(DoubleDouble, quotients_lose_no_more_than_is_said) {
    Random random(9);
    double worst = 0;
    for (int i = 0; i < 300'000; ++i) {
        // High parts that cancelled: the low one is up to a thousandth of it.
        const auto cancelled = [&] {
            const double high =
                (random.chance(0.5) ? 1 : -1) * std::ldexp(random.between(0.5, 1), random.between_ints(-200, 200));
            return DoubleDouble{high, high * random.between(-1, 1) * std::ldexp(1, -random.between_ints(10, 60))};
        };
        const DoubleDouble x = cancelled();
        const DoubleDouble y = cancelled();
        using A = Arithmetic<DoubleDouble>;
        const DoubleDouble divisor = A::tidy(y);
        const DoubleDouble q = A::quotient(A::tidy(x), divisor, 1 / divisor.high);
        // |q - x / y| in units of |x / y| is |q y - x| / |x|.
        const mpz_class exact = whole(x, k_unit) << k_unit;
        const mpz_class error = abs(whole(q, k_unit) * whole(y, k_unit) - exact);
        worst = std::max(worst, mpq_class(error, abs(exact)).get_d());
    }
    std::cout << "quotients: within " << worst * 0x1p100 << " units of themselves\n";
    EXPECT_LE(worst, 0x1p-99);
    EXPECT_GT(worst, 0x1p-104);
}

}  // namespace
}  // namespace pierce::test
