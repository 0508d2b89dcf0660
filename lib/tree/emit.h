// Wide nodes, written from the root down.
#pragma once

#include <algorithm>
#include <new>
#include <vector>

#include <tree/collapse.h>
#include <tree/tree.h>

namespace pierce::detail {

/// Nodes one behind the other, as many as come.
class NodeList {
  public:
    explicit NodeList(std::size_t room) : nodes_(room) {}

    /// The first of `count` new ones.
    std::uint32_t add(std::size_t count) {
        if (count_ + count > nodes_.size()) {
            RawArray<NodeBytes> larger(std::max(count_ + count, nodes_.size() + nodes_.size() / 2));
            std::copy_n(nodes_.data(), count_, larger.data());
            nodes_ = std::move(larger);
        }
        const auto first = static_cast<std::uint32_t>(count_);
        count_ += count;
        return first;
    }
    template <class Kind>
    [[nodiscard]] Kind& make(std::uint32_t at) {
        return *new (&nodes_[at]) Kind;  // not set to zero: the encoder writes all of it
    }
    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] RawArray<NodeBytes> take() { return std::move(nodes_); }

  private:
    RawArray<NodeBytes> nodes_;
    std::size_t count_ = 0;
};

/// `children`: references, in the order of `boxes`.
template <class Scalar, class Encoder>
void write_node(NodeList& nodes, std::uint32_t at, const QuadBox<Scalar>* boxes, const std::uint32_t* children,
                unsigned count, ClusterRef empty, const Encoder& encoder) {
    auto& node = nodes.make<typename Encoder::Kind>(at);
    encoder.encode(node, boxes, count);
    std::copy_n(children, count, node.child);
    std::fill(node.child + count, node.child + k_children, empty);
}

template <class Scalar, class Encoder>
[[nodiscard]] Tree emit_tree(const Collapse<Scalar>& collapse, const Binary<Scalar>* binary, std::uint32_t root,
                             std::span<const ClusterBox<Scalar>> clusters, ClusterRef empty, const Encoder& encoder) {
    struct Todo {
        std::uint32_t binary;
        std::uint32_t node;
        unsigned depth;
    };
    Tree tree;
    tree.coarse = Encoder::k_coarse;
    NodeList nodes(clusters.size() / 7 + 4);
    std::vector<Todo> todo{{root, nodes.add(1), 1}};
    while (!todo.empty()) {
        const Todo now = todo.back();
        todo.pop_back();
        tree.depth = std::max(tree.depth, now.depth);
        std::array<typename Collapse<Scalar>::Child, k_children> children;
        // In a frame of the node's own, boxes smaller than some of its 255 steps are all but the same: a segment that comes to
        // one of them would go through all.
        const Scalar least_extent = Encoder::k_coarse ? collapse.extent(now.binary) / 64 : 0;
        const unsigned count = collapse.children(now.binary, least_extent, children);
        QuadBox<Scalar> boxes[k_children];
        std::uint32_t refs[k_children];
        std::size_t inner = 0;
        for (unsigned i = 0; i < count; ++i) inner += !children[i].is_cluster;
        std::uint32_t next = nodes.add(inner);
        for (unsigned i = 0; i < count; ++i) {
            const std::uint32_t at = children[i].at;
            if (children[i].is_cluster) {
                boxes[i] = box_of<Scalar>(clusters[at]);
                refs[i] = clusters[at].ref;
            } else {
                boxes[i] = box_of<Scalar>(binary[at]);
                refs[i] = next;
                todo.push_back({at, next++, now.depth + 1});
            }
        }
        write_node(nodes, now.node, boxes, refs, count, empty, encoder);
    }
    tree.node_count = nodes.size();
    tree.nodes = nodes.take();
    return tree;
}

}  // namespace pierce::detail
