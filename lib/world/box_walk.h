// Which boxes of a tree a way comes to, roughly nearest first.
//
// A box is taken for larger by m = noise + slack in each coordinate: what images may be off (placement.h), and what is
// rounded here. low - m - from, in any order, is off by 2^-52 of |low| + m + |from|, and d by 2^-53 of itself, with
// which a place at the parameter t moves by 2^-52 of the ends: m allows for both (k_box_slack, 2^-49). Times 1 / d it
// is within 2^-51.4 of itself more; so where one parameter is no larger than another, it is within 2^-50 of itself
// after rounding: `far` is taken for that much larger, twice. (A box that has its slack already, `BoxTree::Four`, was
// rounded once more, by 2^-53 of itself and the slack.) Where products underflow they are off by 2^-1074. NaN, of 0
// times infinity, leaves a bound as it is. Where the way may be too long for numbers all boxes are come to.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
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
            inverse_[k] = 1 / d;
            start = std::max(start, std::abs(path.from[k]));
            end = std::max(end, std::abs(path.to[k]));
        }
        const double reach = path.ray ? start + end : std::max(start, end);
        noise = (noise + k_box_slack) * reach + radius * (1 + k_box_slack) + std::numeric_limits<double>::min();
        for (std::size_t k = 0; k < 3; ++k) {
            const bool backwards = inverse_[k] < 0;
            first_[k] = backwards ? k + 3 : k;
            last_[k] = backwards ? k : k + 3;
            start_[k] = backwards ? path.from[k] - noise : path.from[k] + noise;
            stop_[k] = backwards ? path.from[k] + noise : path.from[k] - noise;
        }
        all_ = !(reach + radius < 0x1p1000);
    }

    static constexpr double k_missed = std::numeric_limits<double>::infinity();

    /// The fraction from which on the way may be in the box, at least 0; `k_missed` where it is not up to `limit`.
    [[nodiscard]] double entry(const BoxTree::Node& node, double limit) const {
        if (all_) return 0;
        const auto slack = static_cast<double>(node.slack);
        double near = 0;
        double far = limit;
        for (std::size_t k = 0; k < 3; ++k) {
            const bool forwards = first_[k] < 3;
            const double wide = forwards ? slack : -slack;
            const double in = (((forwards ? node.low : node.high)[k] - wide) - start_[k]) * inverse_[k];
            const double out = (((forwards ? node.high : node.low)[k] + wide) - stop_[k]) * inverse_[k];
            near = in > near ? in : near;
            far = out < far ? out : far;
        }
        return is_before(near, far) ? near : k_missed;
    }

    /// The same of four boxes: which of them are met, as bits.
    [[nodiscard]] unsigned entries(const BoxTree::Four& four, double limit, std::array<double, 4>& at) const {
        const unsigned there = (1U << four.count) - 1;
        at = {};
        if (all_) return there;
        // Two at a time: as wide as every processor has it.
        typedef double Two __attribute__((vector_size(16)));
        unsigned met = 0;
        for (unsigned half = 0; half < 4; half += 2) {
            Two near{};
            Two far = near + limit;
            for (std::size_t k = 0; k < 3; ++k) {
                Two first;
                Two last;
                std::memcpy(&first, four.bounds[first_[k]] + half, sizeof first);
                std::memcpy(&last, four.bounds[last_[k]] + half, sizeof last);
                const Two in = (first - start_[k]) * inverse_[k];
                const Two out = (last - stop_[k]) * inverse_[k];
                near = in > near ? in : near;
                far = out < far ? out : far;
            }
            const auto missed = near > far * (1 + 0x1p-49) + 0x1p-1000;
            met |= (missed[0] != 0 ? 0U : 1U << half) | (missed[1] != 0 ? 0U : 2U << half);
            std::memcpy(at.data() + half, &near, sizeof near);
        }
        return met & there;
    }

    /// Whether a way that is in a box from `near` on, rounded, may be so at `far`, rounded or not.
    [[nodiscard]] static bool is_before(double near, double far) { return !(near > far * (1 + 0x1p-49) + 0x1p-1000); }

  private:
    Point inverse_{};
    Point start_{};  ///< with the noise, for the bounds that are come to first
    Point stop_{};
    std::array<std::size_t, 3> first_{};  ///< which bounds those are: no branch on the direction
    std::array<std::size_t, 3> last_{};
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
        std::int32_t child;
        double at;
    };
    constexpr std::size_t k_stack = 64;
    std::array<Entry, k_stack> stack;
    std::size_t count = 0;
    if (tree.root() == BoxTree::k_none || !(limit >= 0)) return;
    ++counters.nodes;
    const BoxTree::Node& top = tree.node(tree.root());
    Entry here{top.leaf() ? BoxTree::leaf_of(top.right) : tree.root(), probe.entry(top, limit)};
    for (;;) {
        if (BoxProbe::is_before(here.at, limit)) {  // what is missed is at infinity
            if (BoxTree::is_leaf(here.child)) {
                limit = visit(static_cast<std::uint32_t>(BoxTree::leaf_of(here.child)), limit);
            } else {
                ++counters.nodes;
                const BoxTree::Four& four = tree.four(here.child);
                std::array<double, 4> at;
                const bool fits = count + at.size() <= k_stack;
                const std::size_t base = count;
                for (unsigned met = probe.entries(four, limit, at); met != 0 && limit >= 0; met &= met - 1) {
                    const auto i = static_cast<std::size_t>(std::countr_zero(met));
                    const std::int32_t child = four.child[i];
                    if (fits) {  // the nearest on top
                        std::size_t place = count++;
                        for (; place > base && stack[place - 1].at < at[i]; --place) stack[place] = stack[place - 1];
                        stack[place] = {child, at[i]};
                    } else if (BoxTree::is_leaf(child)) {
                        limit = visit(static_cast<std::uint32_t>(BoxTree::leaf_of(child)), limit);
                    } else {
                        walk::below(tree, child, probe, limit, counters, visit);
                    }
                }
            }
            if (limit < 0) return;
        }
        if (count == 0) return;
        here = stack[--count];
    }
}

}  // namespace pierce::detail
