// Signed integers of a fixed number of 64-bit limbs: what exact decisions are computed in where the coordinates'
// exponents are near enough to one another; accumulator.h serves the others.
//
// Why integers and not floating-point expansions (Shewchuk 1997): they have no rounding mode, no underflow and no
// overflow to guard against, compare and divide as well as they multiply, and measured faster
// (tests/bench/exact_bench.cpp).
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace pierce::detail {

__extension__ using Wide = unsigned __int128;

/// Two's complement, least significant limb first. The caller chooses the width so that nothing overflows.
template <int N>
struct Integer {
    std::uint64_t limb[std::size_t{N}] = {};

    [[nodiscard]] bool negative() const { return (limb[N - 1] >> 63) != 0; }
    [[nodiscard]] bool zero() const {
        std::uint64_t any = 0;
        for (std::uint64_t l : limb) any |= l;
        return any == 0;
    }
    [[nodiscard]] int sign() const { return negative() ? -1 : (zero() ? 0 : 1); }
};

template <int N>
[[nodiscard]] inline Integer<N> operator+(const Integer<N>& x, const Integer<N>& y) {
    Integer<N> sum;
    Wide carry = 0;
    for (int i = 0; i < N; ++i) {
        carry += static_cast<Wide>(x.limb[i]) + y.limb[i];
        sum.limb[i] = static_cast<std::uint64_t>(carry);
        carry >>= 64;
    }
    return sum;
}

template <int N>
[[nodiscard]] inline Integer<N> operator-(const Integer<N>& x, const Integer<N>& y) {
    Integer<N> difference;
    std::uint64_t borrow = 0;
    for (int i = 0; i < N; ++i) {
        const Wide wide = static_cast<Wide>(x.limb[i]) - y.limb[i] - borrow;
        difference.limb[i] = static_cast<std::uint64_t>(wide);
        borrow = static_cast<std::uint64_t>(wide >> 64) & 1;
    }
    return difference;
}

template <int N>
[[nodiscard]] inline Integer<N> operator-(const Integer<N>& x) {
    return Integer<N>{} - x;
}

template <int N>
[[nodiscard]] inline Integer<N> magnitude(const Integer<N>& x) {
    return x.negative() ? -x : x;
}

/// The full product: as wide as both factors together, so it can't overflow.
template <int N, int M>
[[nodiscard]] inline Integer<N + M> operator*(const Integer<N>& x, const Integer<M>& y) {
    // Schoolbook on the bit patterns read as unsigned; a negative x stands there as x + 2^(64 N), so its excess, y
    // shifted by N limbs, is taken off again, and likewise for y.
    Integer<N + M> product;
    for (int i = 0; i < N; ++i) {
        std::uint64_t carry = 0;
        for (int j = 0; j < M; ++j) {
            const Wide wide = static_cast<Wide>(x.limb[i]) * y.limb[j] + product.limb[i + j] + carry;
            product.limb[i + j] = static_cast<std::uint64_t>(wide);
            carry = static_cast<std::uint64_t>(wide >> 64);
        }
        product.limb[i + M] = carry;
    }
    const auto take_off = [&product](const auto& excess, int at, int limbs) {
        std::uint64_t borrow = 0;
        for (int j = 0; j < limbs; ++j) {
            const Wide wide = static_cast<Wide>(product.limb[at + j]) - excess.limb[j] - borrow;
            product.limb[at + j] = static_cast<std::uint64_t>(wide);
            borrow = static_cast<std::uint64_t>(wide >> 64) & 1;
        }
    };
    if (x.negative()) take_off(y, N, M);
    if (y.negative()) take_off(x, M, N);
    return product;
}

template <int N>
[[nodiscard]] inline int compare(const Integer<N>& x, const Integer<N>& y) {
    if (x.negative() != y.negative()) return x.negative() ? -1 : 1;
    for (int i = N - 1; i >= 0; --i)
        if (x.limb[i] != y.limb[i]) return x.limb[i] < y.limb[i] ? -1 : 1;
    return 0;
}

/// The same number in more limbs.
template <int M, int N>
[[nodiscard]] inline Integer<M> widen(const Integer<N>& x) {
    static_assert(M >= N);
    Integer<M> wide;
    const std::uint64_t fill = x.negative() ? ~std::uint64_t{0} : 0;
    for (int i = 0; i < M; ++i) wide.limb[i] = i < N ? x.limb[i] : fill;
    return wide;
}

/// x * 2^shift, where the caller knows that the result fits.
template <int N>
[[nodiscard]] inline Integer<N> operator<<(const Integer<N>& x, int shift) {
    Integer<N> moved;
    const int limbs = shift / 64;
    const int bits = shift % 64;
    for (int i = N - 1; i >= limbs; --i) {
        moved.limb[i] = x.limb[i - limbs] << bits;
        if (bits != 0 && i > limbs) moved.limb[i] |= x.limb[i - limbs - 1] >> (64 - bits);
    }
    return moved;
}

/// How many bits a number >= 0 takes: 0 for 0, else 1 + the exponent of its highest bit.
template <int N>
[[nodiscard]] inline int bit_length(const Integer<N>& x) {
    for (int i = N - 1; i >= 0; --i)
        if (x.limb[i] != 0) return 64 * i + 64 - std::countl_zero(x.limb[i]);
    return 0;
}

/// The highest 64 bits of a number > 0, cut off below: x = top * 2^(bit_length - 64) * (1 + e) with 0 <= e < 2^-63.
template <int N>
[[nodiscard]] inline std::uint64_t top_bits(const Integer<N>& x) {
    int i = N - 1;
    while (x.limb[i] == 0) --i;
    const int shift = std::countl_zero(x.limb[i]);
    std::uint64_t top = x.limb[i] << shift;
    if (shift != 0 && i > 0) top |= x.limb[i - 1] >> (64 - shift);
    return top;
}

}  // namespace pierce::detail
