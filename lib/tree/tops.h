// Binary trees over groups of clusters, each with its root at `from` and its nodes behind it; costs of all.
#pragma once

#include <vector>

#include <pierce/executor.h>
#include <raw_array.h>
#include <tree/collapse.h>
#include <tree/ploc.h>
#include <tree/sah.h>

namespace pierce::detail {

/// The binary nodes: first those of all groups, then both tops.
template <class Scalar>
struct Forest {
    std::vector<std::uint32_t> groups;  // where they begin, and the end
    std::vector<std::uint32_t> roots;   // of them among the nodes
    RawArray<Binary<Scalar>> nodes;
    RawArray<CostRow> rows;
    [[nodiscard]] std::uint32_t group_count() const { return static_cast<std::uint32_t>(roots.size()); }
};

// Takes the group's tree to a leaf of a top.
template <class Scalar>
void graft(Forest<Scalar>& forest, std::uint32_t node, std::uint32_t group) {
    forest.nodes[node] = forest.nodes[forest.roots[group]];
    forest.rows[node] = forest.rows[forest.roots[group]];
}

/// By SAH: large sets first, then each of the sets that are left is a part of the work.
template <class Scalar>
class SahTop {
  public:
    explicit SahTop(std::size_t count) : items_(count), spare_(count), is_group_(2 * count) {}

    void make(Forest<Scalar>& forest, std::uint32_t from, std::span<const ClusterBox<Scalar>> boxes,
              const Executor& executor) {
        const std::uint32_t count = forest.group_count();
        for (std::uint32_t g = 0; g < count; ++g) {
            items_[g] = forest.nodes[forest.roots[g]];
            items_[g].at = g;
            items_[g].count = forest.groups[g + 1] - forest.groups[g];
        }
        std::fill(is_group_.begin(), is_group_.end(), std::uint8_t{0});
        Collapse<Scalar> collapse(forest.nodes.data(), forest.rows.data(), boxes);

        // A set of n has 2 n - 2 nodes below its own.
        std::vector<Part> parts{{make_splitter_of(0).set_of(from, 0, count), from + 1}};
        std::vector<std::uint32_t> above;
        for (std::size_t i = 0; i < parts.size(); ++i)
            while (parts[i].set.size() > std::max(k_least_part, count / 16)) {
                above.push_back(parts[i].set.node);
                parts.push_back(split(parts[i], forest));
            }
        executor(parts.size(), [&](std::size_t i) { make_part(parts[i], forest, from, collapse); });
        for (std::size_t i = above.size(); i-- > 0;) collapse.find_cost(above[i]);
    }

  private:
    static constexpr std::uint32_t k_least_part = 64;
    struct Part {
        SahSet<Scalar> set;
        std::uint32_t next;
    };

    auto make_splitter_of(std::uint32_t begin) {
        return make_splitter<Scalar>(items_.data(), spare_.data() + begin,
                                     [](const Binary<Scalar>& item) { return item.count; });
    }
    // The first half stays in `part`.
    Part split(Part& part, Forest<Scalar>& forest) {
        auto [left, right] = make_splitter_of(part.set.begin).split(part.set);
        left.node = part.next;
        right.node = part.next + 1;
        Binary<Scalar>& node = forest.nodes[part.set.node];
        set_box(node, part.set.box);
        node.at = left.node;
        node.count = 0;
        part = {left, part.next + 2};
        return {right, part.next + 2 * (left.size() - 1)};
    }
    void make_part(const Part& part, Forest<Scalar>& forest, std::uint32_t from, Collapse<Scalar> collapse) {
        SahSet<Scalar> stack[k_sah_stack];
        SahSplitter splitter = make_splitter_of(part.set.begin);
        const std::uint32_t end =
            make_binary<Scalar>(splitter, part.set.begin, part.set.end, 1, forest.nodes.data(), part.set.node,
                                part.next, stack, [&](const SahSet<Scalar>& set) {
                                    graft(forest, set.node, items_[set.begin].at);
                                    is_group_[set.node - from] = 1;
                                });
        const auto finish = [&](std::uint32_t at) {
            if (is_group_[at - from] == 0) collapse.find_cost(at);
        };
        for (std::uint32_t at = end; at-- > part.next;) finish(at);
        finish(part.set.node);
    }

    RawArray<Binary<Scalar>> items_;
    RawArray<Binary<Scalar>> spare_;
    RawArray<std::uint8_t> is_group_;
};

/// By PLOC. `make` returns false if there is none.
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

}  // namespace pierce::detail
