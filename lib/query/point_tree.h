// A tree over points by halves, for the question which of them lie near a segment: a box of a node is entered only if the widened segment
// itself meets it, so a long edge through many points looks at those beside it and not at all in its box.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <point.h>

namespace pierce::detail {

class PointTree {
  public:
    /// `positions` must live as long. Takes n log n steps, whatever the distribution: it halves by rank, not by place.
    PointTree(std::span<const Point> positions, std::vector<std::uint32_t> vertices)
        : positions_(positions), vertices_(std::move(vertices)) {
        if (!vertices_.empty()) build(0, vertices_.size());
    }

    /// Calls visit(vertex) for all vertices within `slack` of the segment in each coordinate, and some more. `slack` is at least 8 units in the
    /// last place of the largest coordinate of both ends (or 0 where these are denormal), of which the arithmetic here takes half.
    template <class Visit>
    void visit_near(const Point& from, const Point& to, double slack, Visit&& visit) const {
        if (nodes_.empty()) return;
        const Line line(from, to, slack);
        std::array<std::uint32_t, 64> stack{};  // the tree is at most 32 deep
        std::size_t top = 0;
        stack[top++] = 0;
        while (top > 0) {
            const Node& node = nodes_[stack[--top]];
            if (line.misses(node.low, node.high)) continue;
            if (node.right != 0) {
                stack[top++] = node.right;
                stack[top++] = static_cast<std::uint32_t>(&node - nodes_.data()) + 1;
                continue;
            }
            for (std::uint32_t i = node.begin; i < node.end; ++i) visit(vertices_[i]);
        }
    }

  private:
    struct Node {
        Point low;
        Point high;
        std::uint32_t begin;
        std::uint32_t end;
        std::uint32_t right;  ///< the left child is next; 0 for a leaf
    };
    static constexpr std::size_t k_leaf = 4;

    // The places t of the segment within the slab of each coordinate, cut with one another. A bound t is off by what moves the point by 4 units in
    // the last place of its coordinates at most: a subtraction of two, a product, a quotient.
    struct Line {
        Line(const Point& from, const Point& to, double widened) : start(from) {
            double most = 0;
            for (std::size_t k = 0; k < 3; ++k) most = std::max({most, std::abs(from[k]), std::abs(to[k])});
            scale = most > 0x1p1020 ? 0x1p-3 : 1;  // against overflow of the differences
            slack = scale * widened;
            for (std::size_t k = 0; k < 3; ++k) direction[k] = scale * to[k] - scale * from[k];
        }
        [[nodiscard]] bool misses(const Point& low, const Point& high) const {
            double first = 0;
            double last = 1;
            for (std::size_t k = 0; k < 3; ++k) {
                const double below = (scale * low[k] - scale * start[k]) - slack;
                const double above = (scale * high[k] - scale * start[k]) + slack;
                if (direction[k] == 0) {
                    if (below > 0 || above < 0) return true;
                    continue;
                }
                const double s = below / direction[k];
                const double t = above / direction[k];
                first = std::max(first, std::min(s, t));
                last = std::min(last, std::max(s, t));
            }
            return first > last * (1 + 0x1p-50);
        }
        Point start;
        Point direction{};
        double scale = 1;
        double slack = 0;
    };

    std::uint32_t build(std::size_t begin, std::size_t end) {
        const auto number = static_cast<std::uint32_t>(nodes_.size());
        Node node{positions_[vertices_[begin]], positions_[vertices_[begin]], static_cast<std::uint32_t>(begin),
                  static_cast<std::uint32_t>(end), 0};
        for (std::size_t i = begin; i < end; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                node.low[k] = std::min(node.low[k], positions_[vertices_[i]][k]);
                node.high[k] = std::max(node.high[k], positions_[vertices_[i]][k]);
            }
        nodes_.push_back(node);
        if (end - begin <= k_leaf) return number;
        std::size_t axis = 0;
        const auto extent = [&node](std::size_t k) { return node.high[k] / 2 - node.low[k] / 2; };
        for (std::size_t k = 1; k < 3; ++k)
            if (extent(k) > extent(axis)) axis = k;
        const std::size_t middle = begin + (end - begin) / 2;
        const auto at = [this](std::size_t i) { return vertices_.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(begin), at(middle), at(end),
                         [&](std::uint32_t x, std::uint32_t y) { return positions_[x][axis] < positions_[y][axis]; });
        build(begin, middle);
        const std::uint32_t right = build(middle, end);
        nodes_[number].right = right;
        return number;
    }

    std::span<const Point> positions_;
    std::vector<std::uint32_t> vertices_;
    std::vector<Node> nodes_;
};

}  // namespace pierce::detail
