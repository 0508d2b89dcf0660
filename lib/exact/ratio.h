// Exact integers turned into doubles, correctly rounded but for a stated hair.
#pragma once

#include <cmath>
#include <limits>

#include <exact/integer.h>

namespace pierce::detail {

/// q * 2^exponent as a double, for 2^63 <= q: rounded to nearest here, on the integer, so that the processor's rounding
/// mode plays no part. Infinity above the range; below the normal range a second rounding by ldexp.
[[nodiscard]] inline double rounded(Wide q, int exponent) {
    while ((q >> 64) != 0) {  // at most once: q < 2^65 in this file
        q = (q >> 1) | (q & 1);
        ++exponent;
    }
    auto top = static_cast<std::uint64_t>(q);
    const std::uint64_t half = top & 0x7ff;
    top >>= 11;
    if (half > 0x400 || (half == 0x400 && (top & 1) != 0)) ++top;
    return std::ldexp(static_cast<double>(top), exponent + 11);
}

/// numerator / denominator * 2^exponent for numerator >= 0, denominator > 0.
///
/// Both are cut to 64 bits (relative error below 2^-63 each) and so is the quotient: it is within 2^-61 before the one
/// rounding to 53 bits, so the result is within (1/2 + 2^-8) ulp, and 0 and 1 come out as exactly that.
template <class Numerator, class Denominator>
[[nodiscard]] inline double ratio(const Numerator& numerator, const Denominator& denominator, int exponent = 0) {
    if (numerator.zero()) return 0.0;
    const std::uint64_t n = top_bits(numerator);
    const std::uint64_t d = top_bits(denominator);
    const Wide quotient = (static_cast<Wide>(n) << 64) / d;  // in (2^63, 2^65)
    return rounded(quotient, exponent + bit_length(numerator) - bit_length(denominator) - 64);
}

/// x * 2^exponent with the sign of x: within (1/2 + 2^-10) ulp.
template <int N>
[[nodiscard]] inline double to_double(const Integer<N>& x, int exponent = 0) {
    if (x.zero()) return 0.0;
    const Integer<N> m = magnitude(x);
    const double value = rounded(top_bits(m), exponent + bit_length(m) - 64);
    return x.negative() ? -value : value;
}

}  // namespace pierce::detail
