// On which side of a line a point of the plane lies, decided exactly: what cutting a polygon stands on.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace pierce::detail {

using Point2 = std::array<double, 2>;

/// The sign of the determinant by exact arithmetic: the six products of (a-c) x (b-c) = axb + bxc + cxa, each an exact
/// pair of a rounded product and its error, summed without rounding (Shewchuk 1997, "Adaptive Precision Floating-Point
/// Arithmetic and Fast Robust Geometric Predicates", section 2.4, GROW-EXPANSION).
inline int orient2d_exact(const Point2& a, const Point2& b, const Point2& c) {
    std::array<double, 12> sum{};
    std::size_t terms = 0;
    const auto add = [&](double value) {
        for (std::size_t i = 0; i < terms; ++i) {  // two-sum, Knuth
            const double total = value + sum[i];
            const double shadow = total - value;
            sum[i] = (value - (total - shadow)) + (sum[i] - shadow);
            value = total;
        }
        sum[terms++] = value;
    };
    const auto add_product = [&](double x, double y) {
        const double product = x * y;
        add(std::fma(x, y, -product));
        add(product);
    };
    add_product(a[0], b[1]);
    add_product(-a[1], b[0]);
    add_product(b[0], c[1]);
    add_product(-b[1], c[0]);
    add_product(c[0], a[1]);
    add_product(-c[1], a[0]);
    for (std::size_t i = terms; i-- > 0;) {  // the largest term that is not zero outweighs all below it
        if (sum[i] != 0) {
            return sum[i] > 0 ? 1 : -1;
        }
    }
    return 0;
}

/// 1 if a, b, c turn left, -1 if they turn right, 0 if they lie on one line. Exact where no product of two coordinates
/// leaves the range of double; the caller keeps the largest between 2^-100 and 2^100, so that only coordinates 2^380
/// times smaller than that could be mistaken for 0.
inline int orient2d(const Point2& a, const Point2& b, const Point2& c) {
    const double left = (a[0] - c[0]) * (b[1] - c[1]);
    const double right = (a[1] - c[1]) * (b[0] - c[0]);
    // Shewchuk 1997, section 4.2: (3 + 16 e) e with e = 2^-53, here rounded up; the last term covers underflow.
    const double bound = 3.3307e-16 * (std::abs(left) + std::abs(right)) + 1e-300;
    const double determinant = left - right;
    return determinant > bound ? 1 : determinant < -bound ? -1 : orient2d_exact(a, b, c);
}

}  // namespace pierce::detail
