// Groups of clusters get subtrees of their own, the groups a top in two ways; the cheaper one is collapsed to wide
// nodes.
#include <tree/make_tree.h>

#include <chunks.h>
#include <tree/balanced.h>
#include <tree/emit.h>
#include <tree/encode.h>
#include <tree/groups.h>
#include <tree/ploc.h>
#include <tree/sah.h>

namespace pierce::detail {

namespace {

// Leaves of binary trees have up to so many clusters: the collapse takes them as they are.
constexpr std::uint32_t k_leaf_size = 6;
// Groups with more than so many times the area that a cluster has when the scene's is shared out are split.
constexpr double k_large_group = 100;
// So many steps wide at the lower quartile, clusters are good enough on the scene's lattice. (The stadium has less than 0.05, the
// kitchen 9, others 300.)
constexpr double k_fine_enough = 3;

// Nodes of a group with so many clusters, at most: each split leaves one with fewer by one at least, down to a leaf.
std::uint32_t node_room(std::uint32_t clusters) {
    return clusters <= k_leaf_size ? 1 : 2 * (clusters - k_leaf_size) + 1;
}

// The binary nodes: first those of all groups, then both tops.
template <class Scalar>
struct Forest {
    std::vector<std::uint32_t> groups;  // where they begin, and the end
    std::vector<std::uint32_t> roots;   // of them among the nodes
    RawArray<Binary<Scalar>> nodes;
    RawArray<CostRow> rows;
    [[nodiscard]] std::uint32_t group_count() const { return static_cast<std::uint32_t>(roots.size()); }
};

// A tree in each group, and what it costs.
template <class Scalar>
void grow_groups(Forest<Scalar>& forest, std::span<ClusterBox<Scalar>> boxes, const Executor& executor) {
    each_chunk(
        executor, forest.group_count(),
        [&](std::size_t, std::size_t begin, std::size_t end) {
            ClusterBox<Scalar> spare[k_most_in_group];
            SahSet<Scalar> stack[k_most_in_group];
            SahSplitter splitter =
                make_splitter<Scalar>(boxes.data(), spare, [](const ClusterBox<Scalar>&) { return 1U; });
            Collapse<Scalar> collapse(forest.nodes.data(), forest.rows.data(), boxes);
            // One behind the other, as most need less room than they have: pages that nobody writes cost nothing.
            std::uint32_t free = forest.roots[begin];
            for (std::size_t g = begin; g < end; ++g) {
                const std::uint32_t root = forest.roots[g] = free;
                free = make_binary<Scalar>(splitter, forest.groups[g], forest.groups[g + 1], k_leaf_size,
                                        forest.nodes.data(), root, root + 1, stack, [&](const SahSet<Scalar>& set) {
                                            Binary<Scalar>& leaf = forest.nodes[set.node];
                                            set_box(leaf, set.box);
                                            leaf.at = set.begin;
                                            leaf.count = set.size();
                                        });
                for (std::uint32_t at = free; at-- > root;) collapse.find_cost(at);
            }
        },
        256);
}

// Takes the group's tree to a leaf of a top.
template <class Scalar>
void graft(Forest<Scalar>& forest, std::uint32_t node, std::uint32_t group) {
    forest.nodes[node] = forest.nodes[forest.roots[group]];
    forest.rows[node] = forest.rows[forest.roots[group]];
}

// Both tops, each with its root at `from` and its nodes behind it; costs of all. False: there is none.
template <class Scalar>
struct SahTop {
    RawArray<Binary<Scalar>> items;
    RawArray<Binary<Scalar>> spare;
    RawArray<std::uint8_t> is_group;
    explicit SahTop(std::size_t count) : items(count), spare(count), is_group(2 * count) {}

    void make(Forest<Scalar>& forest, std::uint32_t from, std::span<const ClusterBox<Scalar>> boxes) {
        const std::uint32_t count = forest.group_count();
        for (std::uint32_t g = 0; g < count; ++g) {
            items[g] = forest.nodes[forest.roots[g]];
            items[g].at = g;
            items[g].count = forest.groups[g + 1] - forest.groups[g];
        }
        std::fill(is_group.begin(), is_group.end(), std::uint8_t{0});
        SahSet<Scalar> stack[k_sah_stack];
        SahSplitter splitter =
            make_splitter<Scalar>(items.data(), spare.data(), [](const Binary<Scalar>& item) { return item.count; });
        const std::uint32_t end = make_binary<Scalar>(splitter, 0, count, 1, forest.nodes.data(), from, from + 1, stack,
                                                      [&](const SahSet<Scalar>& set) {
                                                          graft(forest, set.node, items[set.begin].at);
                                                          is_group[set.node - from] = 1;
                                                      });
        Collapse<Scalar> collapse(forest.nodes.data(), forest.rows.data(), boxes);
        for (std::uint32_t at = end; at-- > from;)
            if (is_group[at - from] == 0) collapse.find_cost(at);
    }
};

template <class Scalar>
struct PlocTop {
    Ploc<Scalar> ploc;
    explicit PlocTop(std::size_t count) : ploc(count) {}

    bool make(Forest<Scalar>& forest, std::uint32_t from, std::span<const ClusterBox<Scalar>> boxes) {
        const std::uint32_t count = forest.group_count();
        for (std::uint32_t g = 0; g < count; ++g) {
            ploc.items()[g] = forest.nodes[forest.roots[g]];
            ploc.items()[g].at = g;
            ploc.items()[g].count = 1;
        }
        if (!ploc.join(forest.nodes.data(), from, from + 1)) return false;
        // Children were made before their parents, the root, at the front, last of all.
        Collapse<Scalar> collapse(forest.nodes.data(), forest.rows.data(), boxes);
        const auto finish = [&](std::uint32_t at) {
            if (forest.nodes[at].count > 0) return graft(forest, at, forest.nodes[at].at);
            collapse.find_cost(at);
        };
        for (std::uint32_t at = from + 1; at < from + 2 * count - 1; ++at) finish(at);
        finish(from);
        return true;
    }
};

// Whether the scene's lattice is too coarse, by some clusters that are evenly spread over all.
template <class Scalar>
bool needs_own_frames(std::span<const ClusterBox<Scalar>> boxes, const Frame& frame) {
    const std::size_t stride = boxes.size() / 2048 + 1;
    std::vector<double> extents;
    for (std::size_t i = 0; i < boxes.size(); i += stride) {
        const QuadBox<Scalar> box = box_of<Scalar>(boxes[i]);
        extents.push_back(static_cast<double>(largest_of<Scalar>(box.high - box.low)));
    }
    const auto quartile = extents.begin() + static_cast<std::ptrdiff_t>(extents.size() / 4);
    std::nth_element(extents.begin(), quartile, extents.end());
    return *quartile < k_fine_enough * frame.step;
}

template <class Scalar, class Encoder>
Tree grow(std::span<ClusterBox<Scalar>> boxes, ClusterRef empty, Scalar scene_area, const Encoder& encoder,
          const Executor& executor) {
    Forest<Scalar> forest;
    forest.groups =
        find_groups<Scalar>(boxes, static_cast<Scalar>(k_large_group / static_cast<double>(boxes.size())) * scene_area);
    const auto count = static_cast<std::uint32_t>(forest.groups.size() - 1);
    forest.roots.resize(count);
    std::uint32_t room = 0;
    for (std::uint32_t g = 0; g < count; ++g) {
        forest.roots[g] = room;
        room += node_room(forest.groups[g + 1] - forest.groups[g]);
    }
    forest.nodes = RawArray<Binary<Scalar>>(room + 4 * std::size_t{count});
    forest.rows = RawArray<CostRow>(forest.nodes.size());
    grow_groups(forest, boxes, executor);

    const std::uint32_t sah_root = room;
    const std::uint32_t ploc_root = room + 2 * count;
    bool has_ploc = false;
    {
        SahTop<Scalar> sah(count);
        PlocTop<Scalar> ploc(count);
        executor(2, [&](std::size_t which) {
            if (which == 0)
                sah.make(forest, sah_root, boxes);
            else
                has_ploc = ploc.make(forest, ploc_root, boxes);
        });
    }
    const float sah_cost = forest.rows[sah_root].cost[0];
    const std::uint32_t root = has_ploc && forest.rows[ploc_root].cost[0] < sah_cost ? ploc_root : sah_root;
    if (forest.rows[root].cost[0] <= std::numeric_limits<float>::max()) {
        const Collapse<Scalar> collapse(forest.nodes.data(), forest.rows.data(), boxes);
        Tree tree = emit_tree<Scalar>(collapse, forest.nodes.data(), root, boxes, empty, encoder);
        if (tree.depth <= k_most_depth) return tree;
    }
    return balanced_tree<Scalar>(boxes, empty, encoder);
}

}  // namespace

template <class Scalar>
Tree make_tree(std::span<ClusterBox<Scalar>> boxes, ClusterRef empty, const Frame& frame, const Executor& executor) {
    if (boxes.size() == 1) {
        Tree tree;
        tree.root = boxes[0].ref;
        return tree;
    }
    QuadBox<Scalar> scene;
    for (const ClusterBox<Scalar>& box : boxes) scene.add(box_of<Scalar>(box));
    if (needs_own_frames<Scalar>(boxes, frame)) return grow(boxes, empty, scene.area(), OwnFrames(frame), executor);
    return grow(boxes, empty, scene.area(), Lattice(frame), executor);
}

template Tree make_tree(std::span<ClusterBox<float>>, ClusterRef, const Frame&, const Executor&);
template Tree make_tree(std::span<ClusterBox<double>>, ClusterRef, const Frame&, const Executor&);

}  // namespace pierce::detail
