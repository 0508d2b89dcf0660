// Bloom's inequalities on volumes of a way whose ends are sums high + low, in double, with bounds.
//
// u = 2^-53, rounding to nearest; first order in u where it is not said. |low| <= u |high|.
//   - A corner seen from an end, r = (c - high) - low: where c and high are within a factor of two of each other, the
//     first difference is exact (Sterbenz 1974), and r is off by u |r|. Elsewhere |c - high| >= |high| / 2, so that
//     |low| <= 2 u |c - high|, and r is off by u |c - high| + u |r|. So r is within 2.1 u |r|.
//   - An edge of the triangle within u of itself.
//   - The way, d + l with d = to.high - from.high and l = to.low - from.low: off by u |d| + u |l| + u |d + l|, at most
//     2.1 u W with W = |d| + |l|.
// Each volume is a sum of six products of three such numbers, with `bar` the same sum of magnitudes. A side, normal .
// corner: an entry of the normal within 4 u of its bar (two factors, product, difference), the product with r 3.1 u
// more, two sums 2 u: 9.1 u. A weight, way . (corner x corner): a minor within 6.2 u of its bar, the product with the
// way 3.1 u, two sums 2 u: 11.3 u. `bar` itself is short by 8 u of itself at most. 16 u are taken for all.
//
// Underflow: an entry of a minor is off by 2^-1074 more for each of its two products, times the largest number L that
// it is multiplied with, and each of three products by 2^-1074: below 2^-1000 (1 + L). Overflow makes `bar` infinite or
// the volume NaN: neither is told.
#include <rigid/glide.h>

#include <algorithm>
#include <cmath>

namespace pierce::detail {

namespace {

constexpr int k_unknown = 2;

struct Bounded {
    double value;
    double bound;

    [[nodiscard]] int sign() const { return value > bound ? 1 : value < -bound ? -1 : k_unknown; }
};

Point minus(const Point& x, const Point& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
Point sizes(const Point& x) { return {std::abs(x[0]), std::abs(x[1]), std::abs(x[2])}; }
double largest(const Point& x) { return std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])}); }
double dot(const Point& x, const Point& y) { return (x[0] * y[0] + x[1] * y[1]) + x[2] * y[2]; }
Point cross(const Point& x, const Point& y) {
    return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}
Point cross_of_sizes(const Point& x, const Point& y) {
    return {std::abs(x[1] * y[2]) + std::abs(x[2] * y[1]), std::abs(x[2] * y[0]) + std::abs(x[0] * y[2]),
            std::abs(x[0] * y[1]) + std::abs(x[1] * y[0])};
}

/// x . (y x z), where `size` has the magnitudes of x.
Bounded volume(const Point& x, const Point& size, const Point& y, const Point& z) {
    return {dot(x, cross(y, z)), 0x1p-49 * dot(size, cross_of_sizes(y, z)) + 0x1p-1000 * (1 + largest(size))};
}

Point seen_from(const SplitPoint& end, const Point& x) { return minus(minus(x, end.high), end.low); }

/// F / (F + T) between bounds of both, with F + T certainly more than 0.
void set_interval(const Bounded& from, const Bounded& to, Filtered& filtered) {
    const double f = std::abs(from.value);
    const double t = std::abs(to.value);
    // Each sum, difference and quotient within 2^-53, and from.bound may be as large as f. A quotient below the normal
    // numbers is off by 2^-1075, and so is each product with it.
    constexpr double k_underflow = 0x1p-1072;
    const double low =
        std::max(f - from.bound, 0.0) / ((f + t) + (from.bound + to.bound)) * (1 - 0x1p-50) - k_underflow;
    const double least = (f + t) - (from.bound + to.bound);
    filtered.earliest = low > 0 ? low : 0;
    // The difference loses four bits at most.
    filtered.latest =
        least > (f + t) * 0x1p-4 ? std::min((f + from.bound) / least * (1 + 0x1p-46) + k_underflow, 1.0) : 1.0;
}

}  // namespace

Filtered filter(const Glide& glide, const Corners& corners, Sides sides) {
    Filtered filtered{Verdict::doubtful};
    const Point one = minus(corners[1], corners[0]);
    const Point other = minus(corners[2], corners[0]);
    const std::array<Point, 3> seen{seen_from(glide.from, corners[0]), seen_from(glide.from, corners[1]),
                                    seen_from(glide.from, corners[2])};
    const Point end = seen_from(glide.to, corners[0]);
    // In front the corner is seen against the normal.
    Bounded from = volume(seen[0], sizes(seen[0]), one, other);
    Bounded to = volume(end, sizes(end), one, other);
    from.value = -from.value;
    to.value = -to.value;
    const int start_sign = from.sign();
    const int end_sign = to.sign();
    // Ends that are on one side, or on the wrong one. What is not told may be 0.
    const bool front = sides != Sides::back && start_sign != -1 && end_sign != 1;
    const bool back = sides != Sides::front && start_sign != 1 && end_sign != -1;
    if (!front && !back) {
        filtered.verdict = Verdict::miss;
        return filtered;
    }
    const Point high = minus(glide.to.high, glide.from.high);
    const Point low = minus(glide.to.low, glide.from.low);
    Point way{};
    Point size{};
    for (std::size_t k = 0; k < 3; ++k) {
        way[k] = high[k] + low[k];
        size[k] = std::abs(high[k]) + std::abs(low[k]);
    }
    bool inside = start_sign != k_unknown && end_sign != k_unknown;
    bool may_be_front = front;
    bool may_be_back = back;
    for (std::size_t k = 0; k < 3; ++k) {
        const int sign = volume(way, size, seen[(k + 2) % 3], seen[(k + 1) % 3]).sign();
        may_be_front = may_be_front && sign != -1;
        may_be_back = may_be_back && sign != 1;
        inside = inside && sign != k_unknown;
    }
    if (!may_be_front && !may_be_back) {
        filtered.verdict = Verdict::miss;
        return filtered;
    }
    set_interval(from, to, filtered);
    if (!inside) return filtered;
    filtered.verdict = Verdict::hit;
    filtered.decision = Decision{.hit = true, .side = front ? Sides::front : Sides::back};
    return filtered;
}

}  // namespace pierce::detail
