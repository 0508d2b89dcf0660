// From the binary tree to nodes of sixteen children: the cheapest such tree (Ylitie, Karras and Laine 2017, section 3.1).
//
// A subtree may stand in a node as a forest of up to i parts, each of them a cluster or a node of its own. The cost of the best such forest, by dynamic
// programming from the leaves up: of two children's forests with i parts in all the cheapest pair, or one node of its own that holds sixteen parts. A node
// costs its area times k_node_cost, a cluster its area times k_cluster_cost.
#pragma once

#include <tree/binary_tree.h>

namespace pierce::detail {

template <class Scalar>
class Collapse {
  public:
    static constexpr std::size_t k_parts = 16;

    explicit Collapse(const BinaryTree<Scalar>& tree) : tree_(tree), costs_(tree.size()) {}

    /// Needs the costs of both children.
    void find_cost(std::size_t at) {
        std::array<float, k_parts>& cost = costs_[at];
        const auto area = static_cast<float>(tree_[at].box.half_area());
        if (tree_[at].leaf()) {
            cost.fill(area * k_cluster_cost);
            return;
        }
        const std::array<float, k_parts>& lower = costs_[tree_.lower(at)];
        const std::array<float, k_parts>& upper = costs_[tree_.upper(at)];
        std::array<float, k_parts> best;
        best.fill(std::numeric_limits<float>::infinity());
        for (std::size_t j = 0; j + 1 < k_parts; ++j)
            for (std::size_t i = j + 1; i < k_parts; ++i) best[i] = std::min(best[i], lower[j] + upper[i - 1 - j]);
        const float own = best[k_parts - 1] + area * k_node_cost;
        for (std::size_t i = 1; i < k_parts; ++i) cost[i] = std::min(best[i], own);
        cost[0] = own;
    }

    [[nodiscard]] float cost(std::size_t at) const { return costs_[at][0]; }

    /// The binary subtrees that are the children of the node for a subtree; returns how many.
    unsigned children(std::size_t at, std::array<std::size_t, k_parts>& out) const {
        unsigned count = 0;
        if (tree_[at].leaf()) out[count++] = at;
        else open(at, k_parts, out, count);
        return count;
    }

  private:
    static constexpr float k_node_cost = 1;
    static constexpr float k_cluster_cost = 0.6F;  // measured: tests/bench/run

    void part(std::size_t at, std::size_t parts, std::array<std::size_t, k_parts>& out, unsigned& count) const {
        // NaN costs, of a tree that is not used, make a part here.
        if (tree_[at].leaf() || parts == 1 || !(costs_[at][parts - 1] < costs_[at][0])) out[count++] = at;
        else open(at, parts, out, count);
    }
    void open(std::size_t at, std::size_t parts, std::array<std::size_t, k_parts>& out, unsigned& count) const {
        const std::array<float, k_parts>& lower = costs_[tree_.lower(at)];
        const std::array<float, k_parts>& upper = costs_[tree_.upper(at)];
        std::size_t best = 0;
        for (std::size_t j = 1; j + 1 < parts; ++j)
            if (lower[j] + upper[parts - 2 - j] < lower[best] + upper[parts - 2 - best]) best = j;
        part(tree_.lower(at), best + 1, out, count);
        part(tree_.upper(at), parts - 1 - best, out, count);
    }

    const BinaryTree<Scalar>& tree_;
    RawArray<std::array<float, k_parts>> costs_;
};

}  // namespace pierce::detail
