// The frame of a scene: units in which both broadphases are built and walked, and the lattice of the tree's nodes.
#pragma once

#include <cmath>

#include <cluster/make_clusters.h>
#include <cluster/quad.h>
#include <node.h>

namespace pierce::detail {

/// Bounds in scene units of what is between `low` and `high` in the caller's, rounded as those of clusters are.
template <class Scalar, class Three>
[[nodiscard]] QuadBox<double> in_scene_units(const Three& low, const Three& high, double unit) {
    const auto scaled = [&](double x) {
        return static_cast<double>(static_cast<Scalar>(x) * static_cast<Scalar>(unit));
    };
    QuadBox<double> scene;
    for (int k = 0; k < 3; ++k) scene.low[k] = scaled(low[k]), scene.high[k] = scaled(high[k]);
    return scene;
}

/// All but `noise`, for a scene of these bounds in scene units. The lattice's step is the least power of two with which
/// all bounds are in [1, 65534] (tree/encode.h). (Of a scene that is a point, one that is far below any size.)
[[nodiscard]] inline Frame frame_around(const QuadBox<double>& scene, double unit) {
    Frame frame;
    frame.unit = unit;
    for (int k = 0; k < 3; ++k) frame.high[k] = scene.high[k];
    const double extent = largest_of<double>(scene.high - scene.low);
    for (frame.step = std::ldexp(1.0, extent > 0 ? std::ilogb(extent) - 16 : -200);; frame.step *= 2) {
        bool fits = true;
        for (int k = 0; k < 3; ++k) {
            // Far from the origin doubles are farther apart than steps.
            double low = scene.low[k] - 1.5 * frame.step;
            while (scene.low[k] - low < 1.25 * frame.step) low = std::nextafter(low, -HUGE_VAL);
            frame.low[k] = low;
            fits = fits && scene.high[k] - low <= 65533 * frame.step;
        }
        if (fits) return frame;
    }
}

/// Of what was built, which must have a cluster.
template <class Scalar>
[[nodiscard]] Frame frame_of(const ClusterBuild<Scalar>& build) {
    return frame_around(in_scene_units<Scalar>(build.low, build.high, build.unit), build.unit);
}

}  // namespace pierce::detail
