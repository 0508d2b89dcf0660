// The second rule, for counting.
#include <exact/crossing.h>

#include <exact/volumes.h>

namespace pierce::detail {

namespace {

// The sign of v . (e, e^2, e^3) for e -> 0+.
template <int N>
int sign_of_shift(const Vector<N>& v) {
    for (const Integer<N>& component : v)
        if (const int sign = component.sign(); sign != 0) return sign;
    return 0;
}

}  // namespace

int crossing(const Path& path, const Corners& corners) {
    return with_volumes(path, corners, []<int N>(const Volumes<N>& volumes) {
        // F(x + s) = F(x) + n . s for a shift s: a zero has the sign of n . s. It is zero again only for n = 0.
        const int tie = sign_of_shift(volumes.normal());
        if (tie == 0) return 0;
        const auto decided = [](int sign, int shifted) { return sign != 0 ? sign : shifted; };
        const int from = decided(volumes.from_side().sign(), tie);
        const int to = decided(volumes.to_side().sign(), tie);
        if (from == to) return 0;
        for (int k = 0; k < 3; ++k) {
            // The weight d . (before x after) of a corner, d = to - from, changes by d . (before x -s) + d . (-s x after), which is
            // (d x (after - before)) . s. The cross product is zero only if d is parallel to an edge, hence to the plane,
            // and then both ends are on one side.
            int weight = volumes.weight(k).sign();
            if (weight == 0) weight = sign_of_shift(cross(volumes.direction(), volumes.edge_against(k)));
            if (weight != from) return 0;
        }
        return from;
    });
}

}  // namespace pierce::detail
