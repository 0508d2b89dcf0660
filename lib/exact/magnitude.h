// What is done with exact magnitudes of either arithmetic: sums, and products compared.
#pragma once

#include <exact/accumulator.h>

namespace pierce::detail {

/// Of two numbers whose exponents agree modulo 64, and whose sum fits the lattice and degree they are from.
[[nodiscard]] inline Magnitude operator+(const Magnitude& x, const Magnitude& y) {
    if (x.zero()) return y;
    if (y.zero()) return x;
    Magnitude sum;
    sum.exponent = std::min(x.exponent, y.exponent);
    const int at_x = (x.exponent - sum.exponent) / 64;
    const int at_y = (y.exponent - sum.exponent) / 64;
    const int count = std::max(at_x + x.limbs, at_y + y.limbs) + 1;
    const auto limb = [](const Magnitude& m, int i) { return i >= 0 && i < m.limbs ? m.limb[i] : 0; };
    Wide carry = 0;
    for (int i = 0; i < count; ++i) {
        carry += static_cast<Wide>(limb(x, i - at_x)) + limb(y, i - at_y);
        sum.limb[i] = static_cast<std::uint64_t>(carry);
        carry >>= 64;
    }
    sum.trim(count);
    return sum;
}

template <int N, int M>
[[nodiscard]] int compare_products(const Integer<N>& a, const Integer<M>& b, const Integer<N>& c, const Integer<M>& d) {
    return compare(a * b, c * d);
}

/// The order of a b and c d, where the exponents of both products agree modulo 64.
///
/// By their highest bits where these tell. Each factor is cut below 2^-63 of itself, so a product is by less than
/// 2^-62: the top of one, in [2^126, 2^128), by less than 2^66. In full only where the tops are nearer than that: zero
/// limbs skipped, so that coordinates far apart make it no longer than their mantissas are.
[[nodiscard]] inline int compare_products(const Magnitude& a, const Magnitude& b, const Magnitude& c,
                                          const Magnitude& d) {
    const bool none = a.zero() || b.zero();
    if (none || c.zero() || d.zero()) return (c.zero() || d.zero() ? 1 : 0) - (none ? 1 : 0);
    Wide left = static_cast<Wide>(top_bits(a)) * top_bits(b);
    Wide right = static_cast<Wide>(top_bits(c)) * top_bits(d);
    const int lead = bit_length(a) + bit_length(b) - bit_length(c) - bit_length(d);
    if (lead > 2 || lead < -2) return lead < 0 ? -1 : 1;  // the tops are within a factor of 4 of one another
    if (lead > 0) right >>= lead;                         // and lose less than 1
    if (lead < 0) left >>= -lead;
    const Wide gap = left > right ? left - right : right - left;
    if ((gap >> 67) != 0) return left < right ? -1 : 1;

    const int base = std::min(a.exponent + b.exponent, c.exponent + d.exponent);
    std::uint64_t product[2][2 * k_most_limbs + 16];
    const auto place = [base](const Magnitude& x, const Magnitude& y) { return (x.exponent + y.exponent - base) / 64; };
    const int count = std::max(place(a, b) + a.limbs + b.limbs, place(c, d) + c.limbs + d.limbs);
    const auto multiply = [count](std::uint64_t* out, int at, const Magnitude& x, const Magnitude& y) {
        std::memset(out, 0, sizeof(std::uint64_t) * static_cast<std::size_t>(count));
        for (int i = 0; i < x.limbs; ++i) {
            if (x.limb[i] == 0) continue;
            std::uint64_t carry = 0;
            for (int j = 0; j < y.limbs; ++j) {
                const Wide wide = static_cast<Wide>(x.limb[i]) * y.limb[j] + out[at + i + j] + carry;
                out[at + i + j] = static_cast<std::uint64_t>(wide);
                carry = static_cast<std::uint64_t>(wide >> 64);
            }
            out[at + i + y.limbs] = carry;  // the rows before this one end below
        }
    };
    multiply(product[0], place(a, b), a, b);
    multiply(product[1], place(c, d), c, d);
    for (int i = count - 1; i >= 0; --i)
        if (product[0][i] != product[1][i]) return product[0][i] < product[1][i] ? -1 : 1;
    return 0;
}

}  // namespace pierce::detail
