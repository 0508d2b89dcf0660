// The wide tree over clusters, built.
#pragma once

#include <node.h>
#include <raw_array.h>

namespace pierce::detail {

struct Tree {
    RawArray<Node> nodes;  ///< CoarseNodes if `coarse`: as large, and read as what they are
    std::uint32_t root = 0;
    bool coarse = false;
    unsigned depth = 0;    ///< nodes on the longest way to a cluster
    std::size_t node_count = 0;

    [[nodiscard]] TreeView view() const { return {nodes.data(), root, coarse}; }
    [[nodiscard]] std::size_t bytes() const { return nodes.bytes(); }
};

}  // namespace pierce::detail
