// The integers under every exact decision, against GMP: all widths, signs, carries and limits.
#include <gmpxx.h>

#include <gtest/gtest.h>
#include <exact/lattice.h>
#include <exact/ratio.h>
#include <support/random.h>

namespace pierce::test {
namespace {

using namespace detail;

template <int N>
mpz_class to_gmp(const Integer<N>& x) {
    const Integer<N> m = magnitude(x);
    mpz_class value = 0;
    for (int i = N - 1; i >= 0; --i) {
        value <<= 64;
        value += mpz_class(std::to_string(m.limb[i]));
    }
    return x.negative() ? mpz_class(-value) : value;
}

// Limbs of all ones and all zeros are as likely as any others: they are what carries run through.
template <int N>
Integer<N> any_integer(Random& random, int head_room) {
    Integer<N> x;
    for (std::uint64_t& limb : x.limb) {
        const double kind = random.unit();
        limb = kind < 0.3 ? 0 : kind < 0.6 ? ~std::uint64_t{0} : random.below(~std::size_t{0});
    }
    x.limb[N - 1] >>= head_room;
    return random.chance(0.5) ? -x : x;
}

template <int N>
void compare_with_gmp() {
    Random random(N);
    for (int i = 0; i < 20'000; ++i) {
        const Integer<N> x = any_integer<N>(random, 2);
        const Integer<N> y = random.chance(0.1) ? x : any_integer<N>(random, 2);
        const mpz_class gx = to_gmp(x);
        const mpz_class gy = to_gmp(y);
        ASSERT_EQ(to_gmp(x + y), gx + gy);
        ASSERT_EQ(to_gmp(x - y), gx - gy);
        ASSERT_EQ(to_gmp(x * y), gx * gy);
        ASSERT_EQ(to_gmp(x * any_integer<1>(random, 1)) % (gx == 0 ? mpz_class(1) : gx), 0);
        ASSERT_EQ(compare(x, y), gx < gy ? -1 : gx > gy ? 1 : 0);
        ASSERT_EQ(x.sign(), sgn(gx));
        ASSERT_EQ(to_gmp(widen<N + 3>(x)), gx);
        const auto shift = random.below(131);
        ASSERT_EQ(to_gmp(widen<N + 3>(magnitude(x)) << static_cast<int>(shift)), abs(gx) << shift);
        ASSERT_EQ(bit_length(magnitude(x)), gx == 0 ? 0 : static_cast<int>(mpz_sizeinbase(gx.get_mpz_t(), 2)));
    }
}

TEST(Integer, agrees_with_gmp) {
    compare_with_gmp<1>();
    compare_with_gmp<2>();
    compare_with_gmp<3>();
    compare_with_gmp<6>();
    compare_with_gmp<33>();
}

TEST(Integer, ratio_is_correctly_rounded_but_for_a_hair) {
    Random random(5);
    for (int i = 0; i < 20'000; ++i) {
        Integer<4> n = magnitude(any_integer<4>(random, 1));
        Integer<3> d = magnitude(any_integer<3>(random, 1));
        if (d.zero()) continue;
        const int exponent = random.between_ints(-300, 300);
        const double q = ratio(n, d, exponent);
        mpq_class exact(to_gmp(n), to_gmp(d));
        exact.canonicalize();
        if (exponent > 0) mpq_mul_2exp(exact.get_mpq_t(), exact.get_mpq_t(), static_cast<unsigned>(exponent));
        else mpq_div_2exp(exact.get_mpq_t(), exact.get_mpq_t(), static_cast<unsigned>(-exponent));
        if (n.zero()) {
            ASSERT_EQ(q, 0);
            continue;
        }
        const double ulp = std::nextafter(q, INFINITY) - q;
        const mpq_class error = abs(mpq_class(q) - exact) / mpq_class(ulp);
        ASSERT_LE(error.get_d(), 0.5 + 0x1p-8);
    }
    Integer<2> x;
    x.limb[0] = 12345;
    EXPECT_EQ(ratio(x, x), 1.0);
}

TEST(Lattice, holds_every_double_exactly) {
    const double denormal = std::numeric_limits<double>::denorm_min();
    const double largest = std::numeric_limits<double>::max();
    Lattice lattice;
    for (double x : {denormal, -largest, 0.0, -0.0}) lattice.add(x);
    EXPECT_EQ(lattice.bits(), 2098);
    EXPECT_EQ(to_gmp(on_lattice<33>(denormal, lattice)), 1);
    EXPECT_EQ(to_gmp(on_lattice<33>(-largest, lattice)), -mpz_class(mpq_class(largest) / mpq_class(denormal)));
    EXPECT_TRUE(on_lattice<33>(-0.0, lattice).zero());
    const auto width = [](auto n) { return int{n}; };
    EXPECT_EQ(with_limbs(lattice.bits(), width, [] { return 0; }), 0) << "too wide for a fixed width";

    Random random(6);
    for (int i = 0; i < 10'000; ++i) {
        const double x = random.between(-1, 1) * std::exp(random.between(-20, 20));
        const double y = random.between(-1, 1) * std::exp(random.between(-20, 20));
        Lattice two;
        two.add(x);
        two.add(y);
        ASSERT_LE(two.bits(), 124);
        mpq_class unit(1);
        if (two.lowest < 0) mpq_div_2exp(unit.get_mpq_t(), unit.get_mpq_t(), static_cast<unsigned>(-two.lowest));
        else mpq_mul_2exp(unit.get_mpq_t(), unit.get_mpq_t(), static_cast<unsigned>(two.lowest));
        ASSERT_EQ(mpq_class(to_gmp(on_lattice<2>(x, two))) * unit, mpq_class(x));
        ASSERT_EQ(mpq_class(to_gmp(on_lattice<2>(y, two))) * unit, mpq_class(y));
    }
}

}  // namespace
}  // namespace pierce::test
