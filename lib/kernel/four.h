// Four doubles in step, for the coordinates of a hit: as two pairs, on any machine. fused.h has the same in one
// register of AVX2. Both do the same operations in the same order, so all bits are the same.
//
// A mask has all bits of a lane set or none. Comparisons with NaN are false. The fourth lane is nobody's where three
// coordinates go in.
#pragma once

#include <cstdint>

#include <kernel/double_double.h>
#include <kernel/triple.h>

namespace pierce::detail {

/// The Scalar next to `x`, which is a finite one, in the direction of the sign of `sign`, +0 and -0 included. Without a
/// branch: which way it goes can't be predicted.
template <class Scalar>
[[nodiscard]] [[gnu::always_inline]] inline double next_to(double x, double sign) {
    if constexpr (sizeof(Scalar) == 4) {
        const std::uint32_t bits = __builtin_bit_cast(std::uint32_t, static_cast<float>(x));
        const auto wanted = static_cast<std::uint32_t>(__builtin_bit_cast(std::uint64_t, sign) >> 63 << 31);
        const std::uint32_t next = (bits & 0x80000000U) == wanted ? bits + 1 : bits - 1;
        return __builtin_bit_cast(float, x == 0 ? wanted | 1U : next);
    } else {
        const std::uint64_t bits = __builtin_bit_cast(std::uint64_t, x);
        const std::uint64_t wanted = __builtin_bit_cast(std::uint64_t, sign) >> 63 << 63;
        const std::uint64_t next = (bits & std::uint64_t{1} << 63) == wanted ? bits + 1 : bits - 1;
        return __builtin_bit_cast(double, x == 0 ? wanted | 1U : next);
    }
}

struct TwoPairs {
    Pair low;
    Pair high;

    using Product = Dekker;
#define PIERCE_INLINE [[nodiscard]] [[gnu::always_inline]] static inline
    PIERCE_INLINE TwoPairs all(double x) { return {both(x), both(x)}; }
    PIERCE_INLINE TwoPairs of(Pair low, Pair high) { return {low, high}; }
    PIERCE_INLINE TwoPairs load(const double* x) { return {Pair{x[0], x[1]}, Pair{x[2], x[3]}}; }
    PIERCE_INLINE TwoPairs load_point(const double* x) { return {Pair{x[0], x[1]}, Pair{x[2], 0}}; }
    /// One lane of three pairs.
    PIERCE_INLINE TwoPairs first_lanes(const Triple<Pair>& x) { return {Pair{x.x[0], x.y[0]}, Pair{x.z[0], x.z[0]}}; }
    PIERCE_INLINE TwoPairs second_lanes(const Triple<Pair>& x) { return {Pair{x.x[1], x.y[1]}, Pair{x.z[1], x.z[1]}}; }
    [[gnu::always_inline]] inline void store(double* to) const {
        __builtin_memcpy(to, &low, sizeof low);
        __builtin_memcpy(to + 2, &high, sizeof high);
    }

    template <class Scalar>
    [[gnu::always_inline]] inline void round_to(Scalar* to) const {
        to[0] = static_cast<Scalar>(low[0]);
        to[1] = static_cast<Scalar>(low[1]);
        to[2] = static_cast<Scalar>(high[0]);
        to[3] = static_cast<Scalar>(high[1]);
    }

    [[gnu::always_inline]] friend inline TwoPairs operator+(TwoPairs x, TwoPairs y) {
        return {x.low + y.low, x.high + y.high};
    }
    [[gnu::always_inline]] friend inline TwoPairs operator-(TwoPairs x, TwoPairs y) {
        return {x.low - y.low, x.high - y.high};
    }
    [[gnu::always_inline]] friend inline TwoPairs operator*(TwoPairs x, TwoPairs y) {
        return {x.low * y.low, x.high * y.high};
    }
    [[gnu::always_inline]] friend inline TwoPairs operator-(TwoPairs x) { return {-x.low, -x.high}; }
    [[gnu::always_inline]] friend inline TwoPairs operator*(double x, TwoPairs y) { return all(x) * y; }

    [[gnu::always_inline]] friend inline TwoPairs operator&(TwoPairs x, TwoPairs y) {
        return {as_numbers(bits(x.low) & bits(y.low)), as_numbers(bits(x.high) & bits(y.high))};
    }
    [[gnu::always_inline]] friend inline TwoPairs operator|(TwoPairs x, TwoPairs y) {
        return {as_numbers(bits(x.low) | bits(y.low)), as_numbers(bits(x.high) | bits(y.high))};
    }
    PIERCE_INLINE TwoPairs less(TwoPairs x, TwoPairs y) {
        return {as_numbers(x.low < y.low), as_numbers(x.high < y.high)};
    }
    PIERCE_INLINE TwoPairs at_most(TwoPairs x, TwoPairs y) {
        return {as_numbers(x.low <= y.low), as_numbers(x.high <= y.high)};
    }
    PIERCE_INLINE TwoPairs equal(TwoPairs x, TwoPairs y) {
        return {as_numbers(x.low == y.low), as_numbers(x.high == y.high)};
    }
    PIERCE_INLINE TwoPairs select(TwoPairs mask, TwoPairs yes, TwoPairs no) {
        return {as_numbers((bits(mask.low) & bits(yes.low)) | (~bits(mask.low) & bits(no.low))),
                as_numbers((bits(mask.high) & bits(yes.high)) | (~bits(mask.high) & bits(no.high)))};
    }
    PIERCE_INLINE double lane(TwoPairs x, int i) { return i < 2 ? x.low[i] : x.high[i - 2]; }
    /// The sign bits of the lanes, the first one lowest.
    PIERCE_INLINE unsigned signs(TwoPairs x) {
        const PairMask low = bits(x.low);
        const PairMask high = bits(x.high);
        return static_cast<unsigned>(low[0] < 0) | static_cast<unsigned>(low[1] < 0) << 1 |
               static_cast<unsigned>(high[0] < 0) << 2 | static_cast<unsigned>(high[1] < 0) << 3;
    }

    /// For each of four vectors the sum of its first three lanes: (x + y) + z.
    PIERCE_INLINE TwoPairs sums(TwoPairs a, TwoPairs b, TwoPairs c, TwoPairs d) {
        return {(Pair{a.low[0], b.low[0]} + Pair{a.low[1], b.low[1]}) + Pair{a.high[0], b.high[0]},
                (Pair{c.low[0], d.low[0]} + Pair{c.low[1], d.low[1]}) + Pair{c.high[0], d.high[0]}};
    }

    template <class Scalar>
    PIERCE_INLINE TwoPairs rounded(TwoPairs x) {
        return {Pair{rounded_lane<Scalar>(x.low[0]), rounded_lane<Scalar>(x.low[1])},
                Pair{rounded_lane<Scalar>(x.high[0]), rounded_lane<Scalar>(x.high[1])}};
    }
    /// The Scalars next to those in x, in the directions of the signs of `sign`, +0 and -0 included.
    template <class Scalar>
    PIERCE_INLINE TwoPairs next_to(TwoPairs x, TwoPairs sign) {
        return {
            Pair{detail::next_to<Scalar>(x.low[0], sign.low[0]), detail::next_to<Scalar>(x.low[1], sign.low[1])},
            Pair{detail::next_to<Scalar>(x.high[0], sign.high[0]), detail::next_to<Scalar>(x.high[1], sign.high[1])}};
    }

  private:
    PIERCE_INLINE PairMask bits(Pair x) { return reinterpret_cast<PairMask>(x); }
    PIERCE_INLINE Pair as_numbers(PairMask x) { return reinterpret_cast<Pair>(x); }
    template <class Scalar>
    PIERCE_INLINE double rounded_lane(double x) {
        return static_cast<double>(static_cast<Scalar>(x));
    }
};

template <class Four>
[[nodiscard]] [[gnu::always_inline]] inline Four magnitudes(Four x) {
    return x & Four::all(__builtin_bit_cast(double, 0x7fffffffffffffffLL));
}
/// Double-doubles of which both parts are four.
template <class Four>
using FineFour = BasicDoubleDouble<Four, typename Four::Product>;

}  // namespace pierce::detail
