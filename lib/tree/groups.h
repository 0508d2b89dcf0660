// Clusters in groups of up to sixteen, by their keys: large trees are made of groups, small ones inside them.
#pragma once

#include <algorithm>
#include <bit>
#include <span>
#include <vector>

#include <cluster/clusters.h>
#include <cluster/quad.h>

namespace pierce::detail {

constexpr std::uint32_t k_most_in_group = 16;

/// Subtrees of the radix tree of keys again. What is larger than `large_area` stays apart. Returns where groups begin,
/// and the end.
template <class Scalar>
[[nodiscard]] std::vector<std::uint32_t> find_groups(std::span<const ClusterBox<Scalar>> boxes, Scalar large_area) {
    struct Range {
        std::uint32_t begin;
        std::uint32_t end;
    };
    std::vector<std::uint32_t> begins;
    begins.reserve(boxes.size() / 6 + 16);
    std::vector<Range> stack{{0, static_cast<std::uint32_t>(boxes.size())}};
    const auto too_large = [&](const Range& range) {
        const std::uint32_t size = range.end - range.begin;
        if (size == 1) return false;
        if (size > k_most_in_group) return true;
        QuadBox<Scalar> box;
        for (std::uint32_t i = range.begin; i < range.end; ++i) box.add(box_of<Scalar>(boxes[i]));
        return box.area() > large_area;
    };
    while (!stack.empty()) {
        Range range = stack.back();
        stack.pop_back();
        while (too_large(range)) {
            std::uint32_t middle = range.begin + (range.end - range.begin) / 2;
            if (const std::uint32_t bits = boxes[range.begin].key ^ boxes[range.end - 1].key; bits != 0) {
                const int bit = 31 - std::countl_zero(bits);
                const auto first_one =
                    std::partition_point(boxes.begin() + range.begin, boxes.begin() + range.end,
                                         [bit](const ClusterBox<Scalar>& box) { return (box.key >> bit & 1) == 0; });
                middle = static_cast<std::uint32_t>(first_one - boxes.begin());
            }
            stack.push_back({middle, range.end});
            range.end = middle;
        }
        begins.push_back(range.begin);
    }
    begins.push_back(static_cast<std::uint32_t>(boxes.size()));
    return begins;
}

}  // namespace pierce::detail
