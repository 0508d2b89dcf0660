// Which nodes of a binary tree become children of a wide one: the cheapest choice there is, by dynamic programming
// (Ylitie, Karras and Laine 2017).
#pragma once

#include <array>
#include <limits>
#include <span>

#include <cluster/clusters.h>
#include <tree/binary.h>

namespace pierce::detail {

/// What nodes cost is in `rows`; children have to be known before.
template <class Scalar>
class Collapse {
  public:
    Collapse(const Binary<Scalar>* nodes, CostRow* rows, std::span<const ClusterBox<Scalar>> clusters)
        : nodes_(nodes), rows_(rows), clusters_(clusters) {}

    void find_cost(std::uint32_t at) {
        const Binary<Scalar>& node = nodes_[at];
        const float own = k_node_cost * static_cast<float>(box_of<Scalar>(node).area());
        std::array<float, k_children>& cost = rows_[at].cost;
        if (node.count > 0) {
            float sum = 0;
            for (std::uint32_t i = 0; i < node.count; ++i)
                sum += static_cast<float>(box_of<Scalar>(clusters_[node.at + i]).area());
            for (std::uint32_t i = 0; i < k_children; ++i)
                cost[i] = k_cluster_cost * sum + (i + 1 < node.count ? own : 0);
            return;
        }
        // cost[i] is the least left[j] + right[i - 1 - j]: rows of `right` moved up by j + 1, with what is below it
        // infinite.
        std::array<float, 2 * k_children> right;
        std::fill_n(right.begin(), k_children, std::numeric_limits<float>::infinity());
        std::copy_n(rows_[node.at + 1].cost.begin(), k_children, right.begin() + k_children);
        const std::array<float, k_children>& left = rows_[node.at].cost;
        constexpr std::size_t k_lanes = 4;
        Quad<float> best[k_children / k_lanes];
        for (Quad<float>& b : best) b = all_of(std::numeric_limits<float>::infinity());
        for (std::size_t j = 0; j + 1 < k_children; ++j)
            for (std::size_t part = 0; part < k_children / k_lanes; ++part) {
                Quad<float> moved;
                std::memcpy(&moved, &right[k_children - 1 - j + k_lanes * part], sizeof moved);
                best[part] = least(best[part], moved + all_of(left[j]));
            }
        const float as_node = best[k_children / k_lanes - 1][k_lanes - 1] + own;
        for (Quad<float>& b : best) b = least(b, all_of(as_node));
        std::memcpy(cost.data(), best, sizeof cost);
    }

    [[nodiscard]] Scalar extent(std::uint32_t node) const {
        const QuadBox<Scalar> box = box_of<Scalar>(nodes_[node]);
        return largest_of<Scalar>(box.high - box.low);
    }
    struct Child {
        std::uint32_t at;  ///< a cluster's place, or a node
        bool is_cluster;
    };
    /// The children of the wide node that `root` becomes: clusters by their references, with `is_cluster`, and nodes.
    /// What is smaller than `least_extent` stays a child, whatever that costs.
    [[nodiscard]] unsigned children(std::uint32_t root, Scalar least_extent, std::array<Child, k_children>& out) const {
        struct Part {
            std::uint32_t node;
            unsigned places;
        };
        std::array<Part, k_children + 1> stack;
        unsigned depth = 0;
        unsigned count = 0;
        stack[depth++] = {root, k_children};
        bool top = true;
        while (depth > 0) {
            const Part part = stack[--depth];
            const Binary<Scalar>& node = nodes_[part.node];
            const std::array<float, k_children>& cost = rows_[part.node].cost;
            const bool open =
                node.count > 0 ? node.count <= part.places : part.places > 1 && cost[part.places - 1] < cost[0];
            if (!top && (!open || extent(part.node) < least_extent)) {
                out[count++] = {part.node, false};
            } else if (node.count > 0) {
                for (std::uint32_t i = 0; i < node.count; ++i) out[count++] = {node.at + i, true};
            } else {
                const std::array<float, k_children>& left = rows_[node.at].cost;
                const std::array<float, k_children>& right = rows_[node.at + 1].cost;
                unsigned best = 1;
                for (unsigned j = 2; j < part.places; ++j)
                    if (left[j - 1] + right[part.places - j - 1] < left[best - 1] + right[part.places - best - 1])
                        best = j;
                stack[depth++] = {node.at + 1, part.places - best};
                stack[depth++] = {node.at, best};
            }
            top = false;
        }
        return count;
    }

  private:
    const Binary<Scalar>* nodes_;
    CostRow* rows_;
    std::span<const ClusterBox<Scalar>> clusters_;
};

}  // namespace pierce::detail
