// orient3d by floating-point expansions (Shewchuk 1997, sections 2.3 to 2.8), without adaptivity: a second opinion for
// the exact room, and what it is measured against. Right only while nothing overflows or underflows.
#pragma once

#include <array>
#include <cmath>

#include <point.h>

namespace pierce::test {

/// A sum of doubles that do not overlap, in order of magnitude, without zeros.
template <int Most>
struct Expansion {
    std::array<double, static_cast<std::size_t>(Most)> term;
    int count = 0;
    void push(double x) {
        if (x != 0) term[static_cast<std::size_t>(count++)] = x;
    }
    [[nodiscard]] int sign() const {
        if (count == 0) return 0;
        return term[static_cast<std::size_t>(count - 1)] > 0 ? 1 : -1;
    }
};

inline double two_sum(double a, double b, double& error) {
    const double sum = a + b;
    const double virtual_b = sum - a;
    error = (a - (sum - virtual_b)) + (b - virtual_b);
    return sum;
}

inline Expansion<2> difference(double a, double b) {
    Expansion<2> e;
    double error = 0;
    const double d = two_sum(a, -b, error);
    e.push(error);
    e.push(d);
    return e;
}

/// Adds one double (grow-expansion with zeros left out).
template <int N, int M>
Expansion<N + M> sum(const Expansion<N>& e, const Expansion<M>& f) {
    Expansion<N + M> out;
    for (int i = 0; i < e.count; ++i)
        out.term[static_cast<std::size_t>(out.count++)] = e.term[static_cast<std::size_t>(i)];
    for (int j = 0; j < f.count; ++j) {
        Expansion<N + M> next;
        double q = f.term[static_cast<std::size_t>(j)];
        for (int i = 0; i < out.count; ++i) {
            double error = 0;
            q = two_sum(q, out.term[static_cast<std::size_t>(i)], error);
            next.push(error);
        }
        next.push(q);
        out = next;
    }
    return out;
}

template <int N>
Expansion<2 * N> scaled(const Expansion<N>& e, double b) {
    Expansion<2 * N> out;
    double q = 0;
    for (int i = 0; i < e.count; ++i) {
        const double product = e.term[static_cast<std::size_t>(i)] * b;
        const double low = std::fma(e.term[static_cast<std::size_t>(i)], b, -product);
        double error = 0;
        q = two_sum(q, low, error);
        out.push(error);
        q = two_sum(product, q, error);
        out.push(error);
    }
    out.push(q);
    return out;
}

template <int N>
Expansion<4 * N> product(const Expansion<N>& e, const Expansion<2>& f) {
    Expansion<2 * N> low;
    Expansion<2 * N> high;
    if (f.count > 0) low = scaled(e, f.term[0]);
    if (f.count > 1) high = scaled(e, f.term[1]);
    return sum(low, high);
}

template <int N>
Expansion<N> negated(Expansion<N> e) {
    for (int i = 0; i < e.count; ++i) e.term[static_cast<std::size_t>(i)] = -e.term[static_cast<std::size_t>(i)];
    return e;
}

/// +1 if x is in front of the triangle, -1 if behind, 0 if on its plane.
inline int side_by_expansions(const detail::Corners& c, const detail::Point& x) {
    std::array<std::array<Expansion<2>, 3>, 3> d;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) d[i][k] = difference(c[i][k], x[k]);
    const auto minor = [&](std::size_t i, std::size_t j) {
        return sum(product(d[1][i], d[2][j]), negated(product(d[1][j], d[2][i])));
    };
    const auto total =
        sum(sum(product(minor(1, 2), d[0][0]), product(minor(2, 0), d[0][1])), product(minor(0, 1), d[0][2]));
    return -total.sign();
}

}  // namespace pierce::test
