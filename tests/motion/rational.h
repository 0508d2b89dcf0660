// Polynomials with rational coefficients and their roots: what the judge of moving points (judge.h) is made of. Roots
// are isolated by Sturm's chains; signs at them are found by common divisors.
#pragma once

#include <gmpxx.h>

#include <vector>

namespace pierce::test {

/// sum of c[i] t^i, with no zeros at the end; empty for 0.
using Polynomial = std::vector<mpq_class>;

inline void trim(Polynomial& p) {
    while (!p.empty() && p.back() == 0) p.pop_back();
}
inline Polynomial operator+(const Polynomial& x, const Polynomial& y) {
    Polynomial sum(std::max(x.size(), y.size()));
    for (std::size_t i = 0; i < x.size(); ++i) sum[i] += x[i];
    for (std::size_t i = 0; i < y.size(); ++i) sum[i] += y[i];
    trim(sum);
    return sum;
}
inline Polynomial operator-(const Polynomial& x) {
    Polynomial out = x;
    for (auto& c : out) c = -c;
    return out;
}
inline Polynomial operator-(const Polynomial& x, const Polynomial& y) { return x + -y; }
inline Polynomial operator*(const Polynomial& x, const Polynomial& y) {
    if (x.empty() || y.empty()) return {};
    Polynomial product(x.size() + y.size() - 1);
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t j = 0; j < y.size(); ++j) product[i + j] += x[i] * y[j];
    trim(product);
    return product;
}
inline mpq_class value_of(const Polynomial& p, const mpq_class& t) {
    mpq_class value = 0;
    for (std::size_t i = p.size(); i-- > 0;) value = value * t + p[i];
    return value;
}
inline int sign_of(const Polynomial& p, const mpq_class& t) { return sgn(value_of(p, t)); }
inline Polynomial slope_of(const Polynomial& p) {
    Polynomial slope;
    for (std::size_t i = 1; i < p.size(); ++i) slope.push_back(p[i] * mpq_class(static_cast<unsigned long>(i)));
    return slope;
}
/// Quotient and remainder; y is not 0.
inline std::pair<Polynomial, Polynomial> divide(Polynomial x, const Polynomial& y) {
    Polynomial quotient(x.size() >= y.size() ? x.size() - y.size() + 1 : 0);
    while (x.size() >= y.size()) {
        const std::size_t at = x.size() - y.size();
        quotient[at] = x.back() / y.back();
        for (std::size_t i = 0; i < y.size(); ++i) x[at + i] -= quotient[at] * y[i];
        trim(x);
    }
    return {quotient, x};
}
/// A positive multiple with short whole coefficients.
inline Polynomial primitive(Polynomial p) {
    mpz_class factor = 1;
    for (const auto& c : p) factor = lcm(factor, c.get_den());
    mpz_class content = 0;
    for (auto& c : p) {
        c *= factor;
        content = gcd(content, c.get_num());
    }
    if (content != 0)
        for (auto& c : p) c /= content;
    return p;
}
inline Polynomial common_divisor(Polynomial x, Polynomial y) {
    while (!y.empty()) {
        Polynomial rest = primitive(divide(x, y).second);
        x = std::move(y);
        y = std::move(rest);
    }
    return x;
}
/// Each root once.
inline Polynomial without_repetition(const Polynomial& p) {
    return primitive(p.size() < 3 ? p : divide(p, common_divisor(p, slope_of(p))).first);
}

/// Sturm's chain of a polynomial without repeated roots: how many of its roots are in (a, b].
class Sturm {
  public:
    explicit Sturm(const Polynomial& p) {
        chain_ = {p, slope_of(p)};
        while (!chain_.back().empty())
            chain_.push_back(primitive(-divide(chain_[chain_.size() - 2], chain_.back()).second));
        chain_.pop_back();
    }
    int roots(const mpq_class& a, const mpq_class& b) const { return changes(a) - changes(b); }

  private:
    int changes(const mpq_class& t) const {
        int count = 0;
        int last = 0;
        for (const Polynomial& p : chain_) {
            const int sign = sign_of(p, t);
            if (sign == 0) continue;
            if (last != 0 && sign != last) ++count;
            last = sign;
        }
        return count;
    }
    std::vector<Polynomial> chain_;
};

/// The only root of `of` in (low, high), neither of which is a root; or low, if both are equal.
struct Time {
    Polynomial of;  ///< without repetition
    mpq_class low, high;

    bool exact() const { return low == high; }
    void refine() {
        if (exact()) return;
        const mpq_class middle = (low + high) / 2;
        const int sign = sign_of(of, middle);
        if (sign == 0)
            low = high = middle;
        else if (sign == sign_of(of, high))
            high = middle;
        else
            low = middle;
    }
    int sign(const Polynomial& p) const {
        if (p.empty()) return 0;
        if (exact()) return sign_of(p, low);
        // Where p is further from 0 than its slope lets it come, no more is needed.
        Time time = *this;
        mpq_class steepest = 0;
        for (std::size_t i = 1; i < p.size(); ++i) steepest += abs(p[i]) * mpq_class(static_cast<unsigned long>(i));
        for (int i = 0; i < 30 && !time.exact(); ++i) {
            if (abs(value_of(p, time.high)) > (time.high - time.low) * steepest) return sign_of(p, time.high);
            time.refine();
        }
        if (time.exact()) return sign_of(p, time.low);
        const Polynomial both = common_divisor(of, p);
        if (both.size() > 1 && Sturm(both).roots(time.low, time.high) > 0) return 0;
        const Sturm sturm(without_repetition(p));
        while (!time.exact() && sturm.roots(time.low, time.high) > 0) time.refine();
        return sign_of(p, time.high);
    }
    /// The order of this time and a number.
    int compare(const mpq_class& t) const {
        if (exact()) return low < t ? -1 : low > t ? 1 : 0;
        if (t <= low) return 1;
        if (t >= high) return -1;
        const int sign = sign_of(of, t);
        return sign == 0 ? 0 : sign == sign_of(of, low) ? 1 : -1;
    }
    int compare(Time other) const {
        Time time = *this;
        const mpq_class low_end = std::max(low, other.low);
        const mpq_class high_end = std::min(high, other.high);
        const Polynomial both = common_divisor(of, other.of);
        if (low_end < high_end && both.size() > 1 && Sturm(both).roots(low_end, high_end) > 0) return 0;
        for (;;) {
            if (time.exact()) return -other.compare(time.low);
            if (other.exact()) return time.compare(other.low);
            if (time.high <= other.low) return -1;
            if (other.high <= time.low) return 1;
            time.refine();
            other.refine();
        }
    }
};

/// The roots in [0, 1], in their order.
inline std::vector<Time> roots_of(const Polynomial& p) {
    std::vector<Time> roots;
    if (p.size() < 2) return roots;
    const Polynomial once = without_repetition(p);
    const Sturm sturm(once);
    if (sign_of(once, 0) == 0) roots.push_back({once, 0, 0});
    // Those in (a, b].
    const auto isolate = [&](auto& self, const mpq_class& a, const mpq_class& b) -> void {
        const int count = sturm.roots(a, b);
        if (count == 0) return;
        if (count == 1 && sign_of(once, b) == 0) {
            roots.push_back({once, b, b});
            return;
        }
        if (count == 1 && sign_of(once, a) != 0) {
            roots.push_back({once, a, b});
            return;
        }
        const mpq_class middle = (a + b) / 2;
        self(self, a, middle);
        self(self, middle, b);
    };
    isolate(isolate, 0, 1);
    return roots;
}

}  // namespace pierce::test
