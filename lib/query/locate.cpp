// Where points are.
//
// The triangles near a point come from the broadphase as those of a path without length. What a path may hit it never
// leaves out because of where it stands beside edges (all three volumes are 0, which is within any bound), only because
// the point is further from the cluster's box or the triangle's plane than the noise (slab_test.h, cluster_test.h,
// grid_walk.h): and no point of a closed triangle is.
#include <query/locate.h>

#include <algorithm>
#include <bit>

#include <exact/touch.h>
#include <kernel/filter.h>
#include <query/broadphase.h>
#include <query/engine.h>
#include <query/face_touches.h>

namespace pierce::detail {

namespace {

[[nodiscard]] bool holds(const Box& box, const Point& point) {
    for (std::size_t k = 0; k < 3; ++k)
        if (point[k] < box.low[k] || box.high[k] < point[k]) return false;
    return true;
}

/// Whether the start of what was measured is certainly not on the triangle's plane (meeting.h).
[[nodiscard]] bool starts_off_plane(const Measured& x) {
    return x.tame && magnitude_of(x.v()) > 9 * Arithmetic<double>::unit * x.bar_vc[0];
}

template <class Scalar>
void each_touch(const Scene<Scalar>& scene, const Point& point, QueryCounters& counters, FirstTouches& touches) {
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
                touches.add(touch_of(scene, triangle, decision, 0));
        }
        return 1.0;
    });
}

}  // namespace

template <class Scalar>
Location locate(const Scene<Scalar>& scene, const Vec3<Scalar>& at, std::span<FaceTouch> out, QueryCounters& counters) {
    const Point point = to_point(at);
    if (scene.empty() || !holds(scene.bounds, point)) return {};
    FirstTouches touches(out);
    each_touch(scene, point, counters, touches);
    touches.sort();
    Location location;
    location.winding_number = winding_number(scene, at, counters);
    location.face_count = touches.total();
    location.place = touches.total() > 0            ? Place::on_surface
                     : location.winding_number != 0 ? Place::inside
                                                    : Place::outside;
    return location;
}

template <class Scalar>
std::size_t locate(const Scene<Scalar>& scene, const PointsView<Scalar>& points, Location* out, QueryCounters& counters,
                   std::size_t& invalid) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        out[i] = {};
        if (!are_finite(points[i])) {
            ++invalid;
            continue;
        }
        out[i] = locate<Scalar>(scene, points[i], {}, counters);
        count += out[i].place == Place::on_surface ? 1 : 0;
    }
    return count;
}

template Location locate(const Scene<float>&, const Vec3<float>&, std::span<FaceTouch>, QueryCounters&);
template Location locate(const Scene<double>&, const Vec3<double>&, std::span<FaceTouch>, QueryCounters&);
template std::size_t locate(const Scene<float>&, const PointsView<float>&, Location*, QueryCounters&, std::size_t&);
template std::size_t locate(const Scene<double>&, const PointsView<double>&, Location*, QueryCounters&, std::size_t&);

}  // namespace pierce::detail
