// A build from new positions that keeps the clusters of the one before, as long as these are about as good: a frame's
// shape is nearly that of the frame before, and it is the order of all triangles that most of a build's time goes to.
//
// The records are written again where they are, clusters are put in Morton order by the centres of their new boxes, and
// the broadphase is built over them from nothing: so the tree is as good as that of a build, but for clusters that have
// become larger than new ones would be. That is measured before anything is written.
#pragma once

#include <span>

#include <query/scene.h>

namespace pierce::detail {

/// What a rebuild knows of clusters that earlier ones kept.
struct KeptClusters {
    double spread = 0;   ///< of the clusters when they were made; 0: not known
    unsigned times = 0;  ///< that they were kept since
};

/// Whether no build from these positions can throw `MeshError`, by their sizes; what is not finite is not either.
template <class Scalar>
[[nodiscard]] bool always_builds(std::span<const Vec3<Scalar>> positions);

/// False: the scene has to be built anew. Its clusters must be as a build left them, or this function; where it is
/// false they may be of no use any more. `positions`: `always_builds` is true of them; `executor` is in standard
/// arithmetic. Of `options` only the grid's are looked at. Throws only std::bad_alloc.
template <class Scalar>
[[nodiscard]] bool rebuild_on_clusters(Scene<Scalar>& scene, std::span<const Vec3<Scalar>> positions,
                                       const BuildOptions& options, KeptClusters& kept, const Executor& executor);

}  // namespace pierce::detail
