// Which boxes of a tree a way comes to, roughly nearest first.
//
// A box is taken for larger by m = noise + slack in each coordinate: what images may be off (placement.h), and what is
// rounded here. low - m - from is off by 2^-52 of |low| + m + |from|, and d by 2^-53 of itself, with which a place at
// the parameter t moves by 2^-52 of the ends: m allows for both (k_box_slack, 2^-49). Times 1 / d it is within 2^-51.4
// of itself more; so where one parameter is no larger than another, it is within 2^-50 of itself after rounding: `far`
// is taken for that much larger, twice. Where products underflow they are off by 2^-1074. NaN, of 0 times infinity,
// leaves a bound as it is. Where the way may be too long for numbers all boxes are come to.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <world/box_tree.h>

namespace pierce::detail {

/// What a box's own coordinates ask of its slack, and those of a way's ends of the noise.
inline constexpr double k_box_slack = 0x1p-49;

class BoxProbe {
  public:
    /// `noise`: what images may be off for the ends' sake, in the largest |coordinate| of an end. `radius`: of a ball
    /// whose center goes the way.
    BoxProbe(const Path& path, double noise, double radius = 0) {
        double start = 0;
        double end = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double d = path.ray ? path.to[k] : path.to[k] - path.from[k];
            from_[k] = path.from[k];
            inverse_[k] = 1 / d;
            backwards_[k] = inverse_[k] < 0;
            start = std::max(start, std::abs(path.from[k]));
            end = std::max(end, std::abs(path.to[k]));
        }
        const double reach = path.ray ? start + end : std::max(start, end);
        noise_ = (noise + k_box_slack) * reach + radius * (1 + k_box_slack) + std::numeric_limits<double>::min();
        all_ = !(reach + radius < 0x1p1000);
    }

    static constexpr double k_missed = std::numeric_limits<double>::infinity();

    /// The fraction from which on the way may be in the box, at least 0; `k_missed` where it is not up to `limit`.
    [[nodiscard]] double entry(const BoxTree::Node& node, double limit) const {
        if (all_) return 0;
        const double m = noise_ + static_cast<double>(node.slack);
        double near = 0;
        double far = limit;
        for (std::size_t k = 0; k < 3; ++k) {
            // No branch on the direction: it can't be predicted.
            const Point& first = *(backwards_[k] ? &node.high : &node.low);
            const Point& last = *(backwards_[k] ? &node.low : &node.high);
            const double wide = backwards_[k] ? -m : m;
            const double in = ((first[k] - wide) - from_[k]) * inverse_[k];
            const double out = ((last[k] + wide) - from_[k]) * inverse_[k];
            near = in > near ? in : near;
            far = out < far ? out : far;
        }
        return is_before(near, far) ? near : k_missed;
    }

    /// Whether a way that is in a box from `near` on, rounded, may be so at `far`, rounded or not.
    [[nodiscard]] static bool is_before(double near, double far) { return !(near > far * (1 + 0x1p-49) + 0x1p-1000); }

  private:
    Point from_{};
    Point inverse_{};
    std::array<bool, 3> backwards_{};
    double noise_ = 0;
    bool all_ = false;
};

namespace walk {

/// All leaves below `top`, in no order of distance, by parents: for what is deeper than a stack is long.
template <class Visit>
void below(const BoxTree& tree, std::int32_t top, const BoxProbe& probe, double& limit, QueryCounters& counters,
           Visit&& visit) {
    std::int32_t index = top;
    while (limit >= 0) {
        const BoxTree::Node& node = tree.node(index);
        ++counters.nodes;
        if (probe.entry(node, limit) != BoxProbe::k_missed) {
            if (!node.leaf()) {
                index = node.left;
                continue;
            }
            limit = visit(static_cast<std::uint32_t>(node.right), limit);
        }
        while (index != top && tree.node(tree.node(index).parent).right == index) index = tree.node(index).parent;
        if (index == top) return;
        index = tree.node(tree.node(index).parent).right;
    }
}

}  // namespace walk

/// Calls `visit(number, limit)` for each leaf that the way may come to up to `limit`. It returns the fraction from
/// which on nothing is of use; negative: nothing is any more.
template <class Visit>
void each_box(const BoxTree& tree, const BoxProbe& probe, double limit, QueryCounters& counters, Visit&& visit) {
    struct Entry {
        std::int32_t index;
        double at;
    };
    constexpr std::size_t k_stack = 48;
    std::array<Entry, k_stack> stack;
    std::size_t count = 0;
    const auto entry_of = [&](std::int32_t index) { return probe.entry(tree.node(index), limit); };
    if (tree.root() == BoxTree::k_none || !(limit >= 0)) return;
    Entry here{tree.root(), entry_of(tree.root())};
    ++counters.nodes;
    for (;;) {
        if (here.at != BoxProbe::k_missed && BoxProbe::is_before(here.at, limit)) {
            const BoxTree::Node& node = tree.node(here.index);
            if (!node.leaf()) {
                Entry first{node.left, entry_of(node.left)};
                Entry second{node.right, entry_of(node.right)};
                counters.nodes += 2;
                if (second.at < first.at) std::swap(first, second);
                if (first.at != BoxProbe::k_missed) {
                    if (second.at != BoxProbe::k_missed) {
                        if (count < k_stack)
                            stack[count++] = second;
                        else
                            walk::below(tree, second.index, probe, limit, counters, visit);
                        if (limit < 0) return;
                    }
                    here = first;
                    continue;
                }
            } else {
                limit = visit(static_cast<std::uint32_t>(node.right), limit);
                if (limit < 0) return;
            }
        }
        if (count == 0) return;
        here = stack[--count];
    }
}

}  // namespace pierce::detail
