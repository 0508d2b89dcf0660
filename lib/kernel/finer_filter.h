// The filter's answer in double-double, for what it leaves in doubt: ends within some units in the last place of a
// plane, as every particle that rests on a floor has them, and lines within as little of an edge. What is exactly on a
// plane or an edge stays doubtful.
//
// The meeting of path and plane (plane.h): v = n . (a - from) is above 0 behind the plane, v - s = n . (a - to) as
// well; weights w / s. Errors: e_v, e_s, e_a are derived there; v - s is off by e_v + e_s and, for its own rounding, by
// u (|v| + |s|), v and s being at most 3 O 2M^2 and 3 D 2M^2 and e_v and e_s 48 times u O M^2 and u D M^2: an eighth of
// these. A quarter is added.
#pragma once

#include <kernel/filter.h>
#include <kernel/plane.h>

namespace pierce::detail {

/// Never wrong when it says hit or miss, for the reasons that the filter is not.
[[nodiscard]] inline Filtered finer_filter(const Corners& corners, const Path& path, Sides sides) {
    using A = Arithmetic<DoubleDouble>;
    const Plane<DoubleDouble> plane(corners);
    const Meeting<DoubleDouble> x(plane, path);
    if (!x.tame) return {Verdict::doubtful};
    const double v = A::rounded(x.v);
    const double end = A::rounded(x.v - x.s);
    const double end_error = 1.25 * (x.ev + x.es);
    // (Each sign below is that of a DoubleDouble rounded once, which keeps it; the bounds have room for that rounding's
    // 2^-53 of themselves.)
    if ((v > x.ev && end > end_error) || (v < -x.ev && end < -end_error)) return {Verdict::miss};
    const bool front = v < -x.ev && end > end_error;
    const bool back = v > x.ev && end < -end_error;
    if (!front && !back) return {Verdict::doubtful};
    if (sides == (front ? Sides::back : Sides::front)) return {Verdict::miss};
    const double sign = front ? -1 : 1;
    const double least = std::min({sign * A::rounded(x.w.x), sign * A::rounded(x.w.y), sign * A::rounded(x.w.z)});
    if (least < -x.ea) return {Verdict::miss};
    if (!(least > x.ea)) return {Verdict::doubtful};
    const double start = std::abs(v);
    const double s = std::abs(A::rounded(x.s));
    const double earliest = (start - x.ev) / (s + x.es) * (1 - 0x1p-49);
    const double latest = s > x.es ? (start + x.ev) / (s - x.es) * (1 + 0x1p-49) : 1;
    return {Verdict::hit, front ? Sides::front : Sides::back, earliest, latest};
}

}  // namespace pierce::detail
