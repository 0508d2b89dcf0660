// A tree of sixteen equal parts at every node, whatever the boxes are: never deeper than the number of clusters asks
// for.
#pragma once

#include <tree/emit.h>

namespace pierce::detail {

/// Over the clusters in their order. At most 7 deep: there are fewer than 2^28.
template <class Scalar, class Encoder>
[[nodiscard]] Tree balanced_tree(std::span<const ClusterBox<Scalar>> clusters, ClusterRef empty,
                                 const Encoder& encoder) {
    struct Todo {
        std::size_t begin;
        std::size_t end;
        std::uint32_t node;
        unsigned depth;
    };
    Tree tree;
    tree.coarse = Encoder::k_coarse;
    NodeList nodes(clusters.size() / 15 + 64);
    std::vector<Todo> todo{{0, clusters.size(), nodes.add(1), 1}};
    while (!todo.empty()) {
        const Todo now = todo.back();
        todo.pop_back();
        tree.depth = std::max(tree.depth, now.depth);
        std::size_t part = 1;  // clusters of a child
        while (part * k_children < now.end - now.begin) part *= k_children;
        QuadBox<Scalar> boxes[k_children];
        std::uint32_t refs[k_children];
        unsigned count = 0;
        for (std::size_t begin = now.begin; begin < now.end; begin += part, ++count) {
            const std::size_t end = std::min(now.end, begin + part);
            for (std::size_t i = begin; i < end; ++i) boxes[count].add(box_of<Scalar>(clusters[i]));
            refs[count] = clusters[begin].ref;
            if (end - begin == 1) continue;
            refs[count] = nodes.add(1);
            todo.push_back({begin, end, refs[count], now.depth + 1});
        }
        write_node(nodes, now.node, boxes, refs, count, empty, encoder);
    }
    tree.node_count = nodes.size();
    tree.nodes = nodes.take();
    return tree;
}

}  // namespace pierce::detail
