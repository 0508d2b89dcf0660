// Exact sums of products of coordinates whose exponents are too far apart for integers of a fixed width: two
// fixed-point numbers (Kulisch 1971, a long accumulator), one for the terms with a plus and one for those with a minus,
// as long as the exponents in play need.
//
// Integers on a common lattice multiply numbers that are nearly all zeros there: 33 limbs by 33. Here a product is that
// of three mantissas, 159 bits at most, and is added where it belongs; so a volume costs 24 short products whatever the
// exponents.
#pragma once

#include <cstring>

#include <exact/lattice.h>

namespace pierce::detail {

/// The bits of a double with no zeros below: an odd mantissa, or 0.
struct Odd {
    std::uint64_t mantissa;
    int exponent;
    bool negative;

    Odd() = default;
    explicit Odd(double x) {
        const Bits bits(x);
        const int zeros = bits.mantissa == 0 ? 0 : std::countr_zero(bits.mantissa);
        mantissa = bits.mantissa >> zeros;
        exponent = bits.exponent + zeros;
        negative = bits.negative;
    }
};

using OddPoint = std::array<Odd, 3>;

[[nodiscard]] inline OddPoint odd(const Point& p) { return {Odd(p[0]), Odd(p[1]), Odd(p[2])}; }

/// Products of four doubles are multiples of 2^(-4 1074) below 2^(4 1024), and 512 of them below 2^9 more: 8401 bits,
/// 132 limbs. What is added may write zeros into four more.
inline constexpr std::size_t k_most_limbs = 136;

/// A number > 0 or 0: its limbs times 2^exponent, neither end a zero limb. Exponents of numbers from one lattice and
/// degree agree modulo 64.
struct Magnitude {
    std::uint64_t limb[k_most_limbs];
    int limbs = 0;
    int exponent = 0;

    Magnitude() {}  // NOLINT(modernize-use-equals-default): leaves the limbs as they are
    /// Of a double >= 0, with an exponent that is a multiple of 64.
    explicit Magnitude(double x) {
        const Odd odd(x);
        if (odd.mantissa == 0) return;
        exponent = odd.exponent & ~63;
        const int shift = odd.exponent - exponent;
        const Wide wide = static_cast<Wide>(odd.mantissa) << shift;
        limb[0] = static_cast<std::uint64_t>(wide);
        limb[1] = static_cast<std::uint64_t>(wide >> 64);
        trim(2);
    }

    /// Leaves the zeros at both ends out of the first `count` limbs.
    void trim(int count) {
        int low = 0;
        while (count > 0 && limb[count - 1] == 0) --count;
        while (low < count && limb[low] == 0) ++low;
        limbs = count - low;
        if (low == 0) return;
        exponent += 64 * low;
        std::memmove(limb, limb + low, sizeof(std::uint64_t) * static_cast<std::size_t>(limbs));
    }
    [[nodiscard]] bool zero() const { return limbs == 0; }
};

/// Of a number > 0: 1 + the exponent of its highest bit.
[[nodiscard]] inline int bit_length(const Magnitude& x) {
    return x.exponent + 64 * x.limbs - std::countl_zero(x.limb[x.limbs - 1]);
}

[[nodiscard]] inline std::uint64_t top_bits(const Magnitude& x) {
    const int shift = std::countl_zero(x.limb[x.limbs - 1]);
    std::uint64_t top = x.limb[x.limbs - 1] << shift;
    if (shift != 0 && x.limbs > 1) top |= x.limb[x.limbs - 2] >> (64 - shift);
    return top;
}

class Accumulator {
  public:
    /// For sums of at most 512 products of `degree` coordinates of the lattice.
    Accumulator(const Lattice& lattice, int degree)
        : base_(degree * lattice.lowest), limbs_((degree * lattice.bits() + 9 + 63) / 64) {
        for (auto& part : part_) std::memset(part, 0, sizeof(std::uint64_t) * static_cast<std::size_t>(limbs_ + 4));
    }

    void add(bool minus, const Odd& x, const Odd& y) {
        const Wide xy = static_cast<Wide>(x.mantissa) * y.mantissa;
        if (xy == 0) return;
        add_limbs(minus ^ x.negative ^ y.negative, static_cast<std::uint64_t>(xy), static_cast<std::uint64_t>(xy >> 64),
                  0, x.exponent + y.exponent);
    }
    /// x y (p - q)
    void add(bool minus, const Odd& x, const Odd& y, const Odd& p, const Odd& q) {
        const Wide xy = static_cast<Wide>(x.mantissa) * y.mantissa;
        if (xy == 0) return;
        minus ^= x.negative ^ y.negative;
        const auto low = static_cast<std::uint64_t>(xy);
        const auto high = static_cast<std::uint64_t>(xy >> 64);
        add_product(minus, low, high, x.exponent + y.exponent, p);
        add_product(!minus, low, high, x.exponent + y.exponent, q);
    }
    /// x y
    void add(bool minus, const Magnitude& x, const Odd& y) {
        if (y.mantissa == 0) return;
        for (int i = 0; i < x.limbs; ++i) {
            if (x.limb[i] == 0) continue;
            const Wide product = static_cast<Wide>(x.limb[i]) * y.mantissa;
            add_limbs(minus ^ y.negative, static_cast<std::uint64_t>(product),
                      static_cast<std::uint64_t>(product >> 64), 0, x.exponent + 64 * i + y.exponent);
        }
    }

    [[nodiscard]] int sign() const {
        for (int i = limbs_ - 1; i >= 0; --i)
            if (part_[0][i] != part_[1][i]) return part_[0][i] > part_[1][i] ? 1 : -1;
        return 0;
    }

    friend Magnitude magnitude(const Accumulator& x) {
        Magnitude out;
        const bool negative = x.sign() < 0;
        const std::uint64_t* const more = x.part_[negative ? 1 : 0];
        const std::uint64_t* const less = x.part_[negative ? 0 : 1];
        std::uint64_t borrow = 0;
        for (int i = 0; i < x.limbs_; ++i) {
            const Wide difference = static_cast<Wide>(more[i]) - less[i] - borrow;
            out.limb[i] = static_cast<std::uint64_t>(difference);
            borrow = static_cast<std::uint64_t>(difference >> 64) & 1;
        }
        out.exponent = x.base_;
        out.trim(x.limbs_);
        return out;
    }

  private:
    void add_product(bool minus, std::uint64_t low, std::uint64_t high, int exponent, const Odd& z) {
        if (z.mantissa == 0) return;
        const Wide first = static_cast<Wide>(low) * z.mantissa;
        const Wide second = static_cast<Wide>(high) * z.mantissa + static_cast<std::uint64_t>(first >> 64);
        add_limbs(minus ^ z.negative, static_cast<std::uint64_t>(first), static_cast<std::uint64_t>(second),
                  static_cast<std::uint64_t>(second >> 64), exponent + z.exponent);
    }

    void add_limbs(bool minus, std::uint64_t m0, std::uint64_t m1, std::uint64_t m2, int exponent) {
        const int at = (exponent - base_) >> 6;
        const int shift = (exponent - base_) & 63;
        std::uint64_t* const p = part_[minus ? 1 : 0] + at;
        // (x >> 1) >> (63 - shift) is x >> (64 - shift), and 0 for a shift of 0.
        Wide carry = static_cast<Wide>(p[0]) + (m0 << shift);
        p[0] = static_cast<std::uint64_t>(carry);
        carry = (carry >> 64) + p[1] + ((m1 << shift) | ((m0 >> 1) >> (63 - shift)));
        p[1] = static_cast<std::uint64_t>(carry);
        carry = (carry >> 64) + p[2] + ((m2 << shift) | ((m1 >> 1) >> (63 - shift)));
        p[2] = static_cast<std::uint64_t>(carry);
        carry = (carry >> 64) + p[3] + ((m2 >> 1) >> (63 - shift));
        p[3] = static_cast<std::uint64_t>(carry);
        if ((carry >> 64) != 0)
            for (int i = 4; ++p[i] == 0; ++i) {
            }
    }

    std::uint64_t part_[2][k_most_limbs];  // of the terms with a plus, and with a minus
    int base_;
    int limbs_;
};

}  // namespace pierce::detail
