// The triangles that a thick path may come near: those that the broadphase gives for a path with much noise.
//
// Noise is how far off the path, in each coordinate, a way may lead that hits a triangle (set_probe.h); boxes are
// widened by it, and the test of a cluster allows for it: a way that hits a triangle at X has a point of the path
// within the noise of X. A sphere that touches a triangle at X has its center, a point of the path, within the radius
// of X, and that is all that either proof asks for. So with the radius in the noise nothing is left out that the sphere
// touches, and no kernel needs to know of spheres. The parameter up to which it is asked is that of the center, as it
// is there.
//
// What is different is that the noise may be larger than the scene. The bounds of slab_test.h allow for the rounding of
// numbers up to some scenes; that of a parameter near or far of a slab is 2^-24 of the noise as well, twice, and a
// sum's: 2^-20 of it are added. The cluster test's bounds are sums of positive terms with as much to spare
// (set_probe.h). Infinite ones refuse nothing. From 2^98 scenes on all triangles are given.
#pragma once

#include <bit>

#include <query/broadphase.h>

namespace pierce::detail {

constexpr double k_most_noise = 0x1p98;

/// Calls `use(triangle)`, which returns the fraction from which on triangles are of no use, for each triangle that
/// comes within `radius` of the path up to there, and some more; each once.
template <class Scalar, class Use>
void each_near(const Scene<Scalar>& scene, const Path& path, double radius, double limit, QueryCounters& counters,
               Use&& use) {
    Frame frame = scene.frame;
    frame.noise = (frame.noise + radius * frame.unit) * (1 + 0x1p-20);
    if (!(frame.noise <= k_most_noise)) {
        scene.each_triangle([&](TriangleRef triangle) { use(triangle); });
        return;
    }
    each_candidate(scene, frame, path, Sides::both, limit, counters, [&](ClusterRef cluster, unsigned lanes) {
        double left = limit;
        for (; lanes != 0; lanes &= lanes - 1)
            left = use(TriangleRef{cluster, static_cast<std::uint32_t>(std::countr_zero(lanes))});
        return left;
    });
}

}  // namespace pierce::detail
