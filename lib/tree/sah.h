// Where to split a set of boxes, by the surface area heuristic in bins (MacDonald and Booth 1990; Wald 2007).
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include <cluster/quad.h>
#include <tree/binary.h>

namespace pierce::detail {

/// A set of items: a range, their box and that of their centres (doubled: low + high).
template <class Scalar>
struct SahSet {
    std::uint32_t node;
    std::uint32_t begin;
    std::uint32_t end;
    unsigned depth;
    QuadBox<Scalar> box;
    QuadBox<Scalar> centers;

    [[nodiscard]] std::uint32_t size() const { return end - begin; }
    void add(const QuadBox<Scalar>& b) {
        const Quad<Scalar> center = b.low + b.high;
        box.add(b);
        centers.add({center, center});
    }
};

/// Deeper than this sets are halved, which takes 28 more splits at most.
constexpr unsigned k_sah_deep = 48;
constexpr std::size_t k_sah_stack = k_sah_deep + 32;

/// Splits ranges of `items`, which have boxes; `weight(item)` is the number of clusters in one. `spare` has room for as
/// many.
template <class Scalar, class Item, class Weight>
class SahSplitter {
  public:
    SahSplitter(Item* items, Item* spare, Weight weight) : items_(items), spare_(spare), weight_(weight) {}

    [[nodiscard]] SahSet<Scalar> set_of(std::uint32_t node, std::uint32_t begin, std::uint32_t end) const {
        SahSet<Scalar> set{node, begin, end, 0, {}, {}};
        for (std::uint32_t i = begin; i < end; ++i) set.add(box_of<Scalar>(items_[i]));
        return set;
    }

    /// Neither part is empty. Deeper than `k_sah_deep` halves are taken whatever that costs: so no input makes trees of
    /// any depth or builds of any time. The same where bins can't tell the items from one another.
    [[nodiscard]] std::pair<SahSet<Scalar>, SahSet<Scalar>> split(const SahSet<Scalar>& set) {
        const std::uint32_t n = set.size();
        SahSet<Scalar> left{0, set.begin, set.begin, set.depth + 1, {}, {}};
        SahSet<Scalar> right{0, set.end, set.end, set.depth + 1, {}, {}};
        if (n == 2) {  // half of all splits down to single items; the search finds no other
            const QuadBox<Scalar> a = box_of<Scalar>(items_[set.begin]), b = box_of<Scalar>(items_[set.begin + 1]);
            left.add(a);
            right.add(b);
            left.end = right.begin = set.begin + 1;
            return {left, right};
        }
        bins_ = n < 12 ? 6 : n < 64 ? 8 : k_most_bins;
        const Quad<Scalar> extent = set.centers.high - set.centers.low;
        low_ = set.centers.low;
        scale_ = all_of(static_cast<Scalar>(bins_) * Scalar(0.9999)) / extent;
        for (int k = 0; k < 4; ++k)
            if (!(scale_[k] <= std::numeric_limits<Scalar>::max())) scale_[k] = 0;  // no extent, or next to none
        const Cut cut = set.depth < k_sah_deep ? best_cut(set) : Cut{};
        if (cut.axis < 0) {
            const std::uint32_t middle = set.begin + n / 2;
            for (std::uint32_t i = set.begin; i < set.end; ++i)
                (i < middle ? left : right).add(box_of<Scalar>(items_[i]));
            left.end = right.begin = middle;
            return {left, right};
        }
        std::uint32_t at = set.begin;
        std::uint32_t spared = 0;
        for (std::uint32_t i = set.begin; i < set.end; ++i) {
            const Item item = items_[i];
            const QuadBox<Scalar> box = box_of<Scalar>(item);
            if (bin_of(box)[cut.axis] < cut.bin) {
                left.add(box);
                items_[at++] = item;
            } else {
                right.add(box);
                spare_[spared++] = item;
            }
        }
        std::copy_n(spare_, spared, items_ + at);
        left.end = right.begin = at;
        return {left, right};
    }

  private:
    static constexpr int k_most_bins = 16;
    struct Cut {
        int axis = -1;
        int bin = 0;
    };

    [[nodiscard, gnu::always_inline]] IntQuad bin_of(const QuadBox<Scalar>& box) const {
        const Quad<Scalar> x = (box.low + box.high - low_) * scale_;
        return __builtin_convertvector(least(x, all_of(static_cast<Scalar>(bins_ - 1))),
                                       IntQuad);  // not below 0: `low_` is the least
    }

    // All three axes in step: a lane for each.
    Cut best_cut(const SahSet<Scalar>& set) {
        for (auto& axis : boxes_) std::fill_n(axis, bins_, QuadBox<Scalar>{});
        std::fill_n(weights_, bins_, Quad<Scalar>{});
        for (std::uint32_t i = set.begin; i < set.end; ++i) {
            const QuadBox<Scalar> box = box_of<Scalar>(items_[i]);
            const IntQuad bin = bin_of(box);
            const auto weight = static_cast<Scalar>(weight_(items_[i]));
            for (int k = 0; k < 3; ++k) {
                boxes_[k][bin[k]].add(box);
                weights_[bin[k]][k] += weight;
            }
        }
        Quad<Scalar> below[k_most_bins];  // cost of the bins before
        Quad<Scalar> weights[k_most_bins];
        QuadBox<Scalar> sums[3];
        Quad<Scalar> weight{};
        const auto add_bin = [&](int i) {
            for (int k = 0; k < 3; ++k) sums[k].add(boxes_[k][i]);
            weight += weights_[i];
            return areas(sums) * weight;  // no number where there is nothing
        };
        for (int i = 0; i + 1 < bins_; ++i) {
            below[i] = add_bin(i);
            weights[i] = weight;
        }
        const Quad<Scalar> none{};
        for (QuadBox<Scalar>& sum : sums) sum = {};
        weight = none;
        Quad<Scalar> least_cost = all_of(std::numeric_limits<Scalar>::infinity());
        Quad<Scalar> bins{};
        for (int i = bins_; --i > 0;) {
            const Quad<Scalar> cost = below[i - 1] + add_bin(i);
            const auto better = (cost < least_cost) & (weight > none) & (weights[i - 1] > none) & (scale_ > none);
            least_cost = better ? cost : least_cost;
            bins = better ? all_of(static_cast<Scalar>(i)) : bins;
        }
        Cut best;
        Scalar least = std::numeric_limits<Scalar>::infinity();
        for (int k = 0; k < 3; ++k) {
            if (!(least_cost[k] < least)) continue;
            least = least_cost[k];
            best = {k, static_cast<int>(bins[k])};
        }
        return best;
    }
    [[nodiscard, gnu::always_inline]] static Quad<Scalar> areas(const QuadBox<Scalar> (&boxes)[3]) {
        const Quad<Scalar> extents[4] = {boxes[0].high - boxes[0].low, boxes[1].high - boxes[1].low,
                                         boxes[2].high - boxes[2].low, {}};
        Quad<Scalar> d[3];
        transpose(extents, d);
        return d[0] * d[1] + (d[1] * d[2] + d[2] * d[0]);
    }

    Item* items_;
    Item* spare_;
    Weight weight_;
    int bins_ = 0;
    Quad<Scalar> low_{};
    Quad<Scalar> scale_{};
    QuadBox<Scalar> boxes_[3][k_most_bins];
    Quad<Scalar> weights_[k_most_bins];
};

template <class Scalar, class Item, class Weight>
[[nodiscard]] SahSplitter<Scalar, Item, Weight> make_splitter(Item* items, Item* spare, Weight weight) {
    return {items, spare, weight};
}

/// Splits the items in [begin, end) down to sets of at most `leaf_size` and makes nodes of them: `root`, and others
/// from `next` on. A leaf is what `make_leaf(set)` makes of it. Returns the first node that is free. `stack` has room
/// for `k_sah_stack` sets.
template <class Scalar, class Splitter, class MakeLeaf>
std::uint32_t make_binary(Splitter& splitter, std::uint32_t begin, std::uint32_t end, std::uint32_t leaf_size,
                          Binary<Scalar>* nodes, std::uint32_t root, std::uint32_t next, SahSet<Scalar>* stack,
                          MakeLeaf&& make_leaf) {
    std::size_t depth = 0;
    stack[depth++] = splitter.set_of(root, begin, end);
    while (depth > 0) {
        const SahSet<Scalar> set = stack[--depth];
        if (set.size() <= leaf_size) {
            make_leaf(set);
            continue;
        }
        auto [left, right] = splitter.split(set);
        left.node = next;
        right.node = next + 1;
        set_box(nodes[set.node], set.box);
        nodes[set.node].at = next;
        nodes[set.node].count = 0;
        next += 2;
        stack[depth++] = right;
        stack[depth++] = left;
    }
    return next;
}

}  // namespace pierce::detail
