// Nodes of the binary trees that the wide one is made from, and what they cost.
#pragma once

#include <array>
#include <cstdint>

#include <cluster/quad.h>
#include <node.h>

namespace pierce::detail {

/// `count` is 0: its children are nodes `at` and `at + 1`. Else it is a leaf with that many clusters, from `at` on.
template <class Scalar>
struct Binary {
    Scalar low[3];
    std::uint32_t at;
    Scalar high[3];
    std::uint32_t count;
};

/// What a subtree costs as at most i + 1 children of a wide node (Ylitie, Karras and Laine 2017, section 3.1): expected
/// steps of a query, times the scene's area. [0] is its cost as a node of its own.
struct alignas(16) CostRow {
    std::array<float, k_children> cost;
};

constexpr float k_node_cost = 1;
constexpr float k_cluster_cost = 0.6F;

}  // namespace pierce::detail
