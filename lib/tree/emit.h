// Wide nodes, written from the root down.
#pragma once

#include <algorithm>
#include <cstring>
#include <new>
#include <vector>

#include <pierce/executor.h>
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

/// Writes the tree over binary nodes: some at the top, then what is below, one after the other. On threads each of
/// these parts has a list of its own, and the lists are put one behind the other: the tree is the same.
template <class Scalar, class Encoder>
class TreeWriter {
  public:
    TreeWriter(const Collapse<Scalar>& collapse, const Binary<Scalar>* binary,
               std::span<const ClusterBox<Scalar>> clusters, ClusterRef empty, const Encoder& encoder)
        : collapse_(collapse), binary_(binary), clusters_(clusters), empty_(empty), encoder_(encoder) {}

    [[nodiscard]] Tree write(std::uint32_t root, const Executor& executor) const {
        NodeList nodes(executor ? 2 * k_below : clusters_.size() / 7 + 4);
        // Breadth first, until there is enough below.
        std::vector<Todo> below{{root, nodes.add(1), 1}};
        std::size_t first = 0;
        unsigned depth = 0;
        for (; first < below.size() && below.size() - first < k_below; ++first) {
            depth = std::max(depth, below[first].depth);
            const Todo todo = below[first];
            write_one(nodes, todo, below);
        }
        below.erase(below.begin(), below.begin() + static_cast<std::ptrdiff_t>(first));
        Tree tree;
        tree.coarse = Encoder::k_coarse;
        tree.depth = depth;
        if (!executor) {
            for (const Todo& todo : below) tree.depth = std::max(tree.depth, write_below(nodes, todo));
            tree.node_count = nodes.size();
            tree.nodes = nodes.take();
        } else {
            write_on_threads(nodes, below, tree, executor);
        }
        return tree;
    }

  private:
    static constexpr std::size_t k_below = 64;
    struct Todo {
        std::uint32_t binary;
        std::uint32_t node;
        unsigned depth;
    };

    // Makes places for the node's children that are nodes, and adds these to `todo`.
    void write_one(NodeList& nodes, const Todo& now, std::vector<Todo>& todo) const {
        std::array<typename Collapse<Scalar>::Child, k_children> children;
        // In a frame of the node's own, boxes smaller than some of its 255 steps are all but the same: a segment that
        // comes to one of them would go through all.
        const Scalar least_extent = Encoder::k_coarse ? collapse_.extent(now.binary) / 64 : 0;
        const unsigned count = collapse_.children(now.binary, least_extent, children);
        QuadBox<Scalar> boxes[k_children];
        std::uint32_t refs[k_children];
        std::size_t inner = 0;
        for (unsigned i = 0; i < count; ++i) inner += !children[i].is_cluster;
        std::uint32_t next = nodes.add(inner);
        for (unsigned i = 0; i < count; ++i) {
            const std::uint32_t at = children[i].at;
            if (children[i].is_cluster) {
                boxes[i] = box_of<Scalar>(clusters_[at]);
                refs[i] = clusters_[at].ref;
            } else {
                boxes[i] = box_of<Scalar>(binary_[at]);
                refs[i] = next;
                todo.push_back({at, next++, now.depth + 1});
            }
        }
        write_node(nodes, now.node, boxes, refs, count, empty_, encoder_);
    }
    // All from there on; how deep it is.
    unsigned write_below(NodeList& nodes, const Todo& top) const {
        std::vector<Todo> todo{top};
        unsigned depth = 0;
        while (!todo.empty()) {
            const Todo now = todo.back();
            todo.pop_back();
            depth = std::max(depth, now.depth);
            write_one(nodes, now, todo);
        }
        return depth;
    }

    void write_on_threads(NodeList& top, const std::vector<Todo>& below, Tree& tree, const Executor& executor) const {
        struct Part {
            NodeList nodes{0};  // its top, and what is below that
            std::size_t first = 0;
            unsigned depth = 0;
        };
        std::vector<Part> parts(below.size());
        executor(parts.size(), [&](std::size_t p) {
            parts[p].nodes = NodeList(clusters_.size() / (4 * k_below) + 16);
            parts[p].depth = write_below(parts[p].nodes, {below[p].binary, parts[p].nodes.add(1), below[p].depth});
        });
        tree.node_count = top.size();
        for (Part& part : parts) {
            part.first = tree.node_count;
            tree.node_count += part.nodes.size() - 1;
            tree.depth = std::max(tree.depth, part.depth);
        }
        tree.nodes = RawArray<NodeBytes>(tree.node_count);
        const std::size_t top_count = top.size();
        const RawArray<NodeBytes> top_nodes = top.take();
        std::copy_n(top_nodes.data(), top_count, tree.nodes.data());
        executor(parts.size(), [&](std::size_t p) {
            const std::size_t count = parts[p].nodes.size();
            const RawArray<NodeBytes> nodes = parts[p].nodes.take();
            for (std::size_t i = 0; i < count; ++i) {
                auto& node = *new (&tree.nodes[i == 0 ? below[p].node : parts[p].first + i - 1])
                                 typename Encoder::Kind;
                std::memcpy(&node, &nodes[i], sizeof node);
                for (std::uint32_t& child : node.child)
                    if ((child & k_leaf_bit) == 0) child += static_cast<std::uint32_t>(parts[p].first) - 1;
            }
        });
    }

    const Collapse<Scalar>& collapse_;
    const Binary<Scalar>* binary_;
    std::span<const ClusterBox<Scalar>> clusters_;
    ClusterRef empty_;
    const Encoder& encoder_;
};

}  // namespace pierce::detail
