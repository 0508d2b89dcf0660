// Clips to a box somewhat larger than the scene's: in double-double, so that far ends cost no precision.
//
// In scene units, relative to Frame::low, the scene is in [0, 2]. The start is from * unit - low exactly (underflow:
// 2^-1074, less than the noise), and so is a segment's end; the way is e R, with R a power of two and e of a size
// between 1 and 2 that is within 2^-106 of itself; a ray's end is off by 2^-102 of what it is the sum of. From the end
// that is nearer to the scene on, points are q + r e. The slab test takes q rounded to double, so its bounds are
// widened by more than that loses; where q is far it says no more than that r is to begin at `in`, and the same is
// asked from q + in e on. A step takes 48 bits or more off the distance: three are enough for 2^100 scenes. `in` and
// `out` are within 2^-50 of themselves, which moves a point by less than 2^-47 of the last step; nothing that is within
// an eighth of the scene less the noise is lost. What is lost in the place of points: four operations a step, 2^-100 of
// the distance of the nearer end each (double_double.h), and 2^-51 of the origin, which is near, where it is rounded.
// That is added to the noise. Nearer ends that are 2^76 scenes away make boxes be told apart less and less well, and
// from 2^100 on everything is visited.
#include <kernel/clip.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <kernel/double_double.h>

namespace pierce::detail {

namespace {

using Fine = DoubleDouble;
using FinePoint = std::array<Fine, 3>;

constexpr double k_beyond_all = 0x1p100;
constexpr double k_near = 8;
constexpr double k_infinite = std::numeric_limits<double>::infinity();

double reach_of(const FinePoint& x) {
    double reach = 0;
    for (const Fine& y : x) {
        if (std::isnan(y.high)) return k_infinite;
        reach = std::max(reach, std::abs(y.high));
    }
    return reach;
}

/// Comes near to everything at its start.
void take_all(const Frame& frame, Clipped& clipped) {
    clipped.begin = 0;
    clipped.length = 1;
    clipped.noise = 0x1p100;
    for (int k = 0; k < 3; ++k) {
        clipped.origin[k] = 0;
        clipped.direction[k] = 1;
        clipped.start[k] = frame.low[k] / frame.unit;
        clipped.way[k] = 1 / frame.unit;
    }
}

/// The way of a path in scene units: e 2^exponent.
struct Way {
    FinePoint e;
    int exponent;
};

// Where it has no length e is 0.
void set_way(const Frame& frame, const double* from, const double* to, bool ray, Way& way) {
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        // Halves: the difference of two doubles may be infinite.
        way.e[k] = two_sum(to[k] * 0.5, ray ? 0.0 : -from[k] * 0.5);
        longest = std::max(longest, std::abs(way.e[k].high));
    }
    if (longest == 0) return;
    const int size = std::ilogb(longest);
    for (Fine& x : way.e) x = {std::ldexp(x.high, -size), std::ldexp(x.low, -size)};
    way.exponent = size + 1 + std::ilogb(frame.unit);
}

/// Where q + r e is in the scene's box, widened: from r = in to out. False: nowhere.
bool cut(const Frame& frame, const FinePoint& q, const FinePoint& e, double wide, double& in, double& out) {
    in = 0;
    out = k_infinite;
    for (std::size_t k = 0; k < 3; ++k) {
        const double low = -wide;
        const double high = frame.high[k] - frame.low[k] + wide;
        const double x = q[k].high;
        if (e[k].high == 0) {
            if (x < low || x > high) return false;
            continue;
        }
        const double a = (low - x) / e[k].high;
        const double b = (high - x) / e[k].high;
        in = std::max(in, std::min(a, b));
        out = std::min(out, std::max(a, b));
    }
    in *= 1 - 0x1p-48;
    out *= 1 + 0x1p-48;
    // Some component of e is 1 or more: what is not there by then never is.
    return in <= out && in <= 0x1p110;
}

FinePoint moved(const FinePoint& q, double r, const FinePoint& e) {
    FinePoint there{};
    for (std::size_t k = 0; k < 3; ++k) {
        const Fine sum = q[k] + Fine{r, 0} * e[k];
        there[k] = two_sum(sum.high, sum.low);
    }
    return there;
}

}  // namespace

bool clip(const Frame& frame, const double* from, const double* to, bool ray, Clipped& clipped) {
    Way way{};
    set_way(frame, from, to, ray, way);
    const double length = std::ldexp(1.0, std::min(way.exponent, 1100));  // may be infinite
    std::array<FinePoint, 2> ends{};
    for (std::size_t k = 0; k < 3; ++k) {
        ends[0][k] = two_sum(from[k] * frame.unit, -frame.low[k]);
        ends[1][k] = two_sum(to[k] * frame.unit, -frame.low[k]);
    }
    if (ray) ends[1] = moved(ends[0], std::min(length, 0x1p900), way.e);
    const double reach[2] = {reach_of(ends[0]), reach_of(ends[1])};
    const std::size_t base = reach[0] <= reach[1] ? 0 : 1;
    const double lost = 0x1p-97 * (reach[base] + (ray ? reach[0] : 0));
    if (!(reach[base] <= k_beyond_all) || !(lost <= 1)) {
        take_all(frame, clipped);
        return true;
    }
    if (base == 1)
        for (Fine& x : way.e) x = -x;

    FinePoint q = ends[base];
    double gone = 0;
    double in = 0;
    double out = 0;
    double far = reach[base];
    for (int step = 0;; ++step) {
        const double wide = 0.125 + frame.noise + lost + 0x1p-46 * (far + k_near);
        if (!cut(frame, q, way.e, wide, in, out)) return false;
        if ((gone + in) * (1 - 0x1p-45) > length) return false;
        if (far <= k_near || in == 0 || step == 3) break;
        q = moved(q, in, way.e);
        gone += in;
        far = reach_of(q);
    }
    // Where the nearer end is far away, the other one is not in the box.
    if (gone == 0) out = std::min(out, length);
    const auto fraction = [&](double r) { return std::ldexp(r, -way.exponent); };
    const double at = base == 0 ? in : out;
    const double sign = base == 0 ? 1 : -1;
    clipped.begin = base == 0 ? fraction(gone + in) : 1 - fraction(gone + out);
    clipped.length = fraction(out - in);
    clipped.noise = frame.noise + lost + 0x1p-48 * (far + k_near);
    const FinePoint origin = moved(q, at, way.e);
    for (std::size_t k = 0; k < 3; ++k) {
        clipped.origin[k] = origin[k].high;
        clipped.direction[k] = sign * (out - in) * way.e[k].high;
        const Fine start = origin[k] + Fine{frame.low[k], 0};
        clipped.start[k] = (start.high + start.low) / frame.unit;
        clipped.way[k] = clipped.direction[k] / frame.unit;
    }
    return true;
}

}  // namespace pierce::detail
