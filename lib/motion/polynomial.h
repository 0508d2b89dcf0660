// Polynomials of degree 3 at most with whole coefficients: in Bernstein form over an interval, which is halved to
// enclose roots, and in powers of t, for common divisors and values at fractions.
//
// A polynomial stands for all its positive multiples: only signs and roots are asked for.
#pragma once

#include <cmath>

#include <motion/whole.h>

namespace pierce::detail {

/// sum of b[i] C(degree, i) t^i (1 - t)^(degree - i), t from 0 to 1 across the interval.
template <int C>
struct Bernstein {
    int degree = 0;
    Whole<C> b[4];

    [[nodiscard]] bool zero() const {
        for (int i = 0; i <= degree; ++i)
            if (!b[i].zero()) return false;
        return true;
    }
    /// The sign just after the start of the interval, and just before its end; 0 for the zero polynomial only.
    [[nodiscard]] int sign_after_start() const {
        for (int i = 0; i <= degree; ++i)
            if (!b[i].zero()) return b[i].sign();
        return 0;
    }
    [[nodiscard]] int sign_before_end() const {
        for (int i = degree; i >= 0; --i)
            if (!b[i].zero()) return b[i].sign();
        return 0;
    }
    /// How often the sign changes along the coefficients, zeros left out: as many roots as there are inside the
    /// interval, or more by an even number (Descartes' rule; Lane and Riesenfeld 1981).
    [[nodiscard]] int variations() const {
        int last = 0;
        int changes = 0;
        for (int i = 0; i <= degree; ++i) {
            const int sign = b[i].sign();
            if (sign == 0) continue;
            if (last != 0 && sign != last) ++changes;
            last = sign;
        }
        return changes;
    }
};

/// The polynomial on one half of its interval, times 2^degree (de Casteljau): bits are added, `degree` of them at most.
template <int C>
inline void halve(Bernstein<C>& p, bool right) {
    const int n = p.degree;
    // Row k of the scheme: sums of 2^k neighbours' weights. The left half has the first of each row, the right half the
    // last; what stays in the row is in place already.
    for (int k = 1; k <= n; ++k) {
        if (right)
            for (int i = 0; i <= n - k; ++i) add_to(p.b[i], p.b[i + 1]);
        else
            for (int i = n; i >= k; --i) add_to(p.b[i], p.b[i - 1]);
    }
    // b[i] is now 2^i (left), 2^(n-i) (right) times what it should be.
    for (int i = 0; i <= n; ++i) shift_up(p.b[i], right ? i : n - i);
}

/// (a x + b y) of numbers >= 0 of one limb.
template <int C>
[[nodiscard]] inline Whole<C> mixed(const Whole<C>& x, std::uint64_t a, const Whole<C>& y, std::uint64_t b) {
    Whole<C> sum;
    multiply(sum, x, whole<1>(a));
    add_product(sum, y, whole<1>(b));
    return sum;
}

/// The polynomial on the part from i / n to (i + 1) / n of its interval, times n^degree: its blossoms there (Ramshaw
/// 1987).
template <int C>
inline void restrict_to_part(const Bernstein<C>& p, std::uint64_t i, std::uint64_t n, Bernstein<C>& out) {
    out.degree = p.degree;
    // Blossom k takes the part's start degree - k times, and its end k times.
    for (int k = 0; k <= p.degree; ++k) {
        Whole<C> row[4];
        for (int j = 0; j <= p.degree; ++j) row[j] = p.b[j];
        for (int level = 0; level < p.degree; ++level) {
            const std::uint64_t at = level < k ? i + 1 : i;
            for (int j = 0; j < p.degree - level; ++j) row[j] = mixed(row[j], n - at, row[j + 1], at);
        }
        out.b[k] = row[0];
    }
}

/// About where the polynomial, with different signs at the ends of its interval, has a root there: by its
/// coefficients' highest bits.
template <int C>
[[nodiscard]] inline double estimate_root(const Bernstein<C>& p) {
    int limbs = 0;
    for (int i = 0; i <= p.degree; ++i) limbs = std::max(limbs, p.b[i].count);
    double b[4] = {};
    for (int i = 0; i <= p.degree; ++i) {
        for (int j = std::max(0, limbs - 3); j < p.b[i].count; ++j)
            b[i] += std::ldexp(static_cast<double>(p.b[i].limb[j]), 64 * (j - limbs));
        if (p.b[i].minus) b[i] = -b[i];
    }
    double low = 0;
    double high = 1;
    double t = b[0] / (b[0] - b[p.degree]);
    for (int i = 0; i < 60; ++i) {
        double row[4] = {b[0], b[1], b[2], b[3]};
        for (int level = p.degree; level > 1; --level)
            for (int j = 0; j < level; ++j) row[j] = (1 - t) * row[j] + t * row[j + 1];
        const double value = (1 - t) * row[0] + t * row[1];
        if (value == 0) break;
        if ((value > 0) == (b[0] > 0))
            low = t;
        else
            high = t;
        double next = t - value / (p.degree * (row[1] - row[0]));
        if (!(next > low && next < high)) next = low / 2 + high / 2;
        if (std::fabs(next - t) <= 0x1p-53 * t) break;
        t = next;
    }
    return t;
}

template <int C>
[[nodiscard]] inline int sign_in_middle(const Bernstein<C>& p) {
    Whole<C> sum;
    for (int i = 1; i < p.degree; ++i) add_to(sum, p.b[i]);
    if (p.degree == 3 || p.degree == 2) {  // times C(degree, 1)
        const Whole<C> once = sum;
        shift_up(sum, 1);
        if (p.degree == 3) add_to(sum, once);
    }
    add_to(sum, p.b[0]);
    add_to(sum, p.b[p.degree]);
    return sum.sign();
}

/// sum of c[i] t^i; degree -1 for the zero polynomial, else c[degree] is not 0.
template <int C>
struct Powers {
    int degree = -1;
    Whole<C> c[4];

    Powers() = default;
    /// Of the same polynomial on [0, 1], or a multiple > 0.
    explicit Powers(const Bernstein<C>& p) : degree(p.degree) {
        // The differences of order k, times C(degree, k).
        for (int i = 0; i <= degree; ++i) c[i] = p.b[i];
        for (int k = 1; k <= degree; ++k)
            for (int i = degree; i >= k; --i) add_to(c[i], c[i - 1], true);
        for (int i = 1; i < degree; ++i) c[i] = c[i] * whole<C>(static_cast<std::uint64_t>(degree));  // C(2,1), C(3,1)
        trim();
    }
    void trim() {
        while (degree >= 0 && c[degree].zero()) --degree;
    }
};

/// On [0, 1], times 3.
template <int C>
[[nodiscard]] inline Bernstein<C> bernstein(const Powers<C>& p) {
    // t^k has the coefficients C(i, k) / C(n, k); n = 3 serves all degrees.
    static constexpr std::uint64_t k_weight[4][4] = {{3, 0, 0, 0}, {3, 1, 0, 0}, {3, 2, 1, 0}, {3, 3, 3, 3}};
    Bernstein<C> out;
    out.degree = 3;
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k <= p.degree; ++k) add_product(out.b[i], p.c[k], whole<C>(k_weight[i][k]));
    return out;
}

/// The sign of p(n / d), d > 0.
template <int C>
[[nodiscard]] inline int sign_at(const Powers<C>& p, const Whole<C>& n, const Whole<C>& d) {
    if (p.degree < 0) return 0;
    Whole<C> value = p.c[p.degree];
    Whole<C> power = d;
    for (int i = p.degree - 1; i >= 0; --i) {
        Whole<C> next;
        multiply(next, value, n);
        add_product(next, p.c[i], power);
        value = next;
        if (i > 0) power = power * d;
    }
    return value.sign();
}

/// x is replaced by a multiple of the remainder of its division by y, whose degree is 0 at least.
template <int C>
inline void reduce(Powers<C>& x, const Powers<C>& y) {
    while (x.degree >= y.degree) {
        const int shift = x.degree - y.degree;
        const Whole<C> lead = x.c[x.degree];
        for (int i = 0; i < x.degree; ++i) {
            Whole<C> next;
            multiply(next, x.c[i], y.c[y.degree]);
            if (i >= shift) add_product(next, y.c[i - shift], lead, true);
            x.c[i] = next;
        }
        --x.degree;
        x.trim();
    }
}

/// The greatest common divisor of two polynomials, neither of which is zero, by Euclid. Left in x; y is used up.
template <int C>
inline void divide_common(Powers<C>& x, Powers<C>& y) {
    for (;;) {
        reduce(x, y);
        if (x.degree < 0) {
            x = y;
            return;
        }
        if (x.degree == 0) return;
        reduce(y, x);
        if (y.degree < 0) return;
        if (y.degree == 0) {
            x = y;
            return;
        }
    }
}

}  // namespace pierce::detail
