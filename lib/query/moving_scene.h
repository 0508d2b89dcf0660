// A mesh over one step, from the old to the new positions of its vertices: records of both, and a tree whose boxes hold
// all that a triangle comes through. (Each corner goes straight, so the triangle stays in the hull of its two ends.)
//
// Other than in a Scene, triangles without area stay in their clusters: one that has none at either end may have some
// in between.
#pragma once

#include <memory>

#include <plain_mesh.h>
#include <query/scene.h>
#include <tree/refit.h>

namespace pierce::detail {

/// The order of the triangles: what all steps share until it is made anew.
template <class Scalar>
struct MovingLayout {
    TreeShape shape;
    std::vector<std::uint32_t> numbers;  ///< of the triangle at each place
    Tree tree;                           ///< its nodes' children are those of each step's tree
    ClusterRef empty = k_leaf_bit;
    double cost = 0;  ///< expected, for the positions that it was made for
};

/// All triangles at one end of a step.
template <class Scalar>
struct MovingRecords {
    std::shared_ptr<const MovingLayout<Scalar>> layout;
    Clusters<Scalar> clusters;
    RawArray<ClusterBox<Scalar>> boxes;  ///< of the layout's clusters, in the caller's coordinates

    [[nodiscard]] std::size_t bytes() const { return clusters.records.bytes() + boxes.bytes(); }
};

/// A step: what queries read.
template <class Scalar>
struct MovingScene {
    std::shared_ptr<const MovingLayout<Scalar>> layout;
    std::shared_ptr<const MovingRecords<Scalar>> ends[2];
    Tree tree;
    Frame frame;
    TreeBoxes<Scalar> boxes{TreeShape{}};
    /// All clusters are looked at: where the scene is too small for a lattice.
    bool without_tree = false;
    /// Of the scenes before and after: names of triangles, kernels, and the larger grain.
    const Scene<Scalar>* scene = nullptr;
    double grain = 0;

    [[nodiscard]] bool empty() const { return layout->shape.clusters.empty(); }
    [[nodiscard]] const Scalar* record(std::size_t end, ClusterRef cluster) const {
        return ends[end]->clusters.record(cluster);
    }
    [[nodiscard]] std::size_t bytes() const { return tree.bytes() + boxes.bytes(); }
};

/// Throws what a build throws.
template <class Scalar>
[[nodiscard]] std::shared_ptr<const MovingLayout<Scalar>> make_layout(const PlainMesh<Scalar>& mesh,
                                                                      const Executor& executor);

/// Writes records for a layout; `records` may have been of another one.
template <class Scalar>
void write_records(const std::shared_ptr<const MovingLayout<Scalar>>& layout, const PlainMesh<Scalar>& mesh,
                   MovingRecords<Scalar>& records, const Executor& executor);

/// What a query would cost with these records alone, in parts of what it did when the layout was made.
template <class Scalar>
[[nodiscard]] double layout_cost(const MovingRecords<Scalar>& records, TreeBoxes<Scalar>& boxes);

/// Makes the step from one end to another of the same layout; `scene` has its ends and nothing else, or what is left of
/// another step.
template <class Scalar>
void set_step(MovingScene<Scalar>& scene, const Executor& executor);

}  // namespace pierce::detail
