// Many segments' ways through the tree at once, each a step at a time, so that one's memory comes while others are
// looked at.
//
// Queries in flight are kept in lists by their next step: a node, a cluster, or the next of the stack. All of a list
// take their step in turn, without branches on what they find; what the step after that reads is asked of memory at
// once.
#pragma once

#include <kernel/flight.h>
#include <kernel/traverse.h>

namespace pierce::detail {

/// `Triangles`: what clusters are tested with.
template <class Wide, class Triangles, class AnyNode, class Scalar>
class FlightRun {
  public:
    FlightRun(const TreeView& tree, const Scalar* records, const Flight<Scalar>& flight)
        : nodes_(static_cast<const AnyNode*>(tree.nodes)), records_(records), root_(tree.root), flight_(flight) {}

    [[gnu::always_inline]] void run() {
        for (unsigned i = 0; i < k_flights; ++i) free_[i] = static_cast<unsigned char>(i);
        free_count_ = k_flights;
        for (;;) {
            start_queries();
            if (at_node_count_[k_slabs] + at_node_count_[k_boxes] + at_cluster_count_ == 0) return;
            enter_nodes<k_slabs>();
            if constexpr (k_lattice) enter_nodes<k_boxes>();
            // Few clusters wait for more, as long as there are queries that may come to some.
            const unsigned at_node_count = at_node_count_[k_slabs] + at_node_count_[k_boxes];
            if (at_cluster_count_ >= k_flights / 2 || at_node_count <= k_flights / 4) test_clusters();
            pop_stacks<k_slabs>();
            if constexpr (k_lattice) pop_stacks<k_boxes>();
        }
    }

  private:
    // How a query goes through nodes: lists of their own, so that no branch depends on which it is.
    static constexpr unsigned k_slabs = 0;
    static constexpr unsigned k_boxes = 1;  // only on the scene's lattice
    static constexpr bool k_lattice = sizeof(AnyNode::bounds) == sizeof(Node::bounds);

    // What a query of the second kind keeps in place of keys.
    struct ByBox {
        Box<Triangles> box;
        unsigned left[k_flight_depth];  // a bit for each child that is left
    };
    struct Query {
        Probe<Scalar> probe;
        union {
            Sixteen<Wide> keys[k_flight_depth];
            ByBox by_box;
        };
        std::uint32_t node[k_flight_depth];
        std::uint32_t child;
        std::uint32_t limit_key;
        unsigned depth;
        unsigned lanes;
        unsigned kind;
        float limit;

        Query() {}  // no member has a value yet
    };
    using List = unsigned char[k_flights + 1];  // one more: what is not kept is written as well

    [[gnu::always_inline]] void go_to(unsigned slot, unsigned kind, std::uint32_t child) {
        const unsigned leaf = child >> 31;
        at_node_[kind][at_node_count_[kind]] = static_cast<unsigned char>(slot);
        at_node_count_[kind] += 1 - leaf;
        at_cluster_[at_cluster_count_] = static_cast<unsigned char>(slot);
        at_cluster_count_ += leaf;
    }

    [[gnu::always_inline]] void start_queries() {
        while (free_count_ > 0 && more_) {
            const unsigned slot = free_[free_count_ - 1];
            Query& query = queries_[slot];
            more_ = flight_.next(flight_.self, slot, query.probe, query.limit);
            if (!more_) return;
            --free_count_;
            query.limit_key = key_limit<Wide>(query.limit);
            query.kind = k_lattice && query.probe.by_box ? k_boxes : k_slabs;
            if (query.kind == k_boxes) query.by_box.box = Box<Triangles>(query.probe);
            query.depth = 0;
            query.child = root_;
            go_to(slot, query.kind, root_);
        }
    }

    template <unsigned kind>
    [[gnu::always_inline]] void enter_nodes() {
        // Numbers of their own: those of the class would be written and read again at each store of a vector.
        const AnyNode* const nodes = nodes_;
        const Scalar* const records = records_;
        List& slots = at_node_[kind];
        const unsigned count = at_node_count_[kind];
        unsigned at_node = 0;
        unsigned at_cluster = at_cluster_count_;
        unsigned to_pop = to_pop_count_[kind];
        for (unsigned j = 0; j < count; ++j) {
            const unsigned char slot = slots[j];
            Query* at = queries_ + slot;
            asm("" : "+r"(at));  // or each of its numbers is addressed by all of its own
            Query& query = *at;
            const AnyNode& node = nodes[query.child];
            ++query.probe.nodes;
            const unsigned depth = query.depth;
            std::uint32_t child;
            unsigned none;
            if constexpr (kind == k_boxes) {
                const unsigned bits = box_test<Triangles>(node, query.by_box.box);
                const unsigned left = bits & (bits - 1);
                child = node.child[__builtin_ctz(bits | 1U << 15)];
                ask_memory<Wide>(nodes, records, child);
                query.by_box.left[depth] = left;
                // By their sign bits: compilers make branches of comparisons here.
                query.depth = depth + ((0 - left) >> 31);
                none = (bits - 1) >> 31;
            } else {
                const Ray<Wide> ray(query.probe);
                Touched<Wide> touched;
                slab_test<Wide>(node, query.probe, ray, query.limit, touched);
                Sixteen<Wide> left = keys_of(touched);
                const std::uint32_t key = least_key(left);
                child = node.child[key & 15];
                ask_memory<Wide>(nodes, records, child);
                take_key(left, key);
                query.keys[depth] = left;
                query.depth = depth + any_key(left);
                none = key == k_no_key ? 1U : 0U;
            }
            query.node[depth] = query.child;
            query.child = child;
            const unsigned leaf = child >> 31;
            slots[at_node] = slot;
            at_node += (none ^ 1U) & (leaf ^ 1U);
            at_cluster_[at_cluster] = slot;
            at_cluster += (none ^ 1U) & leaf;
            to_pop_[kind][to_pop] = slot;
            to_pop += none;
        }
        at_node_count_[kind] = at_node;
        at_cluster_count_ = at_cluster;
        to_pop_count_[kind] = to_pop;
    }

    [[gnu::always_inline]] void test_clusters() {
        List found;
        unsigned found_count = 0;
        for (unsigned j = 0; j < at_cluster_count_; ++j) {
            const unsigned slot = at_cluster_[j];
            Query* at = queries_ + slot;
            asm("" : "+r"(at));
            Query& query = *at;
            ++query.probe.clusters;
            query.lanes = test_cluster<Triangles>(query.probe, records_, query.child, query.limit);
            found[found_count] = static_cast<unsigned char>(slot);
            found_count += query.lanes != 0 ? 1 : 0;
            to_pop_[query.kind][to_pop_count_[query.kind]++] = static_cast<unsigned char>(slot);
        }
        at_cluster_count_ = 0;
        for (unsigned j = 0; j < found_count; ++j) {
            Query& query = queries_[found[j]];
            query.limit = flight_.visit(flight_.self, found[j], query.child, query.lanes);
            if (query.limit < 0)
                query.depth = 0;
            else
                query.limit_key = key_limit<Wide>(query.limit);
        }
    }

    template <unsigned kind>
    [[gnu::always_inline]] void pop_stacks() {
        for (unsigned j = 0; j < to_pop_count_[kind]; ++j) {
            const unsigned slot = to_pop_[kind][j];
            Query* at = queries_ + slot;
            asm("" : "+r"(at));
            Query& query = *at;
            unsigned depth = query.depth;
            for (;;) {
                if (depth == 0) {
                    flight_.finish(flight_.self, slot);
                    free_[free_count_++] = static_cast<unsigned char>(slot);
                    break;
                }
                if constexpr (kind == k_boxes) {
                    unsigned& left = query.by_box.left[depth - 1];
                    query.child = nodes_[query.node[depth - 1]].child[__builtin_ctz(left)];
                    left &= left - 1;
                    query.depth = depth - ((left - 1) >> 31);
                    ask_memory<Wide>(nodes_, records_, query.child);
                    go_to(slot, kind, query.child);
                    break;
                }
                Sixteen<Wide>& keys = query.keys[depth - 1];
                const std::uint32_t key = least_key(keys);
                if (key > query.limit_key) {
                    --depth;
                    continue;
                }
                query.child = nodes_[query.node[depth - 1]].child[key & 15];
                ask_memory<Wide>(nodes_, records_, query.child);
                Sixteen<Wide> left = keys;
                take_key(left, key);
                keys = left;
                query.depth = depth - (any_key(left) ^ 1U);
                go_to(slot, kind, query.child);
                break;
            }
        }
        to_pop_count_[kind] = 0;
    }

    const AnyNode* nodes_;
    const Scalar* records_;
    std::uint32_t root_;
    const Flight<Scalar>& flight_;
    bool more_ = true;
    unsigned free_count_ = 0;
    unsigned at_node_count_[2] = {};
    unsigned at_cluster_count_ = 0;
    unsigned to_pop_count_[2] = {};
    List free_;
    List at_node_[2];
    List at_cluster_;
    List to_pop_[2];
    Query queries_[k_flights];
};

template <class Wide, class Triangles, class Scalar>
void fly(const TreeView& tree, const Scalar* records, const Flight<Scalar>& flight) {
    if (tree.coarse)
        FlightRun<Wide, Triangles, CoarseNode, Scalar>(tree, records, flight).run();
    else
        FlightRun<Wide, Triangles, Node, Scalar>(tree, records, flight).run();
}

}  // namespace pierce::detail
