// Roots of polynomials between 0 and 1, each as a fraction or enclosed by halving: their order, and the signs of other
// polynomials there.
#pragma once

#include <motion/polynomial.h>

namespace pierce::detail {

/// Which half was taken, `depth` times: the interval (m, m + 1) / 2^depth, m being the halves read as binary digits.
template <int C>
struct Halves {
    int depth = 0;
    std::uint64_t digits[std::size_t{C / 3 + 2}];  // cubics grow by three bits a halving, so they are full first

    Halves() {}  // NOLINT(modernize-use-equals-default): leaves the digits as they are
    Halves(const Halves& x) { *this = x; }
    Halves& operator=(const Halves& x) {
        depth = x.depth;
        if (this != &x)
            std::memcpy(digits, x.digits, sizeof(std::uint64_t) * static_cast<std::size_t>((depth + 63) / 64));
        return *this;
    }
    ~Halves() = default;

    [[nodiscard]] bool right(int i) const { return (digits[i / 64] >> (63 - i % 64) & 1) != 0; }
    void add(bool right) {
        if (depth % 64 == 0) digits[depth / 64] = 0;
        if (right) digits[depth / 64] |= std::uint64_t{1} << (63 - depth % 64);
        ++depth;
    }
    [[nodiscard]] Whole<C> number() const {
        Whole<C> m;
        for (int i = 0; i < depth; ++i) {
            shift_up(m, 1);
            if (right(i)) add_to(m, whole<C>(1));
        }
        return m;
    }
};

template <int C>
inline void restrict_to(Bernstein<C>& p, const Halves<C>& halves) {
    for (int i = 0; i < halves.depth; ++i) halve(p, halves.right(i));
}

/// A root of `of`, which must outlive it: n / d, or the only root inside an interval, a simple one.
template <int C>
struct Root {
    const Bernstein<C>* of = nullptr;
    bool is_fraction = false;
    Whole<C> n, d;
    Halves<C> halves;
    Bernstein<C> here;  ///< `of` on the interval

    void set_fraction(const Bernstein<C>& polynomial, const Whole<C>& numerator, const Whole<C>& denominator) {
        of = &polynomial;
        is_fraction = true;
        n = numerator;
        d = denominator;
        if (d.sign() < 0) {
            n.negate();
            d.negate();
        }
    }
    void set_middle(const Bernstein<C>& polynomial, const Halves<C>& of_interval) {
        of = &polynomial;
        Halves<C> middle = of_interval;
        middle.add(true);
        set_end(middle, 0);
    }
    /// The fraction m / 2^depth, m being the digits of `at` and `more`, 1 or 0.
    void set_end(const Halves<C>& at, std::uint64_t more) {
        Whole<C> number = at.number();
        add_to(number, whole<C>(more));
        Whole<C> power = whole<C>(1);
        shift_up(power, at.depth);
        set_fraction(*of, number, power);
    }
    /// As many halvings as it says, at once: an estimate of the root names the part, and it is taken if the root is
    /// there. False if not.
    bool leap(int count) {
        // Of another root at an end of the interval the estimate could be.
        if (here.b[0].zero() || here.b[here.degree].zero()) return false;
        const double estimate = estimate_root(here);
        const double steps = std::ldexp(1.0, count);
        if (!(estimate > 0 && estimate < 1)) return false;
        const auto part = static_cast<std::uint64_t>(estimate * steps);
        Bernstein<C> there;
        restrict_to_part(here, part, static_cast<std::uint64_t>(1) << count, there);
        const int start = there.b[0].sign();
        const int end = there.b[there.degree].sign();
        if (start == end) return false;
        for (int i = count - 1; i >= 0; --i) halves.add((part >> i & 1) != 0);
        if (start == 0 || end == 0)
            set_end(halves, start == 0 ? 0 : 1);
        else
            here = there;
        return true;
    }
    /// Halves the interval, which may show that the root is its middle.
    void refine() {
        const int middle = sign_in_middle(here);
        if (middle == 0) {
            set_middle(*of, halves);
            return;
        }
        const bool right = middle == here.sign_after_start();
        halve(here, right);
        halves.add(right);
    }
};

/// Whether q, which is not zero, has the root, no fraction, too.
template <int C>
[[nodiscard]] inline bool shares(const Root<C>& root, const Bernstein<C>& q) {
    Powers<C> common(*root.of);
    {
        Powers<C> other(q);
        divide_common(common, other);
    }
    if (common.degree == 0) return false;
    // It divides `of`, so it has no other root in the interval either, and this one once.
    Bernstein<C> divisor = bernstein(common);
    restrict_to(divisor, root.halves);
    return divisor.sign_after_start() != divisor.sign_before_end();
}

/// The sign of q at the root. Halves the root's interval until it can tell.
///
/// That ends: where q is not 0 at the root it is at least 2^-(10 L + 46) there, for a cubic of differences of
/// coordinates of L bits and a polynomial of degree 2 in them. Since |q(r)| >= 1 / (|f|^2 |q|^2) (from their
/// resultant, a whole number, and Mahler's measure), with |f| < 2^(3L + 14) the norm of f in powers of t and |q| <
/// 2^(2L + 9) that of q. So after 12 L + 56 halvings q has one sign all over the interval.
template <int C>
[[nodiscard]] inline int sign_at(Root<C>& root, const Bernstein<C>& q) {
    if (q.variations() == 0) return q.sign_after_start();  // inside the interval each weight is > 0
    Bernstein<C> here;
    bool shared_asked = false;
    if (!root.is_fraction) {
        here = q;
        restrict_to(here, root.halves);
    }
    for (int steps = 0;; ++steps) {
        if (root.is_fraction) return sign_at(Powers<C>(q), root.n, root.d);
        if (here.variations() == 0) return here.sign_after_start();
        if (steps >= 3 && !shared_asked) {
            shared_asked = true;
            if (shares(root, q)) return 0;
        }
        root.refine();
        if (!root.is_fraction) halve(here, root.halves.right(root.halves.depth - 1));
    }
}

/// The order of a root and n / d, d > 0.
template <int C>
[[nodiscard]] inline int compare_fraction(const Root<C>& root, const Whole<C>& n, const Whole<C>& d) {
    if (root.is_fraction) return compare(root.n * d, n * root.d);
    Whole<C> scaled = n;
    shift_up(scaled, root.halves.depth);
    Whole<C> bound = root.halves.number();
    if (compare(scaled, bound * d) <= 0) return 1;
    add_to(bound, whole<C>(1));
    if (compare(scaled, bound * d) >= 0) return -1;
    const int sign = sign_at(Powers<C>(*root.of), n, d);
    return sign == 0 ? 0 : sign == root.here.sign_after_start() ? 1 : -1;
}

/// The order of two roots; of equal ones it says 0. Halves their intervals until they are apart: for cubics of
/// coordinates of L bits at most 18 L + 90 times, by the bound of `sign_at`.
template <int C>
[[nodiscard]] inline int compare(Root<C>& x, Root<C>& y) {
    bool shared_asked = false;
    for (;;) {
        if (x.is_fraction) return -compare_fraction(y, x.n, x.d);
        if (y.is_fraction) return compare_fraction(x, y.n, y.d);
        if (x.halves.depth < y.halves.depth) {
            x.refine();
            continue;
        }
        if (y.halves.depth < x.halves.depth) {
            y.refine();
            continue;
        }
        const int limbs = (x.halves.depth + 63) / 64;
        for (int i = 0; i < limbs; ++i)
            if (x.halves.digits[i] != y.halves.digits[i]) return x.halves.digits[i] < y.halves.digits[i] ? -1 : 1;
        // One interval, in which each polynomial has one root.
        if (!shared_asked && x.halves.depth >= 8) {
            shared_asked = true;
            if (shares(x, *y.of)) return 0;
        }
        x.refine();
        if (!x.is_fraction) y.refine();
    }
}

/// Where a root lies: both are equal where that is a double. Rounded outwards from a multiple of 2^-62 or from the
/// root itself.
struct Enclosure {
    double earliest;
    double latest;
};
template <int C>
[[nodiscard]] Enclosure enclose(Root<C>& root) {
    constexpr int k_digits = 62;
    while (!root.is_fraction && root.halves.depth < k_digits)
        if (!root.leap(std::min(40, k_digits - root.halves.depth)))
            for (int i = 0; i < 6 && !root.is_fraction && root.halves.depth < k_digits; ++i) root.refine();
    std::uint64_t m = 0;
    bool exact = false;
    if (root.is_fraction) {  // long division
        Whole<C> rest = root.n;
        for (int i = 0; i < k_digits; ++i) {
            shift_up(rest, 1);
            m <<= 1;
            if (compare(rest, root.d) < 0) continue;
            add_to(rest, root.d, true);
            m |= 1;
        }
        exact = rest.zero();
    } else {
        m = root.halves.digits[0] >> (64 - k_digits);  // digits behind these make it larger, by less than 1
    }
    const auto down = [](std::uint64_t x) {  // to 53 bits
        const int more = 11 - std::countl_zero(x);
        return x == 0 || more <= 0 ? x : x >> more << more;
    };
    const std::uint64_t above = exact ? m : m + 1;
    const std::uint64_t low = down(m);
    std::uint64_t high = down(above);
    if (high != above) high += std::uint64_t{1} << (11 - std::countl_zero(above));
    return {static_cast<double>(low) * 0x1p-62, static_cast<double>(high) * 0x1p-62};
}

/// Calls meet(turns) for the roots strictly between 0 and 1, in their order, if one of all roots is a multiple one:
/// then all are fractions, as that one is the root of a common divisor with whole coefficients. `turns`: the sign of f
/// changes there. Until meet says true: 1, else 0; -1 where all roots are simple.
template <int C, class Meet>
int multiple_roots(const Bernstein<C>& f, Root<C>& root, Meet&& meet) {
    const Powers<C> p(f);
    if (p.degree < 2) return -1;
    Powers<C> common = p;
    {
        Powers<C> slope;
        slope.degree = p.degree - 1;
        for (int i = 0; i <= slope.degree; ++i) slope.c[i] = p.c[i + 1] * whole<C>(static_cast<std::uint64_t>(i + 1));
        divide_common(common, slope);
    }
    if (common.degree == 0) return -1;
    const auto inside = [&root] { return root.n.sign() > 0 && compare(root.n, root.d) < 0; };
    Whole<C> n = common.c[common.degree - 1];
    n.negate();
    if (common.degree == 2) {  // threefold, and the divisor's root twofold
        root.set_fraction(f, n, common.c[2] + common.c[2]);
        return inside() && meet(true) ? 1 : 0;
    }
    const Whole<C> d = common.c[1];
    root.set_fraction(f, n, d);
    if (p.degree == 2) return inside() && meet(false) ? 1 : 0;
    // The sum of the three roots is -c2 / c3.
    const Whole<C> single_d = p.c[3] * d;
    Whole<C> single_n = p.c[2] * d;
    add_product(single_n, n + n, p.c[3]);
    single_n.negate();
    Whole<C> order = single_n * d;  // the single root less the double one, times both denominators
    add_product(order, n, single_d, true);
    const bool single_first = order.sign() * single_d.sign() * d.sign() < 0;
    for (const bool single : {single_first, !single_first}) {
        root.set_fraction(f, single ? single_n : n, single ? single_d : d);
        if (inside() && meet(single)) return 1;
    }
    return 0;
}

/// Calls visit(before, after), `root` being set, for the roots of f strictly between 0 and 1, in their order, with the
/// signs of f just before and just after, until it says true; says whether it did. f is not zero, and outlives the
/// roots.
template <int C, class Visit>
bool each_root(const Bernstein<C>& f, Root<C>& root, Visit&& visit) {
    int side = f.sign_after_start();
    const auto meet = [&](bool turns) {
        const int before = side;
        if (turns) side = -side;
        return visit(before, side);
    };
    if (f.variations() == 0) return false;
    if (f.variations() > 1)
        if (const int answer = multiple_roots(f, root, meet); answer >= 0) return answer != 0;

    // All roots are simple. Intervals to come are those with a root, and middles that are one: three at most.
    Halves<C> interval[4];
    bool middle[4] = {false};
    int count = 1;
    while (count > 0) {
        Halves<C> at = interval[--count];
        if (middle[count]) {
            root.set_middle(f, at);
            if (meet(true)) return true;
            continue;
        }
        Bernstein<C> here = f;
        restrict_to(here, at);
        while (here.variations() > 1) {
            Bernstein<C> left = here;
            halve(left, false);
            halve(here, true);
            if (here.variations() > 0) {
                middle[count] = false;
                interval[count] = at;
                interval[count++].add(true);
            }
            if (left.b[left.degree].zero()) {
                middle[count] = true;
                interval[count++] = at;
            }
            here = left;
            at.add(false);
        }
        if (here.variations() == 0) continue;
        root.of = &f;
        root.is_fraction = false;
        root.halves = at;
        root.here = here;
        if (meet(true)) return true;
    }
    return false;
}

}  // namespace pierce::detail
