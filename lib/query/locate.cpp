// Where points are.
#include <query/locate.h>

#include <query/engine.h>
#include <query/kept.h>
#include <query/touches_at.h>

namespace pierce::detail {

template <class Scalar>
Location locate(const Scene<Scalar>& scene, const Vec3<Scalar>& at, std::span<FaceTouch> out, QueryCounters& counters) {
    const Point point = to_point(at);
    if (scene.empty() || !holds(scene.bounds, point)) return {};
    Kept touches(out, [](const FaceTouch& x, const FaceTouch& y) { return comes_before(x, y); });
    each_touch(scene, point, counters, [&](const FaceTouch& touch) { touches.add(touch); });
    return located(winding_number(scene, at, counters), touches.sort());
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
