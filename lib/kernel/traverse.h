// One segment's way through the tree, nearest clusters first.
//
// The children of a node that are touched go on the stack as one group of keys; the nearest is taken, and the next when
// the group comes up again. Most nodes have one such child: then nothing is pushed. A group whose nearest is beyond the
// limit goes as a whole: the others are further (Ylitie, Karras and Laine 2017 keep groups of children on the stack as
// well, in octant order).
#pragma once

#include <kernel/box_test.h>
#include <kernel/cluster_test.h>
#include <kernel/slab_test.h>

namespace pierce::detail {

/// Asks memory for what a child refers to, node or cluster. Without a branch on which it is, as that would be
/// mispredicted half of the time: where compilers make a branch of it, the conditional move is written out.
template <class Wide, class Scalar>
[[gnu::always_inline]] inline void ask_memory(const void* nodes, const Scalar* records, std::uint32_t child) {
    const char* at = static_cast<const char*>(nodes) + (std::size_t{child} << 8);
    const char* record = reinterpret_cast<const char*>(records + k_row_count * first_of(child));
#if defined(__x86_64__)
    asm volatile(
        "test %1, %1\n\tcmovs %2, %0\n\tprefetcht0 (%0)\n\tprefetcht0 64(%0)\n\tprefetcht0 128(%0)\n\tprefetcht0 "
        "192(%0)"
        : "+r"(at)
        : "r"(child), "r"(record)
        : "cc");
#else
    if ((child & k_leaf_bit) != 0) at = record;
    for (int line = 0; line < 4; ++line) __builtin_prefetch(at + 64 * line);
#endif
}

/// Visits the clusters of which the segment may hit a triangle at a parameter up to `limit`, which becomes what `visit`
/// returns.
template <class Wide, class AnyNode, class Scalar>
[[gnu::always_inline]] inline void traverse_nodes(const TreeView& tree, const Scalar* records, Probe<Scalar>& probe,
                                                  float limit, Visit visit, void* self) {
    struct Group {
        Sixteen<Wide> keys;
        const AnyNode* node;
    };
    Group stack[k_most_depth];
    unsigned depth = 0;
    const Ray<Wide> ray(probe);
    const auto* nodes = static_cast<const AnyNode*>(tree.nodes);
    std::uint32_t limit_key = key_limit<Wide>(limit);
    std::uint32_t node_count = 0;
    std::uint32_t cluster_count = 0;
    std::uint32_t child = tree.root;
    for (;;) {
        bool none = false;
        while ((child & k_leaf_bit) == 0) {
            ++node_count;
            const AnyNode& node = nodes[child];
            Touched<Wide> touched;
            slab_test<Wide>(node, probe, ray, limit, touched);
            const unsigned bits = touched_bits(touched);
            if (bits == 0) {
                none = true;
                break;
            }
            if ((bits & (bits - 1)) == 0) {
                child = node.child[__builtin_ctz(bits)];
                continue;
            }
            Group& group = stack[depth++];
            group.keys = keys_of(touched);
            group.node = &node;
            const std::uint32_t key = least_key(group.keys);
            take_key(group.keys, key);
            child = node.child[key & 15];
            ask_memory<Wide>(nodes, records, node.child[least_key(group.keys) & 15]);
        }
        if (!none) {
            ++cluster_count;
            if (const unsigned lanes = test_cluster<Wide>(probe, records, child, limit); lanes != 0) {
                limit = visit(self, child, lanes);
                if (limit < 0) break;
                limit_key = key_limit<Wide>(limit);
            }
        }
        bool found = false;
        while (depth > 0) {
            Group& group = stack[depth - 1];
            const std::uint32_t key = least_key(group.keys);
            if (key > limit_key) {
                --depth;
                continue;
            }
            take_key(group.keys, key);
            child = group.node->child[key & 15];
            if (least_key(group.keys) == k_no_key) --depth;
            found = true;
            break;
        }
        if (!found) break;
    }
    probe.nodes = node_count;
    probe.clusters = cluster_count;
}

/// The same by the box around the segment, in no order: a short one comes to few clusters.
template <class Wide, class Scalar>
[[gnu::always_inline]] inline void traverse_boxes(const TreeView& tree, const Scalar* records, Probe<Scalar>& probe,
                                                  float limit, Visit visit, void* self) {
    struct Group {
        const Node* node;
        unsigned left;  // a bit for each child that is left
    };
    Group stack[k_most_depth];
    unsigned depth = 0;
    const Box<Wide> in_memory(probe);
    const auto* nodes = static_cast<const Node*>(tree.nodes);
    std::uint32_t node_count = 0;
    std::uint32_t cluster_count = 0;
    std::uint32_t child = tree.root;
    for (;;) {
        bool none = false;
        while ((child & k_leaf_bit) == 0) {
            ++node_count;
            const Node& node = nodes[child];
            // Where it is read from: in registers it would take those that the test of clusters needs.
            const Box<Wide>* box = &in_memory;
            asm("" : "+r"(box));
            const unsigned bits = box_test<Wide>(node, *box);
            if (bits == 0) {
                none = true;
                break;
            }
            const unsigned left = bits & (bits - 1);
            child = node.child[__builtin_ctz(bits)];
            if (left == 0) continue;
            stack[depth++] = {&node, left};
            ask_memory<Wide>(nodes, records, node.child[__builtin_ctz(left)]);
        }
        if (!none) {
            ++cluster_count;
            if (const unsigned lanes = test_cluster<Wide>(probe, records, child, limit); lanes != 0) {
                limit = visit(self, child, lanes);
                if (limit < 0) break;
            }
        }
        if (depth == 0) break;
        Group& group = stack[depth - 1];
        child = group.node->child[__builtin_ctz(group.left)];
        group.left &= group.left - 1;
        depth -= group.left == 0 ? 1 : 0;
    }
    probe.nodes = node_count;
    probe.clusters = cluster_count;
}

template <class Wide, class Scalar>
void traverse(const TreeView& tree, const Scalar* records, Probe<Scalar>& probe, float limit, Visit visit, void* self) {
    if (probe.by_box)
        traverse_boxes<Wide>(tree, records, probe, limit, visit, self);
    else if (tree.coarse)
        traverse_nodes<Wide, CoarseNode>(tree, records, probe, limit, visit, self);
    else
        traverse_nodes<Wide, Node>(tree, records, probe, limit, visit, self);
}

}  // namespace pierce::detail
