// Crossings and winding numbers: sums over all triangles that a path may touch. One query or many, the same code adds
// them up.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <exact/crossing.h>
#include <kernel/filter.h>
#include <query/broadphase.h>

namespace pierce::detail {

/// How a path crosses a triangle (crossing.h) of which the filter says `filtered`, strictly and for both sides. The
/// move is infinitesimal: a path that does not even touch a closed triangle does not cross it when moved either.
[[nodiscard]] inline int sign_of_crossing(const Filtered& filtered, const Path& path, const Corners& corners,
                                          QueryCounters& counters) {
    if (filtered.verdict == Verdict::miss) return 0;
    if (filtered.verdict == Verdict::hit && filtered.latest < path.end)
        return filtered.decision.side == Sides::front ? 1 : -1;
    ++counters.exact_decisions;
    return crossing(path, corners);
}

/// The crossings of those of a cluster's triangles that are in `lanes`.
template <class Scalar>
[[nodiscard]] int crossings_in(const Scene<Scalar>& scene, const Path& path, ClusterRef cluster, unsigned lanes,
                               QueryCounters& counters) {
    int sum = 0;
    for (; lanes != 0; lanes &= lanes - 1) {
        const Corners corners = scene.corners({cluster, static_cast<std::uint32_t>(std::countr_zero(lanes))});
        Measured measured;
        measure_path<Scalar>(corners, path, measured);
        sum += sign_of_crossing(filter_strictly(measured, Sides::both), path, corners, counters);
    }
    return sum;
}

template <class Scalar>
[[nodiscard]] int crossings_of(const Scene<Scalar>& scene, const Path& path, QueryCounters& counters) {
    int sum = 0;
    each_candidate(scene, path, Sides::both, 1, counters, [&](ClusterRef cluster, unsigned lanes) {
        sum += crossings_in(scene, path, cluster, lanes, counters);
        return 1.0;
    });
    return sum;
}

/// Whether the winding number is 0 because of where the point is. In the infinitesimal step's sense a point on the
/// box's upper side is outside already, since the step goes up; below, it must lie beyond.
template <class Scalar>
[[nodiscard]] bool is_clearly_outside(const Scene<Scalar>& scene, const Point& point) {
    if (scene.empty()) return true;
    for (std::size_t k = 0; k < 3; ++k)
        if (point[k] >= scene.bounds.high[k] || point[k] < scene.bounds.low[k]) return true;
    return false;
}

/// Where ways out of a box end: beyond its upper and its lower side along each axis, clearly outside. At the next
/// number below 0 they would end among denormal numbers, and take the widest arithmetic.
struct OutTargets {
    explicit OutTargets(const Box& box) {
        for (std::size_t k = 0; k < 3; ++k) {
            const double margin = std::max({(box.high[k] - box.low[k]) * 0x1p-20, std::abs(box.low[k]) * 0x1p-40,
                                            std::abs(box.high[k]) * 0x1p-40, std::numeric_limits<double>::min()});
            at[2 * k] = box.high[k] + margin;
            at[2 * k + 1] = box.low[k] - margin;
            finite = finite && std::isfinite(at[2 * k]) && std::isfinite(at[2 * k + 1]);
        }
    }
    double at[6];
    bool finite = true;
};

/// The way out of the box that is shortest along an axis, tilted by some of its length along the two others: along an
/// axis it would follow the edges that models have there, which only exact arithmetic can tell from crossings. An end
/// beyond the box along one axis has winding number 0, wherever it is along the others.
[[nodiscard]] inline Path way_out(const Point& point, const OutTargets& targets) {
    constexpr std::size_t k_none = 6;
    double shortest = std::numeric_limits<double>::infinity();
    std::size_t side = k_none;
    for (std::size_t i = 0; i < 6; ++i) {
        if (!targets.finite && !std::isfinite(targets.at[i])) continue;
        const double distance = std::abs(targets.at[i] - point[i / 2]);
        // The first one is taken whatever its length, which may overflow. Without a branch on the others: points of a
        // batch go now this way and now that.
        const bool better = (side == k_none) | (distance < shortest);
        shortest = better ? distance : shortest;
        side = better ? i : side;
    }
    Path way{point, point};
    if (side == k_none) return way;
    const std::size_t axis = side / 2;
    way.to[axis] = targets.at[side];
    const double some = std::isfinite(shortest) ? shortest : 0;
    for (std::size_t i = 0; i < 2; ++i) {
        constexpr double k_tilts[2] = {0.0131, 0.0277};
        constexpr std::size_t k_after[4] = {1, 2, 0, 1};
        double& other = way.to[k_after[axis + i]];
        const double tilted = other + k_tilts[i] * some;
        if (std::isfinite(tilted)) other = tilted;
    }
    return way;
}

}  // namespace pierce::detail
