// The filter's answer in double-double, for what it leaves in doubt: ends within some units in the last place of a
// plane, as every particle that rests on a tilted floor has them, and lines within as little of an edge. What is
// exactly on a plane or an edge stays doubtful.
//
// Volumes and bounds are those of meeting.h with the unit of double-doubles. Each volume is rounded to double once,
// which keeps its sign and is off by 2^-53 of itself: so it is compared with bounds that are that much larger.
#pragma once

#include <kernel/evaluate.h>
#include <kernel/filter.h>

namespace pierce::detail {

/// Never wrong when it says hit or miss, for the reasons that the filter is not.
[[nodiscard]] [[gnu::noinline]] inline Filtered finer_filter(const Measured& bars, Sides sides) {
    Filtered filtered{Verdict::doubtful};
    if (!bars.tame) return filtered;
    using Number = BasicDoubleDouble<Pair, Dekker>;
    using S = Arithmetic<Arithmetic<Number>::Single>;
    Meeting<Number> x;
    meet(bars.lines, x);
    const auto s = lane(x.sb, 0);
    const auto b = lane(x.sb, 1);
    const auto v = lane(x.vc, 0);
    const auto c = -lane(x.vc, 1);
    const Pair sb = {S::rounded(s), S::rounded(b)};
    const Pair vc = {S::rounded(v), S::rounded(c)};
    const FilterVolumes<TwoPairs> volumes{{sb, vc}, {Pair{S::rounded(s - b - c), S::rounded(v - s)}, Pair{}}};
    filter_volumes(volumes, errors_of<TwoPairs>(bars, Arithmetic<Number>::unit * (1 + 0x1p-50)), sides, filtered);
    return filtered;
}

}  // namespace pierce::detail
