// Whole numbers of a length that varies, in a room of fixed size: what the roots of polynomials are enclosed in. How
// long they get depends on how near to each other roots lie, so Integer<N>, as long as the longest, would nearly
// always be too long.
#pragma once

#include <cstring>

#include <exact/lattice.h>

namespace pierce::detail {

/// Sign and magnitude, the least significant limb first, no zero limb on top. Whoever computes knows that `Capacity`
/// limbs are enough.
template <int Capacity>
struct Whole {
    int count = 0;
    bool minus = false;
    std::uint64_t limb[std::size_t{Capacity}];

    Whole() {}  // NOLINT(modernize-use-equals-default): leaves the limbs as they are
    Whole(const Whole& x) { *this = x; }
    template <int Other>
    requires(Other != Capacity) explicit Whole(const Whole<Other>& x) : count(x.count), minus(x.minus) {
        std::memcpy(limb, x.limb, sizeof(std::uint64_t) * static_cast<std::size_t>(x.count));
    }
    Whole& operator=(const Whole& x) {
        count = x.count;
        minus = x.minus;
        if (this != &x) std::memcpy(limb, x.limb, sizeof(std::uint64_t) * static_cast<std::size_t>(x.count));
        return *this;
    }
    ~Whole() = default;

    [[nodiscard]] bool zero() const { return count == 0; }
    [[nodiscard]] int sign() const { return count == 0 ? 0 : minus ? -1 : 1; }

    void trim() {
        while (count > 0 && limb[count - 1] == 0) --count;
    }
    void negate() { minus = !minus; }
};

template <int C, int A>
[[nodiscard]] inline int compare_magnitudes(const Whole<C>& x, const Whole<A>& y) {
    if (x.count != y.count) return x.count < y.count ? -1 : 1;
    for (int i = x.count - 1; i >= 0; --i)
        if (x.limb[i] != y.limb[i]) return x.limb[i] < y.limb[i] ? -1 : 1;
    return 0;
}

/// x += y, or x -= y.
template <int C, int A>
inline void add_to(Whole<C>& x, const Whole<A>& y, bool subtract = false) {
    if (y.zero()) return;
    if (x.zero()) {
        x = Whole<C>(y);
        x.minus = y.minus != subtract;
        return;
    }
    if (x.minus == (y.minus != subtract)) {
        const int longest = x.count > y.count ? x.count : y.count;
        std::uint64_t carry = 0;
        for (int i = 0; i < longest; ++i) {
            const Wide sum = static_cast<Wide>(i < x.count ? x.limb[i] : 0) + (i < y.count ? y.limb[i] : 0) + carry;
            x.limb[i] = static_cast<std::uint64_t>(sum);
            carry = static_cast<std::uint64_t>(sum >> 64);
        }
        x.count = longest;
        if (carry != 0) x.limb[x.count++] = carry;
        return;
    }
    const auto difference = [&x](const auto& more, const auto& less) {
        std::uint64_t borrow = 0;
        for (int i = 0; i < more.count; ++i) {
            const Wide wide = static_cast<Wide>(more.limb[i]) - (i < less.count ? less.limb[i] : 0) - borrow;
            x.limb[i] = static_cast<std::uint64_t>(wide);
            borrow = static_cast<std::uint64_t>(wide >> 64) & 1;
        }
        x.count = more.count;
        x.trim();
    };
    const int order = compare_magnitudes(x, y);
    if (order >= 0) {
        difference(x, y);
    } else {
        difference(y, x);
        x.minus = !x.minus;
    }
}

template <int C>
[[nodiscard]] inline Whole<C> operator+(Whole<C> x, const Whole<C>& y) {
    add_to(x, y);
    return x;
}
template <int C>
[[nodiscard]] inline Whole<C> operator-(Whole<C> x, const Whole<C>& y) {
    add_to(x, y, true);
    return x;
}

/// out = x y, which is neither of the two.
template <int C, int A, int B>
inline void multiply(Whole<C>& out, const Whole<A>& x, const Whole<B>& y) {
    if (x.zero() || y.zero()) {
        out.count = 0;
        return;
    }
    out.count = x.count + y.count;
    out.minus = x.minus != y.minus;
    std::memset(out.limb, 0, sizeof(std::uint64_t) * static_cast<std::size_t>(out.count));
    for (int i = 0; i < x.count; ++i) {
        std::uint64_t carry = 0;
        for (int j = 0; j < y.count; ++j) {
            const Wide wide = static_cast<Wide>(x.limb[i]) * y.limb[j] + out.limb[i + j] + carry;
            out.limb[i + j] = static_cast<std::uint64_t>(wide);
            carry = static_cast<std::uint64_t>(wide >> 64);
        }
        out.limb[i + y.count] = carry;
    }
    out.trim();
}
/// out += x y, or out -= x y.
template <int C, int A, int B>
inline void add_product(Whole<C>& out, const Whole<A>& x, const Whole<B>& y, bool subtract = false) {
    Whole<C> product;
    multiply(product, x, y);
    add_to(out, product, subtract);
}
template <int C>
[[nodiscard]] inline Whole<C> operator*(const Whole<C>& x, const Whole<C>& y) {
    Whole<C> product;
    multiply(product, x, y);
    return product;
}

/// x *= 2^shift.
template <int C>
inline void shift_up(Whole<C>& x, int shift) {
    if (x.zero() || shift == 0) return;
    const int limbs = shift / 64;
    const int bits = shift % 64;
    if (limbs > 0) {
        std::memmove(x.limb + limbs, x.limb, sizeof(std::uint64_t) * static_cast<std::size_t>(x.count));
        std::memset(x.limb, 0, sizeof(std::uint64_t) * static_cast<std::size_t>(limbs));
        x.count += limbs;
    }
    if (bits == 0) return;
    const std::uint64_t out = x.limb[x.count - 1] >> (64 - bits);
    for (int i = x.count - 1; i > limbs; --i) x.limb[i] = x.limb[i] << bits | x.limb[i - 1] >> (64 - bits);
    x.limb[limbs] <<= bits;
    if (out != 0) x.limb[x.count++] = out;
}

template <int C>
[[nodiscard]] inline int compare(const Whole<C>& x, const Whole<C>& y) {
    if (x.sign() != y.sign()) return x.sign() < y.sign() ? -1 : 1;
    return x.minus ? compare_magnitudes(y, x) : compare_magnitudes(x, y);
}

template <int C>
[[nodiscard]] inline Whole<C> whole(std::uint64_t x) {
    Whole<C> out;
    out.limb[0] = x;
    out.count = x != 0 ? 1 : 0;
    return out;
}

template <int C>
[[nodiscard]] inline Whole<C> whole(double x, const Lattice& lattice) {
    const Bits bits(x);
    if (bits.mantissa == 0) return {};
    const int zeros = std::countr_zero(bits.mantissa);
    Whole<C> out = whole<C>(bits.mantissa >> zeros);
    shift_up(out, bits.exponent + zeros - lattice.lowest);
    out.minus = bits.negative;
    return out;
}

}  // namespace pierce::detail
