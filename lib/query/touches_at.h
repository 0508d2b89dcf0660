// The triangles of a scene that a point lies on.
//
// The triangles near a point come from the broadphase as those of a path without length. What a path may hit it never
// leaves out because of where it stands beside edges (all three volumes are 0, which is within any bound), only because
// the point is further from the cluster's box or the triangle's plane than the noise (slab_test.h, cluster_test.h,
// grid_walk.h): and no point of a closed triangle is.
#pragma once

#include <algorithm>
#include <bit>

#include <exact/touch.h>
#include <kernel/filter.h>
#include <query/broadphase.h>
#include <query/face_touches.h>

namespace pierce::detail {

[[nodiscard]] inline bool holds(const Box& box, const Point& point) {
    for (std::size_t k = 0; k < 3; ++k)
        if (point[k] < box.low[k] || box.high[k] < point[k]) return false;
    return true;
}

/// Whether the start of what was measured is certainly not on the triangle's plane (meeting.h).
[[nodiscard]] inline bool starts_off_plane(const Measured& x) {
    return x.tame && magnitude_of(x.v()) > 9 * Arithmetic<double>::unit * x.bar_vc[0];
}

/// Calls `use(touch)` for each triangle that the point lies on.
template <class Scalar, class Use>
void each_touch(const Scene<Scalar>& scene, const Point& point, QueryCounters& counters, Use&& use) {
    const Path path{point, point};
    each_candidate(scene, path, Sides::both, 1, counters, [&](ClusterRef cluster, unsigned lanes) {
        for (; lanes != 0; lanes &= lanes - 1) {
            const TriangleRef triangle{cluster, static_cast<std::uint32_t>(std::countr_zero(lanes))};
            const Corners corners = scene.corners(triangle);
            if (!holds(box_of(corners), point)) continue;
            Measured measured;
            measure_path<Scalar>(corners, path, measured);
            if (starts_off_plane(measured)) continue;
            ++counters.exact_decisions;
            if (const Decision decision = touch(point, corners); decision.hit)
                use(touch_of(scene, triangle, decision, 0));
        }
        return 1.0;
    });
}

[[nodiscard]] inline Location located(int winding_number, std::size_t face_count) {
    const Place place = face_count > 0 ? Place::on_surface : winding_number != 0 ? Place::inside : Place::outside;
    return {place, winding_number, face_count};
}

}  // namespace pierce::detail
