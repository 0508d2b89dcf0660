// From clusters to the wide tree: a binary tree in parts for the executor, its collapse, and the nodes' encoding.
#include <tree/make_tree.h>

#include <cmath>
#include <vector>

#include <tree/collapse.h>
#include <tree/encode.h>

namespace pierce::detail {

namespace {

constexpr std::uint32_t k_part_boxes = 2048;  ///< a subtree for a thread has no more

template <class Scalar>
Box4<Scalar> united(std::span<const ClusterBox<Scalar>> boxes) {
    Box4<Scalar> all = Box4<Scalar>::none();
    for (const ClusterBox<Scalar>& box : boxes) all.add(box4(box));
    return all;
}

template <class Scalar>
void fill_frame(const Box4<Scalar>& all, Frame& frame) {
    double widest = 0;
    for (int k = 0; k < 3; ++k) {
        frame.low[k] = static_cast<double>(all.low[k]);
        frame.high[k] = static_cast<double>(all.high[k]);
        widest = std::max(widest, frame.high[k] - frame.low[k]);
    }
    widest = std::max(widest, std::numeric_limits<double>::min() * 0x1p20);
    frame.step = std::ldexp(1.0, std::ilogb(widest) - 15);
    while (widest > 65528 * frame.step) frame.step *= 2;
    for (double& low : frame.low) low -= 3 * frame.step;
}

// Whether the lattice's cells are large for the boxes: of a sample's largest extents the median is below eight.
template <class Scalar>
bool is_coarse(std::span<const ClusterBox<Scalar>> boxes, const Frame& frame) {
    const std::size_t stride = boxes.size() / 4096 + 1;
    std::vector<double> extents;
    for (std::size_t i = 0; i < boxes.size(); i += stride) {
        double extent = 0;
        for (int k = 0; k < 3; ++k) extent = std::max(extent, static_cast<double>(boxes[i].high[k] - boxes[i].low[k]));
        extents.push_back(extent);
    }
    const auto middle = extents.begin() + static_cast<std::ptrdiff_t>(extents.size() / 2);
    std::nth_element(extents.begin(), middle, extents.end());
    return *middle < 8 * frame.step;
}

template <class Scalar>
class Builder {
  public:
    Builder(std::span<ClusterBox<Scalar>> boxes, const Executor& executor)
        : boxes_(boxes), executor_(executor), tree_(boxes), collapse_(tree_) {}

    void build(bool balanced) {
        tree_.set(0, 0, static_cast<std::uint32_t>(boxes_.size()));
        std::vector<std::size_t> tops;   // parents before children
        std::vector<std::size_t> parts;
        std::vector<std::size_t> stack{0};
        while (!stack.empty()) {
            const std::size_t at = stack.back();
            stack.pop_back();
            if (tree_[at].end - tree_[at].begin <= k_part_boxes) {
                parts.push_back(at);
                continue;
            }
            tree_.split(at, balanced);
            tops.push_back(at);
            stack.push_back(tree_.upper(at));
            stack.push_back(tree_.lower(at));
        }
        executor_(parts.size(), [&](std::size_t i) { build_part(parts[i], balanced); });
        for (std::size_t i = tops.size(); i-- > 0;) collapse_.find_cost(tops[i]);
    }

    [[nodiscard]] bool is_finite() const { return std::isfinite(collapse_.cost(0)); }

    /// False, and nothing of use, if the tree is too deep.
    template <class AnyNode>
    [[nodiscard]] bool write(ClusterRef empty, const Frame& frame, Tree& out) const {
        struct Task {
            std::size_t at;
            std::uint32_t node;
            unsigned depth;
        };
        std::vector<Node> nodes(1);
        nodes.reserve(boxes_.size() / 5 + 1);
        std::vector<Task> stack{{0, 0, 1}};
        out.depth = 0;
        while (!stack.empty()) {
            const Task task = stack.back();
            stack.pop_back();
            out.depth = std::max(out.depth, task.depth);
            if (task.depth > k_most_depth) return false;
            std::array<std::size_t, k_children> children;
            std::array<EncodedBox, k_children> encoded;
            const unsigned count = collapse_.children(task.at, children);
            for (unsigned i = 0; i < count; ++i) {
                const BinaryNode<Scalar>& child = tree_[children[i]];
                std::uint32_t ref = boxes_[child.begin].ref;
                if (!child.leaf()) {
                    ref = static_cast<std::uint32_t>(nodes.size());
                    nodes.emplace_back();
                    stack.push_back({children[i], ref, task.depth + 1});
                }
                encoded[i] = relative_box(child.box, frame, ref);
            }
            AnyNode node;
            encode(encoded.data(), count, empty, frame, node);
            std::memcpy(static_cast<void*>(&nodes[task.node]), &node, sizeof node);
        }
        out.nodes = RawArray<Node>(nodes.size());
        std::copy(nodes.begin(), nodes.end(), out.nodes.begin());
        out.node_count = nodes.size();
        return true;
    }

  private:
    // A subtree's nodes lie behind one another: costs from the last on.
    void build_part(std::size_t root, bool balanced) {
        const std::size_t end = root + 2 * std::size_t{tree_[root].end - tree_[root].begin} - 1;
        for (std::size_t at = root; at < end; ++at)
            if (!tree_[at].leaf()) tree_.split(at, balanced);
        for (std::size_t at = end; at-- > root;) collapse_.find_cost(at);
    }

    std::span<ClusterBox<Scalar>> boxes_;
    const Executor& executor_;
    BinaryTree<Scalar> tree_;
    Collapse<Scalar> collapse_;
};

}  // namespace

template <class Scalar>
Tree make_tree(std::span<ClusterBox<Scalar>> boxes, ClusterRef empty, Frame& frame, const Executor& executor) {
    fill_frame(united<Scalar>(boxes), frame);
    Tree tree;
    tree.coarse = is_coarse<Scalar>(boxes, frame);
    if (boxes.size() == 1) {
        tree.root = boxes[0].ref;
        return tree;
    }
    Builder<Scalar> builder(boxes, executor);
    const auto write = [&] { return tree.coarse ? builder.template write<CoarseNode>(empty, frame, tree) : builder.template write<Node>(empty, frame, tree); };
    builder.build(false);
    if (builder.is_finite() && write()) return tree;
    // Of halves the depth is at most that of their number's logarithm.
    builder.build(true);
    if (!write()) std::abort();  // 2^28 clusters are 28 halvings
    return tree;
}

template Tree make_tree(std::span<ClusterBox<float>>, ClusterRef, Frame&, const Executor&);
template Tree make_tree(std::span<ClusterBox<double>>, ClusterRef, Frame&, const Executor&);

}  // namespace pierce::detail
