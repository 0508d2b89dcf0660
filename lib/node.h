// The tree as plain memory: what tree/ writes and kernel/ reads.
#pragma once

#include <cstdint>

namespace pierce::detail {

constexpr unsigned k_children = 16;
/// No path from the root to a cluster has more nodes: the builder sees to it, stacks rely on it.
constexpr unsigned k_most_depth = 40;

/// Scene units are the caller's coordinates times `unit`, a power of two that makes the scene about 1 wide; its lattice
/// begins at `low` and has cells of `step` along all axes, a power of two as well. All bounds of a tree are whole
/// numbers on that lattice, between 0 and 65535.
struct Frame {
    double unit = 1;
    double low[3] = {};   ///< of the lattice, in scene units
    double high[3] = {};  ///< of the scene, in scene units
    double step = 1;
    double noise =
        0;  ///< in scene units: how far from the segment, in each coordinate, the way to a point of it may lead
};

/// A node's bounds on the scene's lattice: rows x low, x high, y low, ... of one number for each child. Each box holds
/// all of the child, exactly.
/// A place without a child has a low bound above its high one, and leads to `Clusters::empty`.
struct alignas(64) Node {
    std::uint16_t bounds[6][k_children];
    std::uint32_t child[k_children];
};

/// The same for a scene whose faces are too small for its lattice: bounds in a frame of the node's own,
/// child = origin + bound * step in scene units relative to `Frame::low`.
struct alignas(64) CoarseNode {
    std::uint8_t bounds[6][k_children];
    double origin[3];
    float step[3];
    std::uint32_t unused[15];
    std::uint32_t child[k_children];
};
static_assert(sizeof(Node) == 256 && sizeof(CoarseNode) == 256);

/// `root` names a node, or a cluster where there is only one. `coarse`: nodes are CoarseNodes. A
/// segment that is shorter along each axis than `short_way`, in scene units, goes through it by its box.
struct TreeView {
    const void* nodes = nullptr;
    std::uint32_t root = 0;
    bool coarse = false;
    float short_way = 0;
};

}  // namespace pierce::detail
