// A mesh made ready: what all queries read, and nothing that they write.
#pragma once

#include <algorithm>
#include <vector>

#include <cluster/clusters.h>
#include <cluster/quad.h>
#include <grid/uniform_grid.h>
#include <kernel/backends.h>
#include <pierce/mesh_view.h>
#include <pierce/options.h>
#include <tree/tree.h>

namespace pierce::detail {

/// A triangle where it lies in the records.
struct TriangleRef {
    ClusterRef cluster;
    std::uint32_t lane;

    friend bool operator==(const TriangleRef&, const TriangleRef&) = default;
};

struct Box {
    Point low;
    Point high;
};

[[nodiscard]] inline bool overlap(const Box& x, const Box& y) {
    for (std::size_t k = 0; k < 3; ++k)
        if (x.high[k] < y.low[k] || y.high[k] < x.low[k]) return false;
    return true;
}

template <class Scalar>
struct Scene {
    Clusters<Scalar> clusters;
    RawArray<ClusterRef> cluster_refs;         ///< all of them
    Broadphase broadphase = Broadphase::tree;  ///< which of the two there is
    Tree tree;
    UniformGrid grid;
    Frame frame;
    Box bounds;                        ///< of all triangles but those of area zero
    RawArray<IndexTriple> triangles;   ///< the caller's
    std::vector<std::uint32_t> faces;  ///< as in MeshView; empty when a triangle's number is the face as well
    /// Triangles of area zero are in no cluster.
    struct Degenerate {
        std::uint32_t number;
        Corners corners;
    };
    std::vector<Degenerate> degenerate;
    const Backend* backend = nullptr;
    /// How far from the segment, in each coordinate, a hit's point may be looked for. Frame::noise is the same in scene
    /// units.
    double near_bound = 0;
    /// How far from a face's plane a point keeps (place.h).
    double grain = 0;
    std::size_t face_count = 0;
    std::size_t vertex_count = 0;

    [[nodiscard]] bool empty() const { return cluster_refs.empty(); }
    [[nodiscard]] Corners corners(TriangleRef triangle) const {
        return clusters.corners(triangle.cluster, triangle.lane);
    }
    [[nodiscard]] Row<Scalar> row(TriangleRef triangle) const {
        return {clusters.record(triangle.cluster) + triangle.lane, count_of(triangle.cluster)};
    }
    [[nodiscard]] const NarrowKernels<Scalar>& narrow() const { return backend->narrow->template of<Scalar>(); }
    /// The caller's number.
    [[nodiscard]] std::uint32_t number_of(TriangleRef triangle) const {
        return clusters.triangle(triangle.cluster, triangle.lane);
    }
    [[nodiscard]] std::uint32_t face_of_number(std::uint32_t number) const {
        return faces.empty() ? number : faces[number];
    }
    [[nodiscard]] std::uint32_t face_of(TriangleRef triangle) const { return face_of_number(number_of(triangle)); }
    [[nodiscard]] std::size_t bytes() const;

    /// Calls `visit(triangle)` for all triangles but those of area zero.
    template <class Visit>
    void each_triangle(Visit&& visit) const {
        for (const ClusterRef cluster : cluster_refs)
            for (std::uint32_t lane = 0; lane < count_of(cluster); ++lane) visit(TriangleRef{cluster, lane});
    }
};

[[nodiscard]] inline Box box_of(const Corners& corners) {
    Box box{};
    for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] = std::min({corners[0][k], corners[1][k], corners[2][k]});
        box.high[k] = std::max({corners[0][k], corners[1][k], corners[2][k]});
    }
    return box;
}

[[nodiscard]] inline Box box_of(const Path& path) {
    Box box{};
    for (std::size_t k = 0; k < 3; ++k) {
        // (A ray's end is not a number as a rule, and is not asked for.)
        box.low[k] = std::min(path.from[k], path.to[k]);
        box.high[k] = std::max(path.from[k], path.to[k]);
    }
    return box;
}

/// Checks mesh and options (throws `MeshError` or std::invalid_argument), copies the mesh, and builds the broadphase.
/// Not inlined: see engine.h.
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] Scene<Scalar> make_scene(const MeshView<Scalar>& mesh, const BuildOptions& options);

/// Builds the same triangles again, at other positions, which are finite. Of `options` only the grid's are looked at,
/// and `executor` is in standard arithmetic. The scene is as it was where this throws `MeshError`; with std::bad_alloc
/// it may be of no use any more.
template <class Scalar>
[[gnu::noinline]] void rebuild_scene(Scene<Scalar>& scene, std::span<const Vec3<Scalar>> positions,
                                     const BuildOptions& options, const Executor& executor);

/// What a scene that is not empty keeps of its bounds: `box` in the caller's coordinates, `frame` without its noise.
template <class Scalar>
void set_bounds(Scene<Scalar>& scene, const QuadBox<Scalar>& box, const Frame& frame);

/// The grid of boxes in scene units.
template <class Scalar>
[[nodiscard]] UniformGrid make_grid(std::span<const ClusterBox<Scalar>> boxes, const Frame& frame,
                                    const BuildOptions& options, const Executor& executor);

}  // namespace pierce::detail
