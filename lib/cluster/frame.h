// The frame of a scene: units in which both broadphases are built and walked, and the lattice of the tree's nodes.
#pragma once

#include <cmath>

#include <cluster/make_clusters.h>
#include <cluster/quad.h>
#include <node.h>

namespace pierce::detail {

/// All but `noise`, of what was built, which must have a cluster. The bounds in scene units are the boxes' own, rounded
/// as these are. The lattice's step is the least power of two with which all bounds are in [1, 65534] (tree/encode.h).
template <class Scalar>
[[nodiscard]] Frame frame_of(const ClusterBuild<Scalar>& build) {
    Frame frame;
    frame.unit = build.unit;
    QuadBox<double> scene;
    for (int k = 0; k < 3; ++k) {
        const auto scaled = [&](double x) {
            return static_cast<double>(static_cast<Scalar>(x) * static_cast<Scalar>(build.unit));
        };
        scene.low[k] = scaled(build.low[k]);
        scene.high[k] = frame.high[k] = scaled(build.high[k]);
    }
    const double extent = largest_of<double>(scene.high - scene.low);
    for (frame.step = std::ldexp(1.0, std::ilogb(extent) - 16);; frame.step *= 2) {
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

}  // namespace pierce::detail
