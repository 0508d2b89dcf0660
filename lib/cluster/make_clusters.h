// From a mesh to clusters of triangles: the first half of the build.
#pragma once

#include <cstdint>
#include <vector>

#include <cluster/clusters.h>
#include <cluster/quad.h>
#include <pierce/executor.h>
#include <plain_mesh.h>

namespace pierce::detail {

/// `unit`: the power of two with which the largest extent of what is listed is in [0.5, 1) (for the least numbers as
/// close to that as powers of two go). `boxes`: one of each cluster, in Morton order, in scene units. Triangles of area
/// zero are in `degenerate`, in the caller's order, and in no cluster; the rest has its bounds in `low` and `high` and
/// its largest |coordinate| in `largest`, in the caller's coordinates (0 if there is none).
template <class Scalar>
struct ClusterBuild {
    Clusters<Scalar> clusters;
    RawArray<ClusterBox<Scalar>> boxes;
    double unit = 1;
    std::vector<std::uint32_t> degenerate;
    double low[3] = {};
    double high[3] = {};
    double largest = 0;
};

/// Positions have to be finite where a triangle has them; there must be fewer triangles than `k_most_triangles` (the
/// record behind the last needs a place as well). `has_zero_area` decides exactly where floating point cannot. Throws
/// only std::bad_alloc.
template <class Scalar>
[[nodiscard]] ClusterBuild<Scalar> make_clusters(const PlainMesh<Scalar>& mesh, bool (*has_zero_area)(const Corners&),
                                                 const Executor& executor);

/// `ClusterBuild::unit` for a scene of this box. Throws `MeshError` where the box is too small for its distance from
/// the origin.
template <class Scalar>
[[nodiscard]] Scalar scene_unit(const QuadBox<Scalar>& box);

}  // namespace pierce::detail
