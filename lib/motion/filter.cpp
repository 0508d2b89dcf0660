// The filter for moving points and triangles, and its bounds.
//
// Seen from the point the corners move linearly, A, B and C, from A0 to A1 and so on; f = -det(A, B, C) as in
// course.h, in Bernstein form:
//   b0 = -A0 . q0,  3 b1 = -(A1 . q0 + A0 . q1),  3 b2 = -(A1 . q1 + A0 . q2),  b3 = -A1 . q2
//   q0 = B0 x C0,   q1 = B0 x C1 + B1 x C0,       q2 = B1 x C1
// and B x C is q0, q1 / 2, q2 in Bernstein form. Bounds are in parts of the bars: the same sums of products, of
// magnitudes and with all signs made +. With u = 2^-52, which serves any rounding mode, in first order: differences u,
// products of two 3u, q0 and q2 4u, q1 5u, products with another difference 6u and 7u, sums of three 8u and 9u, sums
// of two such sums 10u. One u more is enough for terms of second order and the roundings of the bars:
//   b0, b3: 9u bar      3 b1, 3 b2: 11u bar, b1, b2 12u bar / 3     q0, q2: 5u bar      q1: 6u bar
// Products that underflow: with differences below 2^200 each is off by 2^-1074 more at most, an area by 2^-1071, times
// a difference 2^-871, f by 2^-868 in all. So 2^-860 more is enough for f and for areas. Nothing overflows:
// f is below 2^608.
//
// On a part [x, y] of [0, 1] a polynomial's coefficients are its blossoms (Ramshaw 1987), from affine combinations
// (1 - t) a + t b: each is off by 3u of the larger of |a|, |b|, and there are as many in a row as the degree says. So
// of a cubic with |b_i| <= M all are within 9u M (10u with what is of second order), of a quadratic within 6u M (7u),
// and the bound of the coefficients is kept.
#include <motion/filter.h>

#include <algorithm>
#include <cmath>

#include <motion/counting.h>

namespace pierce::detail {

namespace {

constexpr double k_unit = 0x1p-52;
constexpr double k_underflow = 0x1p-860;

/// The corners seen from the point: [time][corner][axis].
struct Seen {
    double at[2][3][3];
};

struct Cubic {
    double b[4];
    double error[4];
    double worst;  ///< of a blossom
};

struct Quadratic {
    double b[3];
    double error;
};

[[nodiscard]] inline double mix(double a, double b, double t) { return (1 - t) * a + t * b; }

[[nodiscard]] inline int sign_of(double x, double error) { return x > error ? 1 : x < -error ? -1 : 0; }

void see(const MovingPoint& point, const MovingTriangle& triangle, Seen& seen) {
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t corner = 0; corner < 3; ++corner)
            for (std::size_t k = 0; k < 3; ++k) seen.at[i][corner][k] = triangle.at[i][corner][k] - point.at[i][k];
}

/// Whether all corners are on one side of the point along an axis, at both ends and so all the time. A difference has
/// the sign of the exact one.
[[nodiscard]] bool apart_along_axis(const Seen& seen) {
    for (std::size_t k = 0; k < 3; ++k) {
        bool above = true;
        bool below = true;
        for (const auto& corners : seen.at)
            for (const auto& corner : corners) {
                above = above && corner[k] > 0;
                below = below && corner[k] < 0;
            }
        if (above || below) return true;
    }
    return false;
}

/// False where a difference is too large, or NaN.
[[nodiscard]] bool make_cubic(const Seen& seen, Cubic& f) {
    double size[2][3][3];
    bool tame = true;
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t corner = 0; corner < 3; ++corner)
            for (std::size_t k = 0; k < 3; ++k) {
                size[i][corner][k] = std::fabs(seen.at[i][corner][k]);
                tame = tame && size[i][corner][k] < 0x1p200;
            }
    if (!tame) return false;

    const auto& [a0, b0, c0] = seen.at[0];
    const auto& [a1, b1, c1] = seen.at[1];
    const auto& [ma0, mb0, mc0] = size[0];
    const auto& [ma1, mb1, mc1] = size[1];
    double sum[4] = {};
    double bar[4] = {};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        const double q0 = b0[j] * c0[i] - b0[i] * c0[j];
        const double q1 = (b0[j] * c1[i] - b0[i] * c1[j]) + (b1[j] * c0[i] - b1[i] * c0[j]);
        const double q2 = b1[j] * c1[i] - b1[i] * c1[j];
        const double m0 = mb0[j] * mc0[i] + mb0[i] * mc0[j];
        const double m1 = (mb0[j] * mc1[i] + mb0[i] * mc1[j]) + (mb1[j] * mc0[i] + mb1[i] * mc0[j]);
        const double m2 = mb1[j] * mc1[i] + mb1[i] * mc1[j];
        sum[0] += a0[k] * q0;
        sum[1] += a1[k] * q0 + a0[k] * q1;
        sum[2] += a1[k] * q1 + a0[k] * q2;
        sum[3] += a1[k] * q2;
        bar[0] += ma0[k] * m0;
        bar[1] += ma1[k] * m0 + ma0[k] * m1;
        bar[2] += ma1[k] * m1 + ma0[k] * m2;
        bar[3] += ma1[k] * m2;
    }
    f.b[0] = sum[0];
    f.b[1] = sum[1] / 3;
    f.b[2] = sum[2] / 3;
    f.b[3] = sum[3];
    f.error[0] = 9 * k_unit * bar[0] + k_underflow;
    f.error[1] = 4 * k_unit * bar[1] + k_underflow;
    f.error[2] = 4 * k_unit * bar[2] + k_underflow;
    f.error[3] = 9 * k_unit * bar[3] + k_underflow;
    double most = 0;
    double error = 0;
    for (int i = 0; i < 4; ++i) {
        most = std::max(most, std::fabs(f.b[i]));
        error = std::max(error, f.error[i]);
    }
    f.worst = error + 10 * k_unit * most;
    return true;
}

/// A component of the cross product of the corners after one: its weight, in the plane.
[[nodiscard]] Quadratic make_area(const Seen& seen, std::size_t corner, std::size_t axis) {
    const std::size_t i = (axis + 1) % 3;
    const std::size_t j = (axis + 2) % 3;
    const double* const p0 = seen.at[0][(corner + 1) % 3];
    const double* const p1 = seen.at[1][(corner + 1) % 3];
    const double* const r0 = seen.at[0][(corner + 2) % 3];
    const double* const r1 = seen.at[1][(corner + 2) % 3];
    const auto bar = [i, j](const double* p, const double* r) {
        return std::fabs(p[i] * r[j]) + std::fabs(p[j] * r[i]);
    };
    const auto area = [i, j](const double* p, const double* r) { return p[i] * r[j] - p[j] * r[i]; };
    Quadratic q{{area(p0, r0), (area(p0, r1) + area(p1, r0)) / 2, area(p1, r1)}, 0};
    const double bars = std::max({5 * bar(p0, r0), 3 * (bar(p0, r1) + bar(p1, r0)), 5 * bar(p1, r1)});
    const double most = std::max({std::fabs(q.b[0]), std::fabs(q.b[1]), std::fabs(q.b[2])});
    q.error = k_unit * (bars + 7 * most) + k_underflow;
    return q;
}

/// The sign of q all over [x, y]; 0: it may have both, or be 0.
[[nodiscard]] int sign_on(const Quadratic& q, double x, double y) {
    const double left[2] = {mix(q.b[0], q.b[1], x), mix(q.b[1], q.b[2], x)};
    const double right[2] = {mix(q.b[0], q.b[1], y), mix(q.b[1], q.b[2], y)};
    const int sign = sign_of(mix(left[0], left[1], x), q.error);
    return sign == sign_of(mix(left[0], left[1], y), q.error) && sign == sign_of(mix(right[0], right[1], y), q.error)
               ? sign
               : 0;
}

/// Where the point is, whenever it is in the plane at a time in [x, y]: outside if two weights differ in sign, by any
/// component (of a triangle without area as well: then all that is in the plane and not outside has no weights).
[[nodiscard]] Certainty inside(const Seen& seen, std::size_t axis, double x, double y) {
    bool plus = false;
    bool minus = false;
    bool unknown = false;
    for (std::size_t corner = 0; corner < 3; ++corner) {
        const int sign = sign_on(make_area(seen, corner, axis), x, y);
        plus = plus || sign > 0;
        minus = minus || sign < 0;
        unknown = unknown || sign == 0;
    }
    return plus && minus ? Certainty::miss : unknown ? Certainty::doubtful : Certainty::hit;
}

/// The axis along which the triangle is seen largest at a time.
[[nodiscard]] std::size_t largest_axis(const Seen& seen, double t) {
    double p[3][3];
    for (std::size_t corner = 0; corner < 3; ++corner)
        for (std::size_t k = 0; k < 3; ++k) p[corner][k] = mix(seen.at[0][corner][k], seen.at[1][corner][k], t);
    double size[3];
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        size[k] = std::fabs((p[1][i] - p[0][i]) * (p[2][j] - p[0][j]) - (p[1][j] - p[0][j]) * (p[2][i] - p[0][i]));
    }
    return size[0] >= size[1] ? (size[0] >= size[2] ? 0 : 2) : (size[1] >= size[2] ? 1 : 2);
}

/// f on [x, y]: its four blossoms.
void restrict_to(const Cubic& f, double x, double y, double (&out)[4]) {
    double row[2][3];
    for (int i = 0; i < 3; ++i) {
        row[0][i] = mix(f.b[i], f.b[i + 1], x);
        row[1][i] = mix(f.b[i], f.b[i + 1], y);
    }
    const double xx[2] = {mix(row[0][0], row[0][1], x), mix(row[0][1], row[0][2], x)};
    const double yy[2] = {mix(row[1][0], row[1][1], y), mix(row[1][1], row[1][2], y)};
    out[0] = mix(xx[0], xx[1], x);
    out[1] = mix(xx[0], xx[1], y);
    out[2] = mix(yy[0], yy[1], x);
    out[3] = mix(yy[0], yy[1], y);
}

[[nodiscard]] double value_at(const Cubic& f, double t) {
    const double row[3] = {mix(f.b[0], f.b[1], t), mix(f.b[1], f.b[2], t), mix(f.b[2], f.b[3], t)};
    return mix(mix(row[0], row[1], t), mix(row[1], row[2], t), t);
}

/// Brings the ends of an interval, with one root in it and f of certain and different signs at its ends, near to the
/// root. Whatever the search finds, an end is moved only where the sign of f is certain.
void close_in(const Cubic& f, int before, double& x, double& y) {
    // In powers of t, by Newton's method; bisection where it would leave the interval.
    const double c1 = 3 * (f.b[1] - f.b[0]);
    const double c2 = 3 * (f.b[2] - 2 * f.b[1] + f.b[0]);
    const double c3 = f.b[3] - 3 * f.b[2] + 3 * f.b[1] - f.b[0];
    double low = x;
    double high = y;
    double t = x == 0 && y == 1 ? f.b[0] / (f.b[0] - f.b[3]) : x / 2 + y / 2;
    double slope = 0;
    for (int i = 0; i < 24; ++i) {
        const double value = f.b[0] + t * (c1 + t * (c2 + t * c3));
        slope = c1 + t * (2 * c2 + t * (3 * c3));
        if (std::fabs(value) <= f.worst) break;
        if ((value > 0) == (before > 0))
            low = t;
        else
            high = t;
        double next = t - value / slope;
        if (!(next > low && next < high)) next = low / 2 + high / 2;
        if (std::fabs(next - t) < 0x1p-53 * t) break;
        t = next;
    }
    // The value is off by `worst` at most, and so is where it is compared with 0.
    double away = 3 * f.worst / std::fabs(slope) + 0x1p-52 * t;
    for (int i = 0; i < 3; ++i, away *= 8) {
        const double left = t - away;
        const double right = t + away;
        if (left > x && sign_of(value_at(f, left), f.worst) == before) x = left;
        if (right < y && sign_of(value_at(f, right), f.worst) == -before) y = right;
        if (x >= left && y <= right) break;
    }
}

class Filter {
  public:
    Filter(const Seen& seen, const Cubic& f, ContactRule contact, Impact& impact)
        : seen_(seen), f_(f), counting_{contact}, impact_(impact) {}

    Certainty decide() {
        int signs[4];
        for (int i = 0; i < 4; ++i) signs[i] = sign_of(f_.b[i], f_.error[i]);
        const Certainty whole = part(signs, 0, 1);
        if (whole != Certainty::doubtful || signs[0] == 0 || signs[3] == 0 || one_root_) return whole;
        // Between its extremes f has one root or none.
        double at[4] = {0};
        int count = 1;
        const double d0 = f_.b[1] - f_.b[0];
        const double d1 = f_.b[2] - f_.b[1];
        const double d2 = f_.b[3] - f_.b[2];
        // d0 (1-t)^2 + 2 d1 t (1-t) + d2 t^2 is 0 where t : 1 - t is d0 : h or h : d2 for h = -d1 -+ sqrt(square).
        const double square = d1 * d1 - d0 * d2;
        if (square > 0) {
            const double h = -(d1 + std::copysign(std::sqrt(square), d1));
            const double one = d0 / (d0 + h);
            const double two = h / (h + d2);
            const double first = std::min(one, two);
            const double last = std::max(one, two);
            if (first > 0 && first < 1) at[count++] = first;
            if (last > 0 && last < 1 && last > first) at[count++] = last;
        }
        at[count] = 1;
        for (int i = 0; i < count; ++i) {
            const Certainty certainty = stretch(at[i], at[i + 1], k_most_halvings);
            if (certainty != Certainty::miss) return certainty;
        }
        return Certainty::miss;
    }

  private:
    static constexpr int k_most_halvings = 3;

    Certainty stretch(double x, double y, int halvings) {
        double b[4];
        restrict_to(f_, x, y, b);
        int signs[4];
        for (int k = 0; k < 4; ++k) signs[k] = sign_of(b[k], f_.worst);
        const Certainty certainty = part(signs, x, y);
        if (certainty != Certainty::doubtful || signs[0] == 0 || signs[3] == 0 || one_root_ || halvings == 0)
            return certainty;
        const double middle = x / 2 + y / 2;
        const Certainty left = stretch(x, middle, halvings - 1);
        return left != Certainty::miss ? left : stretch(middle, y, halvings - 1);
    }

    /// On [x, y], by the signs of the four coefficients there, of which 0 is not known.
    Certainty part(const int (&signs)[4], double x, double y) {
        one_root_ = false;
        const int before = signs[0];
        const int after = signs[3];
        if (before == 0 || after == 0) return Certainty::doubtful;
        if (before == after) return signs[1] == before && signs[2] == before ? Certainty::miss : Certainty::doubtful;
        // One change of sign, whatever the unknown ones are: one root, at which f changes its sign.
        if (signs[1] != before && signs[2] != after) return Certainty::doubtful;
        if (!counting_.on_border(before, after)) return Certainty::miss;
        one_root_ = true;
        close_in(f_, before, x, y);
        const Certainty place = inside(seen_, largest_axis(seen_, x), x, y);
        if (place != Certainty::hit) return place;
        if (!counting_.on_face(before, after)) return Certainty::miss;
        impact_ = {.hit = true, .side = counting_.side(before), .earliest = x, .latest = y};
        return Certainty::hit;
    }

    const Seen& seen_;
    const Cubic& f_;
    Counting counting_;
    Impact& impact_;
    bool one_root_ = false;  ///< the last part had one, so to halve it says no more
};

/// Whether the point is certainly outside whenever it is in the plane.
[[nodiscard]] bool always_outside(const Seen& seen) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (inside(seen, axis, 0, 1) == Certainty::miss) return true;
    return false;
}

}  // namespace

Certainty filter(const MovingPoint& point, const MovingTriangle& triangle, ContactRule contact,
                 Impact& impact) noexcept {
    Seen seen;
    see(point, triangle, seen);
    if (apart_along_axis(seen)) return Certainty::miss;
    Cubic f;
    if (!make_cubic(seen, f)) return Certainty::doubtful;
    const Certainty certainty = Filter(seen, f, contact, impact).decide();
    if (certainty == Certainty::doubtful && always_outside(seen)) return Certainty::miss;
    return certainty;
}

}  // namespace pierce::detail
