// Groups of clusters get subtrees of their own, the groups a top, some in two ways; the cheaper one is collapsed to
// wide nodes.
#include <tree/make_tree.h>

#include <chunks.h>
#include <tree/balanced.h>
#include <tree/emit.h>
#include <tree/encode.h>
#include <tree/groups.h>
#include <tree/sah.h>
#include <tree/tops.h>

namespace pierce::detail {

namespace {

// Leaves of binary trees have up to so many clusters: the collapse takes them as they are.
constexpr std::uint32_t k_leaf_size = 6;
// Groups with more than so many times the area that a cluster has when the scene's is shared out are split.
constexpr double k_large_group = 100;
// So many steps wide at the lower quartile, clusters are good enough on the scene's lattice. (The stadium has less than
// 0.05, the kitchen 9, others 300.)
constexpr double k_fine_enough = 3;
// A segment goes through the tree by its box (kernel/box_test.h) where that is shorter than these clusters are wide.
// Measured on the bunny: an any_hit of the benchmark's short and resting segments takes 18 to 22 % fewer instructions;
// medium ones, ten times as long, would come to twelve times as many clusters.
constexpr double k_short = 1;

// Nodes of a group with so many clusters, at most: each split leaves one with fewer by one at least, down to a leaf.
std::uint32_t node_room(std::uint32_t clusters) {
    return clusters <= k_leaf_size ? 1 : 2 * (clusters - k_leaf_size) + 1;
}

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
        std::max<std::size_t>(64, forest.group_count() / 32 + 1));
}

// Whether groups differ so much in size, by the mean square of areas to the square of their mean, that PLOC may find a
// better top than SAH. (The kitchen has 123, and 10 % less nodes to visit with it; twelve other meshes 1.1 to 3.8, and
// the top of SAH is the cheaper one in all of them.)
template <class Scalar>
bool are_uneven(const Forest<Scalar>& forest) {
    constexpr double k_uneven = 8;
    double sum = 0;
    double squares = 0;
    for (const std::uint32_t root : forest.roots) {
        const auto area = static_cast<double>(box_of<Scalar>(forest.nodes[root]).area());
        sum += area;
        squares += area * area;
    }
    return squares * static_cast<double>(forest.group_count()) > k_uneven * sum * sum;
}

// The lower quartile of clusters' largest extents, of some that are evenly spread over all.
template <class Scalar>
double small_extent(std::span<const ClusterBox<Scalar>> boxes) {
    const std::size_t stride = boxes.size() / 2048 + 1;
    std::vector<double> extents;
    for (std::size_t i = 0; i < boxes.size(); i += stride) {
        const QuadBox<Scalar> box = box_of<Scalar>(boxes[i]);
        extents.push_back(static_cast<double>(largest_of<Scalar>(box.high - box.low)));
    }
    const auto quartile = extents.begin() + static_cast<std::ptrdiff_t>(extents.size() / 4);
    std::nth_element(extents.begin(), quartile, extents.end());
    return *quartile;
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
    if (are_uneven(forest)) {
        SahTop<Scalar> sah(count);
        PlocTop<Scalar> ploc(count);
        executor(2, [&](std::size_t which) {
            if (which == 0)
                sah.make(forest, sah_root, boxes, {});
            else
                has_ploc = ploc.make(forest, ploc_root, boxes);
        });
    } else {
        SahTop<Scalar>(count).make(forest, sah_root, boxes, executor);
    }
    const float sah_cost = forest.rows[sah_root].cost[0];
    const std::uint32_t root = has_ploc && forest.rows[ploc_root].cost[0] < sah_cost ? ploc_root : sah_root;
    if (forest.rows[root].cost[0] <= std::numeric_limits<float>::max()) {
        const Collapse<Scalar> collapse(forest.nodes.data(), forest.rows.data(), boxes);
        const TreeWriter<Scalar, Encoder> writer(collapse, forest.nodes.data(), boxes, empty, encoder);
        Tree tree = writer.write(root, executor);
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
    std::vector<QuadBox<Scalar>> parts(chunks_of(boxes.size()));
    each_chunk(executor, boxes.size(), [&](std::size_t chunk, std::size_t begin, std::size_t end) {
        QuadBox<Scalar> sum;
        for (std::size_t i = begin; i < end; ++i) sum.add(box_of<Scalar>(boxes[i]));
        parts[chunk] = sum;
    });
    QuadBox<Scalar> scene;
    for (const QuadBox<Scalar>& part : parts) scene.add(part);
    const double extent = small_extent<Scalar>(boxes);
    // Whether the scene's lattice is too coarse.
    if (extent < k_fine_enough * frame.step) return grow(boxes, empty, scene.area(), OwnFrames(frame), executor);
    Tree tree = grow(boxes, empty, scene.area(), Lattice(frame), executor);
    tree.short_way = static_cast<float>(k_short * extent);
    return tree;
}

template Tree make_tree(std::span<ClusterBox<float>>, ClusterRef, const Frame&, const Executor&);
template Tree make_tree(std::span<ClusterBox<double>>, ClusterRef, const Frame&, const Executor&);

}  // namespace pierce::detail
