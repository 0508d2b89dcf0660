// From a tree to its shape.
#include <tree/shape.h>

#include <algorithm>
#include <cstring>

namespace pierce::detail {

namespace {

template <class Kind>
void read_nodes(const Tree& tree, ClusterRef empty, TreeShape& shape) {
    const auto cluster_at = [&](ClusterRef ref) {
        const auto* const at =
            std::lower_bound(shape.clusters.begin(), shape.clusters.end(), first_of(ref),
                             [](const ClusterHome& home, std::uint32_t place) { return first_of(home.ref) < place; });
        return static_cast<std::uint32_t>(at - shape.clusters.begin());
    };
    shape.nodes[0].parent = k_no_parent;
    for (std::uint32_t n = 0; n < tree.node_count; ++n) {
        Kind node;
        std::memcpy(&node, &tree.nodes[n], sizeof node);
        NodeShape& out = shape.nodes[n];
        out.count = 0;
        for (const std::uint32_t child : node.child) {
            if (child == empty) continue;
            std::uint32_t& to = out.child[out.count++];
            if ((child & k_leaf_bit) != 0) {
                const std::uint32_t cluster = cluster_at(child);
                shape.clusters[cluster].parent = n;
                to = k_leaf_bit | cluster;
            } else {
                shape.nodes[child].parent = n;
                to = child;
            }
        }
    }
}

}  // namespace

TreeShape shape_of(const Tree& tree, std::span<const ClusterRef> refs, ClusterRef empty) {
    TreeShape shape;
    shape.clusters = RawArray<ClusterHome>(refs.size());
    for (std::size_t i = 0; i < refs.size(); ++i) shape.clusters[i] = {refs[i], k_no_parent};
    if (tree.node_count == 0) return shape;
    shape.nodes = RawArray<NodeShape>(tree.node_count);
    if (tree.coarse)
        read_nodes<CoarseNode>(tree, empty, shape);
    else
        read_nodes<Node>(tree, empty, shape);
    return shape;
}

}  // namespace pierce::detail
