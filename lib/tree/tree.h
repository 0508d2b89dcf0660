// A tree over clusters as it is kept, and as kernels see it.
#pragma once

#include <cstddef>

#include <node.h>
#include <raw_array.h>

namespace pierce::detail {

/// What both kinds of nodes are in memory.
struct alignas(64) NodeBytes {
    unsigned char bytes[sizeof(Node)];
};

struct Tree {
    RawArray<NodeBytes> nodes;  ///< the first `node_count` are Nodes, or CoarseNodes if `coarse`
    std::size_t node_count = 0;
    std::uint32_t root = 0;
    bool coarse = false;
    unsigned depth = 0;   ///< nodes on the longest path from the root
    float short_way = 0;  ///< as in TreeView

    [[nodiscard]] TreeView view() const { return {nodes.data(), root, coarse, short_way}; }
    /// What lies behind the last node was never written, and takes no memory but its share of a page.
    [[nodiscard]] std::size_t bytes() const { return node_count * sizeof(NodeBytes); }
};

}  // namespace pierce::detail
