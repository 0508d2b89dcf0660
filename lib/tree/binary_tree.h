// The binary tree that the wide one is made from: top down, by the surface area heuristic.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include <cluster/clusters.h>
#include <raw_array.h>
#include <vector4.h>

namespace pierce::detail {

template <class Scalar>
[[gnu::always_inline]] inline Box4<Scalar> box4(const ClusterBox<Scalar>& box) {
    return {three(box.low), three(box.high)};
}

/// Over the boxes [begin, end) of a list. Subtrees lie behind their parents: that of n boxes takes 2n - 1 places, the lower child at the next
/// place, the upper one behind all of the lower one's. So where a subtree lies is known before it is built.
template <class Scalar>
struct BinaryNode {
    Box4<Scalar> box;
    std::uint32_t begin;
    std::uint32_t end;

    [[nodiscard]] bool leaf() const { return end - begin == 1; }
};

template <class Scalar>
class BinaryTree {
  public:
    explicit BinaryTree(std::span<ClusterBox<Scalar>> boxes) : boxes_(boxes), nodes_(2 * boxes.size() - 1), middles_(nodes_.size()) {}

    [[nodiscard]] const BinaryNode<Scalar>& operator[](std::size_t at) const { return nodes_[at]; }
    [[nodiscard]] std::size_t size() const { return nodes_.size(); }
    [[nodiscard]] std::size_t lower(std::size_t at) const { return at + 1; }
    [[nodiscard]] std::size_t upper(std::size_t at) const { return at + 2 * std::size_t{middles_[at] - nodes_[at].begin}; }

    void set(std::size_t at, std::uint32_t begin, std::uint32_t end) {
        BinaryNode<Scalar>& node = nodes_[at];
        node.begin = begin;
        node.end = end;
        node.box = Box4<Scalar>::none();
        for (std::uint32_t i = begin; i < end; ++i) node.box.add(box4(boxes_[i]));
    }

    /// Parts a node that is set in two, and sets both. `balanced`: in halves, as the boxes lie.
    void split(std::size_t at, bool balanced) {
        const BinaryNode<Scalar>& node = nodes_[at];
        const std::uint32_t middle = balanced ? node.begin + (node.end - node.begin) / 2 : partition(node);
        middles_[at] = middle;
        set(lower(at), node.begin, middle);
        set(upper(at), middle, node.end);
    }

  private:
    static constexpr int k_bins = 16;

    struct Bins {
        std::array<Box4<Scalar>, k_bins> box;
        std::array<std::uint32_t, k_bins> count;
    };

    // Binned (Wald 2007): of sixteen slabs of centres along each axis, the cut with the least sum of areas times boxes. Returns the first box of the upper
    // part, the middle where no cut parts them.
    std::uint32_t partition(const BinaryNode<Scalar>& node) {
        const std::uint32_t half = node.begin + (node.end - node.begin) / 2;
        if (node.end - node.begin == 2) return half;
        Box4<Scalar> centers = Box4<Scalar>::none();
        for (std::uint32_t i = node.begin; i < node.end; ++i) {
            const Box4<Scalar> box = box4(boxes_[i]);
            centers.add(box.low + box.high);
        }
        const int bins = node.end - node.begin < 12 ? 6 : node.end - node.begin < 64 ? 8 : k_bins;
        const Vector4<Scalar> extent = centers.high - centers.low;
        Vector4<Scalar> scale{};
        for (int k = 0; k < 3; ++k) {
            scale[k] = static_cast<Scalar>(bins) * Scalar(0.9999) / extent[k];
            if (!(extent[k] > 0) || !(scale[k] <= std::numeric_limits<Scalar>::max())) scale[k] = 0;
        }
        const auto slab = [&](const Box4<Scalar>& box, int k) {
            return std::min(static_cast<int>((box.low[k] + box.high[k] - centers.low[k]) * scale[k]), bins - 1);
        };
        std::array<Bins, 3> all;
        for (Bins& axis : all) {
            axis.box.fill(Box4<Scalar>::none());
            axis.count.fill(0);
        }
        for (std::uint32_t i = node.begin; i < node.end; ++i) {
            const Box4<Scalar> box = box4(boxes_[i]);
            for (int k = 0; k < 3; ++k) {
                const auto bin = static_cast<std::size_t>(slab(box, k));
                all[static_cast<std::size_t>(k)].box[bin].add(box);
                ++all[static_cast<std::size_t>(k)].count[bin];
            }
        }
        Scalar best = std::numeric_limits<Scalar>::infinity();
        int best_axis = -1;
        int best_cut = 0;
        for (int k = 0; k < 3; ++k) {
            if (!(scale[k] > 0)) continue;
            const Bins& axis = all[static_cast<std::size_t>(k)];
            std::array<Scalar, k_bins> cost_below;
            Box4<Scalar> box = Box4<Scalar>::none();
            std::uint32_t count = 0;
            for (int i = 0; i < bins - 1; ++i) {
                box.add(axis.box[static_cast<std::size_t>(i)]);
                count += axis.count[static_cast<std::size_t>(i)];
                cost_below[static_cast<std::size_t>(i)] = count == 0 ? std::numeric_limits<Scalar>::infinity() : box.half_area() * static_cast<Scalar>(count);
            }
            box = Box4<Scalar>::none();
            count = 0;
            for (int i = bins - 1; i > 0; --i) {
                box.add(axis.box[static_cast<std::size_t>(i)]);
                count += axis.count[static_cast<std::size_t>(i)];
                if (count == 0) continue;
                const Scalar cost = cost_below[static_cast<std::size_t>(i - 1)] + box.half_area() * static_cast<Scalar>(count);
                if (!(cost < best)) continue;
                best = cost;
                best_axis = k;
                best_cut = i;
            }
        }
        if (best_axis < 0) return half;
        const auto first = boxes_.begin() + node.begin;
        const auto middle = std::partition(first, boxes_.begin() + node.end,
                                           [&](const ClusterBox<Scalar>& box) { return slab(box4(box), best_axis) < best_cut; });
        return node.begin + static_cast<std::uint32_t>(middle - first);
    }

    std::span<ClusterBox<Scalar>> boxes_;
    RawArray<BinaryNode<Scalar>> nodes_;
    RawArray<std::uint32_t> middles_;
};

}  // namespace pierce::detail
