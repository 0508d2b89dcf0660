// The bounds of a tree written again from the boxes of its clusters, bottom-up, and what the tree costs by them.
#pragma once

#include <cluster/quad.h>
#include <node.h>
#include <number_set.h>
#include <pierce/executor.h>
#include <tree/shape.h>

namespace pierce::detail {

/// Boxes of nodes and clusters, in the caller's coordinates; inside out where nothing with an area is below. `clusters`
/// also has the name that each cluster goes by now, `Clusters::empty` where it is without triangles.
template <class Scalar>
struct TreeBoxes {
    RawArray<QuadBox<Scalar>> nodes;
    RawArray<ClusterBox<Scalar>> clusters;

    explicit TreeBoxes(const TreeShape& shape) : nodes(shape.nodes.size()), clusters(shape.clusters.size()) {}
    [[nodiscard]] std::size_t bytes() const { return nodes.bytes() + clusters.bytes(); }
    [[nodiscard]] QuadBox<Scalar> of(std::uint32_t child) const {
        return (child & k_leaf_bit) != 0 ? box_of<Scalar>(clusters[child & ~k_leaf_bit]) : nodes[child];
    }
};

template <class Scalar>
[[nodiscard]] bool is_empty(const QuadBox<Scalar>& box) {
    return !(box.low[0] <= box.high[0]);
}

/// The boxes of all nodes.
template <class Scalar>
void unite_boxes(const TreeShape& shape, TreeBoxes<Scalar>& boxes);
/// Those of `dirty` nodes and of all above, which become dirty as well.
template <class Scalar>
void unite_boxes(const TreeShape& shape, TreeBoxes<Scalar>& boxes, NumberSet& dirty);

/// Bounds and clusters' names of all nodes, or of those that are dirty. A tree without nodes gets its root.
template <class Scalar>
void write_bounds(const TreeShape& shape, const TreeBoxes<Scalar>& boxes, const Frame& frame, Tree& tree,
                  const Executor& executor);
template <class Scalar>
void write_bounds(const TreeShape& shape, const TreeBoxes<Scalar>& boxes, const Frame& frame, Tree& tree,
                  const NumberSet& dirty);

/// What a query may expect to go through, by areas of boxes in parts of the scene's (Ylitie, Karras and Laine 2017,
/// section 3.1): nodes, and clusters with their own weight. `unit` keeps areas within numbers. The scene must not be
/// empty; where it has no area the cost is 0.
template <class Scalar>
[[nodiscard]] double expected_cost(const TreeShape& shape, const TreeBoxes<Scalar>& boxes, double unit);

}  // namespace pierce::detail
