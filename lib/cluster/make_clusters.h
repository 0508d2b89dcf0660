// From a mesh to clusters: its triangles in Morton order, cut into records of up to eight.
#pragma once

#include <cluster/clusters.h>
#include <pierce/executor.h>
#include <pierce/mesh_view.h>

namespace pierce::detail {

template <class Scalar>
struct ClusterBuild {
    Clusters<Scalar> clusters;
    RawArray<ClusterBox<Scalar>> boxes;  ///< of all clusters, in Morton order
    double unit = 1;                     ///< as in Frame
    std::size_t degenerate = 0;          ///< triangles of area zero: in no cluster
    double low[3] = {};                  ///< of all triangles in clusters, in the caller's units
    double high[3] = {};
    double largest = 0;                  ///< the largest |coordinate| among them
};

/// The mesh has been checked. `has_zero_area` decides where a bound in double does not. O(n), in parts for the executor; the same for any.
template <class Scalar>
[[nodiscard]] ClusterBuild<Scalar> make_clusters(const MeshView<Scalar>& mesh, bool (*has_zero_area)(const Corners&), const Executor& executor);

}  // namespace pierce::detail
