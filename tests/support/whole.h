// Doubles as whole numbers, for GMP to judge: every double is a multiple of 2^-1074.
#pragma once

#include <cmath>

#include <gmpxx.h>
#include <gtest/gtest.h>
#include <kernel/double_double.h>

namespace pierce::test {

inline constexpr int k_unit = 1074;  // of a coordinate; products have twice as many binary places, and so on

// x 2^places, which must be whole.
inline mpz_class whole(double x, int places) {
    int exponent = 0;
    const double fraction = std::frexp(x, &exponent);
    mpz_class z(std::ldexp(fraction, 53));
    const int shift = exponent - 53 + places;
    if (shift >= 0) return z << static_cast<mp_bitcnt_t>(shift);
    EXPECT_EQ(((z >> static_cast<mp_bitcnt_t>(-shift)) << static_cast<mp_bitcnt_t>(-shift)), z) << x;
    return z >> static_cast<mp_bitcnt_t>(-shift);
}
inline mpz_class whole(const detail::DoubleDouble& x, int places) {
    return whole(x.high, places) + whole(x.low, places);
}

// The error of x in units of `bound`: z 2^-places is what x should be.
template <class Number>
double error_in(double bound, const Number& x, const mpz_class& z, int places) {
    const mpz_class error = abs(whole(x, places) - z);
    if (error == 0) return 0;
    const mpz_class limit = whole(bound, places);
    return limit == 0 ? HUGE_VAL : mpq_class(error, limit).get_d();
}

}  // namespace pierce::test
