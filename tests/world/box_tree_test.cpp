// The tree of boxes, by itself: it lists what a way comes to, whatever was put in and taken out before.
#include <cmath>
#include <set>

#include <gtest/gtest.h>
#include <support/random.h>
#include <world/box_walk.h>

namespace pierce::detail {
namespace {

using test::Random;

struct Boxes {
    BoxTree tree;
    struct Entry {
        std::int32_t leaf;
        std::uint32_t number;
        Box box;
    };
    std::vector<Entry> entries;

    void add(const Box& box, std::uint32_t number) { entries.push_back({tree.insert(box, 0, number), number, box}); }
};

Point point_of(const Vec3<double>& v) { return {v[0], v[1], v[2]}; }

Box box_around(const Vec3<double>& middle, const Vec3<double>& half) {
    return {point_of(middle - half.cwiseAbs()), point_of(middle + half.cwiseAbs())};
}

// Exactly enough for numbers that are far from all boundaries: dense points on the way.
bool certainly_meets(const Path& path, const Box& box) {
    for (int i = 0; i <= 64; ++i) {
        bool in = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const double x = path.from[k] + i / 64.0 * (path.to[k] - path.from[k]);
            in = in && x >= box.low[k] && x <= box.high[k];
        }
        if (in) return true;
    }
    return false;
}

std::set<std::uint32_t> listed(const BoxTree& tree, const Path& path, double limit = 1) {
    std::set<std::uint32_t> out;
    QueryCounters counters;
    each_box(tree, BoxProbe(path, 0), limit, counters, [&](std::uint32_t number, double so_far) {
        EXPECT_TRUE(out.insert(number).second) << "no box comes twice";
        return so_far;
    });
    return out;
}

// Of a node below the root: its parent's, and its box is in that one's.
void check(const BoxTree& tree, std::int32_t index, std::set<std::uint32_t>& numbers) {
    const BoxTree::Node& node = tree.node(index);
    if (node.leaf()) {
        EXPECT_TRUE(numbers.insert(static_cast<std::uint32_t>(node.right)).second);
        return;
    }
    for (const std::int32_t child : {node.left, node.right}) {
        EXPECT_EQ(tree.node(child).parent, index);
        EXPECT_LE(tree.node(child).slack, node.slack);
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_GE(tree.node(child).low[k], node.low[k]);
            EXPECT_LE(tree.node(child).high[k], node.high[k]);
        }
        check(tree, child, numbers);
    }
}

TEST(BoxTree, holds_what_was_put_in_and_lists_what_is_met) {
    Random random(1);
    Boxes boxes;
    std::uint32_t next = 0;
    std::size_t met = 0;
    for (int round = 0; round < 4000; ++round) {
        const double what = random.unit();
        const Vec3<double> middle = 10 * random.in_cube();
        const Vec3<double> half = std::exp(random.between(-4, 1)) * random.in_cube();
        const Box box = box_around(middle, half);
        if (what < 0.5 || boxes.entries.empty()) {
            boxes.add(box, next++);
        } else {
            auto& entry = boxes.entries[random.below(boxes.entries.size())];
            if (what < 0.75) {
                entry.box = box;
                boxes.tree.move(entry.leaf, box, 0);
            } else {
                boxes.tree.remove(entry.leaf);
                entry = boxes.entries.back();
                boxes.entries.pop_back();
            }
        }
        if (round % 50 == 0) {
            std::set<std::uint32_t> numbers;
            if (boxes.tree.root() != BoxTree::k_none) check(boxes.tree, boxes.tree.root(), numbers);
            ASSERT_EQ(numbers.size(), boxes.entries.size());
        }
        const Path path{point_of(12 * random.in_cube()), point_of(12 * random.in_cube())};
        const std::set<std::uint32_t> found = listed(boxes.tree, path);
        for (const auto& entry : boxes.entries)
            if (certainly_meets(path, entry.box)) {
                ++met;
                EXPECT_TRUE(found.contains(entry.number));
            }
    }
    EXPECT_GT(met, 1000U);
    EXPECT_LT(boxes.tree.depth(), 40U) << "of " << boxes.entries.size();
    while (!boxes.entries.empty()) {
        boxes.tree.remove(boxes.entries.back().leaf);
        boxes.entries.pop_back();
    }
    EXPECT_EQ(boxes.tree.root(), BoxTree::k_none);
    EXPECT_EQ(boxes.tree.depth(), 0U);
}

// Boxes that lie in one another make a tree as deep as they are many: deeper than the stack of a walk.
TEST(BoxTree, lists_all_of_a_tree_that_is_deeper_than_the_stack) {
    Boxes boxes;
    for (std::uint32_t i = 0; i < 400; ++i) {
        const double size = std::ldexp(1.0, static_cast<int>(i));
        boxes.add({{size, size, size}, {1.5 * size, 1.5 * size, 1.5 * size}}, i);
    }
    std::cout << "depth " << boxes.tree.depth() << '\n';
    EXPECT_GT(boxes.tree.depth(), 100U);
    const double end = std::ldexp(1.0, 401);
    EXPECT_EQ(listed(boxes.tree, {{0, 0, 0}, {end, end, end}}).size(), 400U);
    EXPECT_EQ(listed(boxes.tree, {{end, end, end}, {0, 0, 0}}).size(), 400U);
    // And stops where it is told to, wherever that is.
    for (std::size_t after = 1; after < 400; after += 37) {
        std::size_t count = 0;
        QueryCounters counters;
        each_box(boxes.tree, BoxProbe({{end, end, end}, {0, 0, 0}}, 0), 1, counters,
                 [&](std::uint32_t, double) { return ++count == after ? -1.0 : 1.0; });
        EXPECT_EQ(count, after);
    }
}

TEST(BoxTree, stays_shallow_where_boxes_come_in_order) {
    Boxes boxes;
    for (std::uint32_t i = 0; i < 4096; ++i) boxes.add({{double(i), 0, 0}, {i + 0.9, 1, 1}}, i);
    std::cout << "depth " << boxes.tree.depth() << " of 4096 in a row\n";
    EXPECT_LE(boxes.tree.depth(), 48U);
    QueryCounters counters;
    std::size_t count = 0;
    each_box(boxes.tree, BoxProbe({{2000.5, 0.5, -1}, {2000.5, 0.5, 2}}, 0), 1, counters, [&](std::uint32_t, double) {
        ++count;
        return 1.0;
    });
    EXPECT_EQ(count, 1U);
    EXPECT_LE(counters.nodes, 100U);
}

TEST(BoxTree, prunes_by_the_limit) {
    Boxes boxes;
    for (std::uint32_t i = 0; i < 100; ++i) boxes.add({{double(i), 0, 0}, {i + 0.5, 1, 1}}, i);
    const Path path{{-10, 0.5, 0.5}, {110, 0.5, 0.5}};
    EXPECT_EQ(listed(boxes.tree, path).size(), 100U);
    EXPECT_EQ(listed(boxes.tree, path, 0.5).size(), 51U) << "up to 50, where one begins";
    EXPECT_EQ(listed(boxes.tree, path, -1).size(), 0U);
}

// Ends that no number lies between, boxes without end, and boxes of no size: none is lost.
TEST(BoxTree, total_over_all_numbers) {
    constexpr double k_infinite = std::numeric_limits<double>::infinity();
    constexpr double k_most = std::numeric_limits<double>::max();
    Boxes boxes;
    boxes.add({{-k_infinite, -k_infinite, -k_infinite}, {k_infinite, k_infinite, k_infinite}}, 0);
    boxes.add({{-k_most, -1, -1}, {k_most, 1, 1}}, 1);
    boxes.add({{0, 0, 0}, {0, 0, 0}}, 2);
    boxes.add({{0x1p-1074, 0x1p-1074, 0x1p-1074}, {0x1p-1073, 0x1p-1073, 0x1p-1073}}, 3);
    using Numbers = std::set<std::uint32_t>;
    EXPECT_EQ(listed(boxes.tree, {{0, 0, 0}, {0, 0, 0}}), (Numbers{0, 1, 2, 3}));
    EXPECT_EQ(listed(boxes.tree, {{-k_most, 0, 0}, {k_most, 0, 0}}), (Numbers{0, 1, 2, 3}));
    EXPECT_EQ(listed(boxes.tree, {{-k_most, -k_most, -k_most}, {k_most, k_most, k_most}}), (Numbers{0, 1, 2, 3}));
    EXPECT_EQ(listed(boxes.tree, {{1, 1, 1}, {2, 2, 2}}), (Numbers{0, 1}));
    EXPECT_EQ(listed(boxes.tree, {{0, 2, 0}, {0x1p-1074, 2, 0}}), (Numbers{0}));
}

}  // namespace
}  // namespace pierce::detail
