// A tree over points, for the question which of them lie near a segment: a node is entered only if the widened segment
// itself meets its box, so a long edge through many points looks at those beside it and not at all in its box.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include <point.h>

namespace pierce::detail {

class PointTree {
  public:
    /// `positions` must live as long. Takes n log n steps, whatever the distribution: it divides by rank, not by place.
    PointTree(std::span<const Point> positions, std::vector<std::uint32_t> vertices)
        : positions_(positions), vertices_(std::move(vertices)) {
        if (!vertices_.empty()) build(0, vertices_.size());
    }

    /// Calls visit(vertex) for all vertices within `slack` times the largest coordinate of the segment from it in each
    /// coordinate, and some more. `slack` is at least 8 units in the last place of 1; the arithmetic here takes half of
    /// it. Returns the boxes looked at, those of points included.
    template <class Visit>
    std::size_t visit_near(const Point& from, const Point& to, double slack, Visit&& visit) const {
        if (nodes_.empty()) return 0;
        const Line line(from, to, slack);
        std::size_t boxes = 0;
        std::array<std::uint32_t, 64> stack{};  // the tree is at most 16 deep
        std::size_t top = 0;
        stack[top++] = 0;
        while (top > 0) {
            const Node& node = nodes_[stack[--top]];
            const std::array<double, k_width> excess = line.excess(node);
            boxes += node.count;
            // Without a branch for each child, as nobody could predict them.
            const std::size_t bottom = top;
            for (std::uint32_t i = 0; i < node.count; ++i) {
                stack[top] = node.child[i];
                top += excess[i] > 0 ? std::size_t{0} : std::size_t{1};
            }
            if (!node.is_leaf) continue;
            while (top > bottom) visit(stack[--top]);
        }
        return boxes;
    }

  private:
    static constexpr std::size_t k_width = 4;
    using Row = std::array<double, k_width>;
    /// Up to four nodes, or points.
    struct Node {
        std::array<Row, 3> low;  ///< in each coordinate, of each child
        std::array<Row, 3> high;
        std::array<std::uint32_t, k_width> child;
        std::uint32_t count;
        bool is_leaf;
    };

    typedef double Pair __attribute__((vector_size(16)));  // as wide as every processor has it

    // The places t of the segment within the slab of each coordinate, cut with one another. A bound t is off by what
    // moves the point by 4 units in the last place of the largest coordinate at most: a subtraction of two, a quotient,
    // a product.
    struct Line {
        Line(const Point& from, const Point& to, double relative) {
            double largest = 0;
            for (std::size_t k = 0; k < 3; ++k) largest = std::max({largest, std::abs(from[k]), std::abs(to[k])});
            // Against overflow of the differences, and so that neither the slack nor k_least is lost among small
            // numbers.
            scale = largest > 0x1p1020 ? 0x1p-3 : largest < 0x1p-500 ? 0x1p500 : 1;
            slack = relative * (scale * largest);
            for (std::size_t k = 0; k < 3; ++k) {
                start[k] = scale * from[k];
                // A direction below k_least, zero included, is taken for k_least: the slack is more by far.
                const double direction = scale * to[k] - start[k];
                inverse[k] = 1 / (std::abs(direction) < k_least ? k_least : direction);
            }
        }
        /// Of each child: how much further the segment's first place in its box is than the last one, not positive if
        /// it has one.
        [[nodiscard]] Row excess(const Node& node) const {
            Row row;
            for (std::size_t i = 0; i < k_width; i += 2) {
                Pair first = {};
                Pair last = {1, 1};
                for (std::size_t k = 0; k < 3; ++k) {
                    Pair low;
                    Pair high;
                    std::memcpy(&low, &node.low[k][i], sizeof low);
                    std::memcpy(&high, &node.high[k][i], sizeof high);
                    const Pair s = ((scale * low - start[k]) - slack) * inverse[k];
                    const Pair t = ((scale * high - start[k]) + slack) * inverse[k];
                    const Pair from = s < t ? s : t;
                    const Pair to = s > t ? s : t;
                    first = from > first ? from : first;
                    last = to < last ? to : last;
                }
                first -= last * (1 + 0x1p-50);
                std::memcpy(&row[i], &first, sizeof first);
            }
            return row;
        }
        static constexpr double k_least = 0x1p-700;
        Point start{};
        Point inverse{};
        double scale = 1;
        double slack = 0;
    };

    // Whole children of a power of four points, but for the last one: no node has fewer than it could.
    std::uint32_t build(std::size_t begin, std::size_t end) {
        const auto number = static_cast<std::uint32_t>(nodes_.size());
        std::size_t size = 1;  // of a child
        while (size * k_width < end - begin) size *= k_width;
        nodes_.push_back({});
        divide(begin, end, size);
        Node node{};
        node.is_leaf = size == 1;
        for (std::size_t from = begin; from < end; from += size) {
            const std::size_t to = std::min(end, from + size);
            const std::uint32_t i = node.count++;
            const auto [low, high] = box_of_range(from, to);
            for (std::size_t k = 0; k < 3; ++k) {
                node.low[k][i] = low[k];
                node.high[k][i] = high[k];
            }
            node.child[i] = size == 1 ? vertices_[from] : build(from, to);
        }
        nodes_[number] = node;
        return number;
    }

    // Orders the range so that each part of `size` lies together in space: by halves, across the longest side.
    void divide(std::size_t begin, std::size_t end, std::size_t size) {
        const std::size_t parts = (end - begin + size - 1) / size;
        if (parts < 2 || size == 1) return;
        const auto [low, high] = box_of_range(begin, end);
        std::size_t axis = 0;
        const auto extent = [&low = low, &high = high](std::size_t k) { return high[k] / 2 - low[k] / 2; };
        for (std::size_t k = 1; k < 3; ++k)
            if (extent(k) > extent(axis)) axis = k;
        const std::size_t middle = begin + parts / 2 * size;
        const auto at = [this](std::size_t i) { return vertices_.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(begin), at(middle), at(end),
                         [&](std::uint32_t x, std::uint32_t y) { return positions_[x][axis] < positions_[y][axis]; });
        divide(begin, middle, size);
        divide(middle, end, size);
    }

    [[nodiscard]] std::pair<Point, Point> box_of_range(std::size_t begin, std::size_t end) const {
        Point low = positions_[vertices_[begin]];
        Point high = low;
        for (std::size_t i = begin + 1; i < end; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                low[k] = std::min(low[k], positions_[vertices_[i]][k]);
                high[k] = std::max(high[k], positions_[vertices_[i]][k]);
            }
        return {low, high};
    }

    std::span<const Point> positions_;
    std::vector<std::uint32_t> vertices_;
    std::vector<Node> nodes_;
};

}  // namespace pierce::detail
