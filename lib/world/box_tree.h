// A binary tree of boxes that changes in place: boxes are put in where they cost the least (surface area heuristic,
// Goldsmith and Salmon 1987), and subtrees are turned about on the way up where that makes boxes smaller (Kensler 2008,
// "Tree rotations for improving bounding volume hierarchies"). Walks read it four boxes at a time: each node has a copy
// of what is one to three levels below it, which is written again with the node on the way up.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <query/scene.h>

namespace pierce::detail {

/// Each box has a slack: how far beyond it in each coordinate it has to be taken for larger. A node's is the largest of
/// those below.
class BoxTree {
  public:
    static constexpr std::int32_t k_none = -1;

    struct Node {
        Point low;
        Point high;
        float slack;
        std::int32_t parent;
        std::int32_t left;   ///< `k_none` for a leaf; where it is free, the next free one
        std::int32_t right;  ///< of a leaf, its number

        [[nodiscard]] bool leaf() const { return left == k_none; }
    };
    static_assert(sizeof(Node) == 64);

    /// Up to four nodes that hold all that is below one which is no leaf, and their boxes, larger by their slack.
    struct Four {
        double bounds[6][4];    ///< low x, y, z, high x, y, z
        std::int32_t child[4];  ///< a node, or a leaf's number: `leaf_of`; those that are there come first
        std::int32_t count = 0;
    };
    [[nodiscard]] static bool is_leaf(std::int32_t child) { return child < k_none; }
    /// There and back.
    [[nodiscard]] static std::int32_t leaf_of(std::int32_t number) { return k_none - 1 - number; }

    /// Returns the leaf. `slack` is rounded up. Takes the time of a way down and up; may throw std::bad_alloc, and has
    /// changed nothing then.
    std::int32_t insert(const Box& box, double slack, std::uint32_t number);
    void remove(std::int32_t leaf) noexcept;
    /// As removing and inserting again: the leaf stays the same.
    void move(std::int32_t leaf, const Box& box, double slack) noexcept;

    [[nodiscard]] std::int32_t root() const { return root_; }
    [[nodiscard]] const Node& node(std::int32_t index) const { return nodes_[static_cast<std::size_t>(index)]; }
    /// Of a node that is no leaf.
    [[nodiscard]] const Four& four(std::int32_t index) const { return fours_[static_cast<std::size_t>(index) / 2]; }
    /// The most nodes on a way down. Looks at all of them.
    [[nodiscard]] std::size_t depth() const noexcept;
    [[nodiscard]] std::size_t bytes() const {
        return nodes_.capacity() * sizeof(Node) + fours_.capacity() * sizeof(Four);
    }

  private:
    [[nodiscard]] Node& at(std::int32_t index) { return nodes_[static_cast<std::size_t>(index)]; }
    enum Kind : std::size_t { k_leaf, k_joint };
    std::int32_t take_node(Kind kind);
    void give_back(std::int32_t index) noexcept;
    void put_in(std::int32_t leaf, std::int32_t joint) noexcept;
    std::int32_t take_out(std::int32_t leaf) noexcept;
    [[nodiscard]] std::int32_t best_sibling(const Node& leaf) const;
    void put_in_place_of(std::int32_t old, std::int32_t other, std::int32_t parent);
    void mend_upwards(std::int32_t index);
    void fit(std::int32_t index);
    std::int32_t rotate(std::int32_t index);
    void gather(std::int32_t index);

    std::vector<Node> nodes_;  ///< leaves at even places, joints at odd ones
    std::vector<Four> fours_;  ///< of joints
    std::int32_t root_ = k_none;
    std::array<std::int32_t, 2> free_{k_none, k_none};  ///< of each kind
};

}  // namespace pierce::detail
