// How much further than a way itself a world's query looks, so that what it saw is all that may be in the way to the
// hit's point.
//
// The hit is at the fraction f of the way, at x in the world, in mesh A, whose grain is G. Points are looked for within
// N = near_margin(G) = 3 G of its image in A, in each coordinate; r is what one is off once it was taken to the world
// and rounded, below G (instances.cpp); e the most that a coordinate of an image is off (placement.h). So the point is
// within sqrt(3) (N + 2 e_A) + r of x. In mesh B the way to it has at its fraction s a point that is s times
//   |image of the point - what the image of the way is at f| <= sqrt(3) (sqrt(3) (N + 2 e_A) + r) + 3 e_B
//                                                            <= 4 N + 6 e_A + 3 e_B
// from that of the way's image at s f, in each coordinate. Slacks of instances have N and what e owes to their
// translation, the rest is noise() times the reach of the way. So 9 times the sum of the world's largest slack and that
// is enough for all A and B. In a mesh that much noise is added to the scene's own (sphere_near.h says why that is
// sound); to boxes twice as much, as lengths turn.
//
// Where slacks are large beside the way no list is kept, and the hit's point takes a walk of its own.
#pragma once

#include <query/sphere_near.h>
#include <query/traverse.h>
#include <world/collectors.h>

namespace pierce::detail {

/// 0: none is sensible.
template <class Scalar>
[[nodiscard]] double near_of(const WorldScene<Scalar>& world, const Path& path) {
    if (world.tree.root() == BoxTree::k_none) return 0;
    double start = 0;
    double end = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        start = std::max(start, std::abs(path.from[k]));
        end = std::max(end, std::abs(path.to[k]));
    }
    const double reach = path.ray ? start + end : std::max(start, end);
    const auto slack = static_cast<double>(world.tree.node(world.tree.root()).slack);
    const double near = 9 * (slack + world.noise() * reach) * (1 + 0x1p-40);
    constexpr double k_most = sizeof(Scalar) == sizeof(float) ? 0x1p-12 : 0x1p-38;
    return near <= k_most * reach ? near : 0;
}

/// As traverse(), and puts all that comes within `near` of the path on the list.
template <class Scalar, class Collector>
void traverse_near(const Scene<Scalar>& scene, const Path& path, double near, const QueryOptions& options,
                   QueryCounters& counters, Collector& collector, std::uint32_t index, WorldShortlist& list) {
    Frame frame = scene.frame;
    frame.noise = (frame.noise + near * frame.unit) * (1 + 0x1p-20);
    if (!(near > 0 && frame.noise <= k_most_noise)) {
        list.complete = false;
        return traverse<Certified>(scene, path, options, counters, collector);
    }
    each_candidate(scene, frame, path, options.sides, std::min(collector.limit(), path.most), counters,
                   [&](ClusterRef cluster, unsigned lanes) {
                       for (unsigned left = lanes; left != 0; left &= left - 1)
                           list.add(index, {cluster, static_cast<std::uint32_t>(std::countr_zero(left))});
                       return test_cluster<Certified>(scene, path, cluster, lanes, options, counters, collector);
                   });
}

}  // namespace pierce::detail
