// Changes of the tree of boxes. Areas that are infinite or NaN compare as false: the tree is worse then, not wrong.
#include <world/box_tree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pierce::detail {

namespace {

using Node = BoxTree::Node;

// Half of it. In halves of lengths no difference of numbers overflows.
double area_of(const Point& low, const Point& high) {
    const double x = high[0] / 2 - low[0] / 2;
    const double y = high[1] / 2 - low[1] / 2;
    const double z = high[2] / 2 - low[2] / 2;
    return x * y + y * z + z * x;
}
double area_of(const Node& node) { return area_of(node.low, node.high); }

double area_of_both(const Node& x, const Node& y) {
    Point low{};
    Point high{};
    for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(x.low[k], y.low[k]);
        high[k] = std::max(x.high[k], y.high[k]);
    }
    return area_of(low, high);
}

// What is beyond the floats is as good as infinite; so is NaN.
float rounded_up(double x) {
    constexpr float k_infinite = std::numeric_limits<float>::infinity();
    if (!(x < 0x1p126)) return k_infinite;
    const auto near = static_cast<float>(x);
    return static_cast<double>(near) >= x ? near : std::nextafter(near, k_infinite);
}

void set_leaf(Node& node, const Box& box, double slack) {
    node.low = box.low;
    node.high = box.high;
    node.slack = rounded_up(slack);
}

}  // namespace

// There is always a joint for each leaf but one: so where there is a place for a leaf, or one was made, there is one
// for its joint as well.
std::int32_t BoxTree::take_node(Kind kind) {
    if (free_[kind] == k_none) {
        fours_.resize(nodes_.size() / 2 + 1);
        nodes_.resize(nodes_.size() + 2);
        const auto last = static_cast<std::int32_t>(nodes_.size()) - 1;
        give_back(last - 1);
        give_back(last);
    }
    const std::int32_t index = free_[kind];
    free_[kind] = at(index).left;
    return index;
}

void BoxTree::give_back(std::int32_t index) noexcept {
    std::int32_t& first = free_[static_cast<std::size_t>(index) % 2];
    at(index).left = first;
    at(index).parent = k_none;
    first = index;
}

std::int32_t BoxTree::insert(const Box& box, double slack, std::uint32_t number) {
    const std::int32_t leaf = take_node(k_leaf);
    const std::int32_t joint = root_ != k_none ? take_node(k_joint) : k_none;
    set_leaf(at(leaf), box, slack);
    at(leaf).left = k_none;
    at(leaf).right = static_cast<std::int32_t>(number);
    put_in(leaf, joint);
    return leaf;
}

void BoxTree::remove(std::int32_t leaf) noexcept {
    const std::int32_t joint = take_out(leaf);
    if (joint != k_none) give_back(joint);
    give_back(leaf);
}

void BoxTree::move(std::int32_t leaf, const Box& box, double slack) noexcept {
    const std::int32_t joint = take_out(leaf);
    set_leaf(at(leaf), box, slack);
    put_in(leaf, joint);
}

// Where a new joint of a node and the leaf costs the least: its own area, and what the nodes above grow by. Goes down
// to the cheaper child as long as that may be cheaper than to stay.
std::int32_t BoxTree::best_sibling(const Node& leaf) const {
    std::int32_t index = root_;
    double grown = 0;
    while (!node(index).leaf()) {
        const Node& here = node(index);
        const double joined = area_of_both(here, leaf);
        const double stay = grown + joined;
        grown += joined - area_of(here);
        const auto below = [&](std::int32_t child) {
            const double both = area_of_both(node(child), leaf);
            return grown + (node(child).leaf() ? both : both - area_of(node(child)));
        };
        const double left = below(here.left);
        const double right = below(here.right);
        if (stay < left && stay < right) break;
        index = right < left ? here.right : here.left;
    }
    return index;
}

/// `joint`: a node to be used for the parent, if there is anything else.
void BoxTree::put_in(std::int32_t leaf, std::int32_t joint) noexcept {
    if (root_ == k_none) {
        root_ = leaf;
        at(leaf).parent = k_none;
        return;
    }
    const std::int32_t sibling = best_sibling(node(leaf));
    const std::int32_t parent = node(sibling).parent;
    put_in_place_of(sibling, joint, parent);
    at(joint).left = sibling;
    at(joint).right = leaf;
    at(sibling).parent = joint;
    at(leaf).parent = joint;
    mend_upwards(joint);
}

/// Returns the parent, which is out as well; none if the leaf was all.
std::int32_t BoxTree::take_out(std::int32_t leaf) noexcept {
    const std::int32_t joint = node(leaf).parent;
    if (joint == k_none) {
        root_ = k_none;
        return k_none;
    }
    const std::int32_t sibling = node(joint).left == leaf ? node(joint).right : node(joint).left;
    const std::int32_t parent = node(joint).parent;
    put_in_place_of(joint, sibling, parent);
    mend_upwards(parent);
    return joint;
}

void BoxTree::put_in_place_of(std::int32_t old, std::int32_t other, std::int32_t parent) {
    at(other).parent = parent;
    if (parent == k_none)
        root_ = other;
    else if (node(parent).left == old)
        at(parent).left = other;
    else
        at(parent).right = other;
}

void BoxTree::mend_upwards(std::int32_t index) {
    for (; index != k_none; index = node(index).parent) {
        fit(index);
        if (const std::int32_t changed = rotate(index); changed != k_none) gather(changed);
        gather(index);
    }
}

void BoxTree::fit(std::int32_t index) {
    Node& here = at(index);
    const Node& left = node(here.left);
    const Node& right = node(here.right);
    for (std::size_t k = 0; k < 3; ++k) {
        here.low[k] = std::min(left.low[k], right.low[k]);
        here.high[k] = std::max(left.high[k], right.high[k]);
    }
    here.slack = std::max(left.slack, right.slack);
}

// Of the four ways to swap a child with a child of the other one, the one that takes most off the other's area. Returns
// the other, if any.
std::int32_t BoxTree::rotate(std::int32_t index) {
    const Node& here = node(index);
    double most = 0;
    std::int32_t child = k_none;
    std::int32_t grandchild = k_none;
    for (const auto& [one, other] : {std::pair{here.left, here.right}, {here.right, here.left}}) {
        if (node(other).leaf()) continue;
        const Node& joint = node(other);
        for (const auto& [out, stays] : {std::pair{joint.left, joint.right}, {joint.right, joint.left}}) {
            const double less = area_of(joint) - area_of_both(node(one), node(stays));
            if (!(less > most)) continue;
            most = less;
            child = one;
            grandchild = out;
        }
    }
    if (child == k_none) return k_none;
    const std::int32_t joint = node(grandchild).parent;
    put_in_place_of(child, grandchild, index);
    put_in_place_of(grandchild, child, joint);
    fit(joint);
    return joint;
}

// Of the nodes so far the largest that is no leaf gives way to its children, as long as there is room: what is met most
// often is then told apart.
void BoxTree::gather(std::int32_t index) {
    Four& four = fours_[static_cast<std::size_t>(index) / 2];
    std::array<std::int32_t, 4> nodes{node(index).left, node(index).right};
    std::size_t count = 2;
    for (; count < nodes.size(); ++count) {
        std::size_t largest = count;
        double most = -1;
        for (std::size_t i = 0; i < count; ++i) {
            const double area = node(nodes[i]).leaf() ? -2 : area_of(node(nodes[i]));
            if (area <= most) continue;  // one that is NaN is opened
            most = area;
            largest = i;
        }
        if (largest == count || node(nodes[largest]).leaf()) break;
        const Node& opened = node(nodes[largest]);
        nodes[count] = opened.right;
        nodes[largest] = opened.left;
    }
    four.count = static_cast<std::int32_t>(count);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const bool there = i < count;
        const Node& below = node(there ? nodes[i] : nodes[0]);
        four.child[i] = !there ? k_none : below.leaf() ? leaf_of(below.right) : nodes[i];
        for (std::size_t k = 0; k < 3; ++k) {
            four.bounds[k][i] = below.low[k] - static_cast<double>(below.slack);
            four.bounds[3 + k][i] = below.high[k] + static_cast<double>(below.slack);
        }
    }
}

std::size_t BoxTree::depth() const noexcept {
    std::size_t most = 0;
    if (root_ == k_none) return most;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {  // those that are free have no parent
        std::size_t count = 1;
        for (auto index = static_cast<std::int32_t>(i); node(index).parent != k_none; index = node(index).parent)
            ++count;
        most = std::max(most, count);
    }
    return most;
}

}  // namespace pierce::detail
