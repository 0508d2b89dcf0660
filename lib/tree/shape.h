// What a tree is beside its bounds: who is whose child, by numbers that stay when clusters lose triangles. What a refit
// goes by.
#pragma once

#include <cstdint>
#include <span>

#include <cluster/clusters.h>
#include <tree/tree.h>

namespace pierce::detail {

constexpr std::uint32_t k_no_parent = 0xffffffffU;

/// A child is the number of a node, which is larger than that of its parent, or `k_leaf_bit` and the number of a
/// cluster in `TreeShape::clusters`.
struct NodeShape {
    std::uint32_t child[k_children];
    std::uint32_t parent;
    std::uint32_t count;  ///< of children, which are in the first places
};

/// A cluster as it was built: its place in the records, where it has room for so many triangles.
struct ClusterHome {
    ClusterRef ref;
    std::uint32_t parent;
};

struct TreeShape {
    RawArray<NodeShape> nodes;       ///< none where the root is a cluster, or where there is no tree
    RawArray<ClusterHome> clusters;  ///< in the order of their places

    [[nodiscard]] std::size_t bytes() const { return nodes.bytes() + clusters.bytes(); }
};

/// `refs`: all clusters, in the order of their places. A tree without nodes will do: then no cluster has a parent.
[[nodiscard]] TreeShape shape_of(const Tree& tree, std::span<const ClusterRef> refs, ClusterRef empty);

}  // namespace pierce::detail
