// The second rule, for counting.
#include <exact/crossing.h>

#include <exact/fraction.h>
#include <exact/volumes.h>

namespace pierce::detail {

int crossing(const Path& path, const Corners& corners) {
    return with_volumes(path, corners, [&](const auto& volumes) {
        // F(x + s) = F(x) + n . s for a shift s: a zero has the sign of n . s. It is zero again only for n = 0.
        const int tie = volumes.normal_shift();
        if (tie == 0) return 0;
        const auto decided = [](int sign, int shifted) { return sign != 0 ? sign : shifted; };
        const int from = decided(volumes.from_side().sign(), tie);
        const int to = decided(volumes.to_side().sign(), tie);
        if (from == to) return 0;
        // An end of a ray that is nearer: before the plane, beyond it, or on it.
        if (path.end < std::numeric_limits<double>::infinity()) {
            const int order = compare_fraction(path, corners, path.end);
            if (order > 0 || (order == 0 && tie == from)) return 0;
        }
        for (int k = 0; k < 3; ++k) {
            // The weight d . (before x after) of a corner, d = to - from, changes by
            // d . (before x -s) + d . (-s x after), which is (d x (after - before)) . s. The cross product is zero only
            // if d is parallel to an edge, hence to the plane, and then both ends are on one side.
            int weight = volumes.weight(k).sign();
            if (weight == 0) weight = volumes.edge_shift(k);
            if (weight != from) return 0;
        }
        return from;
    });
}

}  // namespace pierce::detail
