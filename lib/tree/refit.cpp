// Bottom-up: a node has a smaller number than its children, so the last node comes first.
#include <tree/refit.h>

#include <chunks.h>
#include <tree/binary.h>
#include <tree/encode.h>

namespace pierce::detail {

namespace {

template <class Scalar>
void unite(const TreeShape& shape, TreeBoxes<Scalar>& boxes, std::uint32_t node) {
    const NodeShape& at = shape.nodes[node];
    QuadBox<Scalar> all;
    for (std::uint32_t i = 0; i < at.count; ++i) all.add(boxes.of(at.child[i]));
    boxes.nodes[node] = all;
}

/// Writes one node after the other: who is whose child is in the shape, so no order is needed.
template <class Scalar, class Encoder>
class BoundsWriter {
    using Kind = typename Encoder::Kind;

  public:
    BoundsWriter(const TreeShape& shape, const TreeBoxes<Scalar>& boxes, const Frame& frame)
        : shape_(shape), boxes_(boxes), unit_(static_cast<Scalar>(frame.unit)), encoder_(frame) {}

    /// A place whose child has no triangle left is closed, like one without a child (node.h). A closed node stays a
    /// child: whoever comes there finds closed places only.
    void write(std::uint32_t at, NodeBytes& bytes) const {
        Kind& node = *reinterpret_cast<Kind*>(&bytes);
        const NodeShape& shape = shape_.nodes[at];
        QuadBox<Scalar> boxes[k_children];
        unsigned closed = 0;
        unsigned open = shape.count;  // one that is
        for (unsigned i = 0; i < shape.count; ++i) {
            const std::uint32_t child = shape.child[i];
            const QuadBox<Scalar> box = boxes_.of(child);
            boxes[i] = {box.low * unit_, box.high * unit_};
            if ((child & k_leaf_bit) != 0) node.child[i] = boxes_.clusters[child & ~k_leaf_bit].ref;
            if (is_empty(box))
                closed |= 1U << i;
            else
                open = i;
        }
        if (open == shape.count) {
            close_places(node.bounds, 0);
            return;
        }
        if (closed != 0) [[unlikely]]
            for (unsigned i = 0; i < shape.count; ++i)
                if ((closed >> i & 1) != 0) boxes[i] = boxes[open];
        encoder_.encode(node, boxes, shape.count);
        if (closed != 0) [[unlikely]]
            for (unsigned i = 0; i < shape.count; ++i)
                if ((closed >> i & 1) != 0) close_place(node.bounds, i);
    }

  private:
    const TreeShape& shape_;
    const TreeBoxes<Scalar>& boxes_;
    Scalar unit_;
    Encoder encoder_;
};

template <class Scalar, class Each>
void write_each(const TreeShape& shape, const TreeBoxes<Scalar>& boxes, const Frame& frame, Tree& tree, Each&& each) {
    if (shape.nodes.empty()) {
        tree.root = boxes.clusters[0].ref;
    } else if (tree.coarse) {
        const BoundsWriter<Scalar, OwnFrames> writer(shape, boxes, frame);
        each([&](std::uint32_t node) { writer.write(node, tree.nodes[node]); });
    } else {
        const BoundsWriter<Scalar, Lattice> writer(shape, boxes, frame);
        each([&](std::uint32_t node) { writer.write(node, tree.nodes[node]); });
    }
}

}  // namespace

template <class Scalar>
void unite_boxes(const TreeShape& shape, TreeBoxes<Scalar>& boxes) {
    for (auto node = static_cast<std::uint32_t>(shape.nodes.size()); node-- > 0;) unite(shape, boxes, node);
}

template <class Scalar>
void unite_boxes(const TreeShape& shape, TreeBoxes<Scalar>& boxes, NumberSet& dirty) {
    dirty.each_down([&](std::uint32_t node) {
        unite(shape, boxes, node);
        if (shape.nodes[node].parent != k_no_parent) dirty.add(shape.nodes[node].parent);
    });
}

template <class Scalar>
void write_bounds(const TreeShape& shape, const TreeBoxes<Scalar>& boxes, const Frame& frame, Tree& tree,
                  const Executor& executor) {
    write_each(shape, boxes, frame, tree, [&](const auto& write) {
        constexpr std::size_t k_nodes = 256;  // of a part: about as much work as k_chunk triangles are elsewhere
        each_chunk(
            executor, shape.nodes.size(),
            [&](std::size_t, std::size_t begin, std::size_t end) {
                for (std::size_t node = begin; node < end; ++node) write(static_cast<std::uint32_t>(node));
            },
            k_nodes);
    });
}

template <class Scalar>
void write_bounds(const TreeShape& shape, const TreeBoxes<Scalar>& boxes, const Frame& frame, Tree& tree,
                  const NumberSet& dirty) {
    write_each(shape, boxes, frame, tree, [&](const auto& write) { dirty.each_down(write); });
}

template <class Scalar>
double expected_cost(const TreeShape& shape, const TreeBoxes<Scalar>& boxes, double unit) {
    const auto area = [&](const QuadBox<Scalar>& box) {
        const auto scale = static_cast<Scalar>(unit);
        return is_empty(box) ? 0.0 : static_cast<double>(QuadBox<Scalar>{box.low * scale, box.high * scale}.area());
    };
    if (shape.nodes.empty()) return static_cast<double>(k_cluster_cost);
    double nodes = 0;
    double clusters = 0;
    for (const QuadBox<Scalar>& box : boxes.nodes) nodes += area(box);
    for (const ClusterBox<Scalar>& box : boxes.clusters) clusters += area(box_of<Scalar>(box));
    const double whole = area(boxes.nodes[0]);
    const double cost = static_cast<double>(k_node_cost) * nodes + static_cast<double>(k_cluster_cost) * clusters;
    return whole > 0 ? cost / whole : 0;
}

#define PIERCE_REFIT(Scalar)                                                                                       \
    template void unite_boxes(const TreeShape&, TreeBoxes<Scalar>&);                                               \
    template void unite_boxes(const TreeShape&, TreeBoxes<Scalar>&, NumberSet&);                                   \
    template void write_bounds(const TreeShape&, const TreeBoxes<Scalar>&, const Frame&, Tree&, const Executor&);  \
    template void write_bounds(const TreeShape&, const TreeBoxes<Scalar>&, const Frame&, Tree&, const NumberSet&); \
    template double expected_cost(const TreeShape&, const TreeBoxes<Scalar>&, double)
PIERCE_REFIT(float);
PIERCE_REFIT(double);
#undef PIERCE_REFIT

}  // namespace pierce::detail
