// The uniform grid misses no cluster that a segment comes within the noise of, and shows none twice: against all boxes,
// in rational numbers.
#include <grid/uniform_grid_cases.h>
#include <gtest/gtest.h>
#include <support/executors.h>

namespace pierce::test {
namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();
constexpr double k_infinity = std::numeric_limits<double>::infinity();

/// A first hit as a query would look for it: of each box in sight the fraction at which it is met, rounded up.
template <class Scalar>
void expect_nearest(const UniformGrid& grid, const Boxes<Scalar>& boxes, const Frame& frame, const Segment& s) {
    double last = s.limit;
    const Found found = find(grid, boxes.size(), s, [&](std::size_t i, double limit) {
        EXPECT_EQ(limit, last);
        Q enter;
        if (meets(s, boxes[i], frame, enter)) last = std::min(last, std::nextafter(CGAL::to_double(enter), 2));
        return last;
    });
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        Q enter;
        const bool wanted = meets(s, boxes[i], frame, enter) && enter <= Q(last);
        ASSERT_LE(found.times[i], 1) << text(s);
        ASSERT_TRUE(!wanted || found.times[i] == 1) << text(s);
    }
}

template <class Scalar>
void expect_complete(Kind kind, const Frame& frame, std::uint64_t seed, int rounds) {
    Random random(seed);
    for (int round = 0; round < rounds; ++round) {
        const Boxes<Scalar> boxes = boxes_of<Scalar>(kind, 1 + random.below(60), frame, random);
        const double sizes[] = {0.1, 0.1, 0, 0.03, 1e-3, 0.8, k_infinity};
        const UniformGrid grid =
            grid_of(boxes, frame, sizes[random.below(7)], std::size_t{1} << random.between_ints(10, 20));
        for (int i = 0; i < 150; ++i) {
            const Segment s = segment_for(boxes, frame, grid.cell_size(), random);
            const Found found = find(grid, boxes.size(), s);
            for (std::size_t b = 0; b < boxes.size(); ++b) {
                Q enter;
                ASSERT_LE(found.times[b], 1) << text(s) << "round " << round << " box " << b;
                const bool missed = found.times[b] == 0 && meets(s, boxes[b], frame, enter);
                ASSERT_FALSE(missed) << text(s) << "round " << round << " box " << b;
            }
            if (i % 4 == 0) expect_nearest(grid, boxes, frame, s);
            if (testing::Test::HasFatalFailure()) return;
        }
    }
}

Frame frame_at(double x, double y, double z) {
    Frame frame;
    const Triple low = {x, y, z};
    for (std::size_t k = 0; k < 3; ++k) {
        frame.low[k] = low[k];
        frame.high[k] = low[k] + 1.6;
    }
    return frame;
}

TEST(UniformGrid, misses_nothing_and_shows_nothing_twice) {
    std::uint64_t seed = 1;
    for (const Kind kind : k_kinds) {
        SCOPED_TRACE(static_cast<int>(kind));
        expect_complete<double>(kind, frame_at(0, 0, 0), ++seed, 40);
        expect_complete<double>(kind, frame_at(-0.7, 3.3, 1000.1), ++seed, 40);
        expect_complete<float>(kind, frame_at(-0.7, 0.1, 50), ++seed, 40);
        if (HasFatalFailure()) return;
    }
}

// Points in walls of cells, and lines that meet them with no room: roundings that the margin leaves out are seen.
TEST(UniformGrid, keeps_to_its_margin_in_corners) {
    Random random(77);
    for (int round = 0; round < 3000; ++round) {
        const Frame frame = frame_at(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
        const double size = random.between(0.05, 0.3);
        Boxes<double> boxes(3);  // the first two say where the cells begin and end
        for (std::size_t i = 0; i < 3; ++i) {
            boxes[i].ref = cluster_ref(static_cast<std::uint32_t>(i), 1);
            for (std::size_t k = 0; k < 3; ++k) {
                const double x[] = {0, 1.6, random.between_ints(0, static_cast<int>(1.5 / size)) * size};
                boxes[i].low[k] = boxes[i].high[k] = frame.low[k] + x[i];
            }
        }
        const UniformGrid grid = grid_of(boxes, frame, size, std::size_t{1} << 20);
        ASSERT_EQ(grid.cell_size(), size);
        for (int i = 0; i < 20; ++i) {
            Segment s;
            for (std::size_t k = 0; k < 3; ++k) {
                s.direction[k] = short_number(random.between(-20, 20));
                s.origin[k] = boxes[2].low[k] - frame.low[k] - 0.5 * s.direction[k];
            }
            Q enter;
            const Found found = find(grid, 3, s);
            ASSERT_GE(found.times[2], meets(s, boxes[2], frame, enter) ? 1 : 0) << text(s);
        }
    }
}

TEST(UniformGrid, looks_at_few_cells_and_stops_early) {
    Random random(5);
    const Frame frame = frame_at(0, 0, 0);
    const Boxes<double> boxes = boxes_of<double>(Kind::sphere, 3000, frame, random);
    const UniformGrid grid = grid_of(boxes, frame, 0.05, std::size_t{1} << 24);
    std::size_t all = 0;
    std::size_t half = 0;
    for (int i = 0; i < 300; ++i) {
        Segment s = segment_for(boxes, frame, 0.05, random);
        s.noise = 0;
        s.limit = 1;
        const Found found = find(grid, boxes.size(), s);
        EXPECT_LE(found.cells, 9 * 34U);
        EXPECT_LT(found.visits, boxes.size() / 4);
        all += found.visits;
        s.limit = 0.25;
        half += find(grid, boxes.size(), s).visits;
        std::size_t calls = 0;
        find(grid, boxes.size(), s, [&](std::size_t, double) { return ++calls, -1.0; });
        EXPECT_LE(calls, 1U);
        s.limit = -1;
        EXPECT_EQ(find(grid, boxes.size(), s).cells, 0U);
    }
    EXPECT_LT(half, all * 2 / 3);
    // Nearest first: the wall that is met at 0.1 hides the other one.
    const Segment through{{-0.1, 0.8, 0.8}, {2, 0.01, 0.01}, 0, 1};
    const Found front =
        find(grid, boxes.size(), through, [](std::size_t, double limit) { return std::min(limit, 0.3); });
    EXPECT_GT(front.visits, 0U);
    EXPECT_LT(front.cells * 2, find(grid, boxes.size(), through).cells);
}

TEST(UniformGrid, is_safe_with_nan_and_infinity) {
    Random random(6);
    const Frame frame = frame_at(0, 0, 0);
    const Boxes<float> boxes = boxes_of<float>(Kind::sphere, 2000, frame, random);
    const UniformGrid grid = grid_of(boxes, frame);
    const Segment good{{0.1, 0.2, 0.3}, {0.9, 0.8, 1}, 0.05, 1};
    const Found usual = find(grid, boxes.size(), good);
    ASSERT_GT(usual.visits, 10U);
    ASSERT_LT(usual.visits, 1000U);
    for (std::size_t where = 0; where < 8; ++where) {
        Segment s = good;
        if (where < 3) s.origin[where] = k_nan;
        if (where >= 3 && where < 6) s.direction[where - 3] = k_nan;
        if (where == 6) s.noise = k_nan;
        if (where == 7) s.noise = k_infinity;
        const Found found = find(grid, boxes.size(), s);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            EXPECT_LE(found.times[i], 1) << where;
            Q enter;  // (other clusters in cells near by depend on the axis that is walked along)
            EXPECT_GE(found.times[i], meets(good, boxes[i], frame, enter) ? 1 : 0) << where;
            EXPECT_GE(found.times[i], where >= 6 ? 1 : 0) << where;
        }
    }
    Segment s = good;
    s.limit = k_nan;
    EXPECT_EQ(find(grid, boxes.size(), s).times, usual.times);
    EXPECT_EQ(find(grid, boxes.size(), good, [](std::size_t, double) { return k_nan; }).times, usual.times);
    EXPECT_EQ(find(grid, boxes.size(), good, [](std::size_t, double) { return 7.0; }).times, usual.times);
    s.direction = {5e-324, -5e-324, 0};
    EXPECT_GT(find(grid, boxes.size(), {{0.8, 0.8, 0.1}, s.direction, 0.1, 1}).visits, 0U);
}

TEST(UniformGrid, keeps_to_its_memory) {
    Random random(7);
    const Frame frame = frame_at(0, 0, 0);
    for (const Kind kind : k_kinds) {
        const Boxes<double> boxes = boxes_of<double>(kind, 20000, frame, random);
        for (const double cell : {0.0, 1e-9, 0.02, 0.5, k_infinity, k_nan, -1.0}) {
            const UniformGrid usual = grid_of(boxes, frame, cell);
            EXPECT_LE(usual.bytes(), std::max(UniformGrid::k_least_bytes, UniformGrid::k_bytes * boxes.size()));
            EXPECT_LE(grid_of(boxes, frame, cell, 500000).bytes(), 500000U);
            EXPECT_GE(usual.reference_count(), boxes.size());
            const UniformGrid least = grid_of(boxes, frame, cell, 1);
            EXPECT_EQ(least.cell_count(), 1U);
            EXPECT_LE(least.bytes(), 20 * boxes.size() + 8);
        }
        if (kind == Kind::one || kind == Kind::same) continue;
        EXPECT_NEAR(grid_of(boxes, frame, 0.21, std::size_t{1} << 30).cell_size(), 0.21, 1e-15);
        // Large boxes, or many references.
        const bool few = kind == Kind::line || kind == Kind::lattice || kind == Kind::scattered;
        EXPECT_GT(grid_of(boxes, frame, 0, std::size_t{1} << 20).cell_count(), few ? 40U : 500U);
    }
    EXPECT_EQ(grid_of(Boxes<double>(), frame).bytes(), 0U);
    EXPECT_EQ(find(grid_of(Boxes<double>(), frame), 0, {{0, 0, 0}, {1, 1, 1}, 1, 1}).cells, 0U);
}

TEST(UniformGrid, is_the_same_for_any_executor) {
    Random random(8);
    const Frame frame = frame_at(0.3, -0.1, 0.7);
    for (const Kind kind : {Kind::sphere, Kind::scattered, Kind::same}) {
        const Boxes<float> boxes = boxes_of<float>(kind, 30000, frame, random);
        const UniformGrid plain = grid_of(boxes, frame);
        const Threads threads;
        const Reversed reversed;
        const UniformGrid others[] = {grid_of(boxes, frame, 0, 0, threads), grid_of(boxes, frame, 0, 0, reversed)};
        for (const UniformGrid& other : others) {
            EXPECT_EQ(other.cell_size(), plain.cell_size());
            EXPECT_EQ(other.bytes(), plain.bytes());
            for (int i = 0; i < 100; ++i) {
                const Segment s = segment_for(boxes, frame, plain.cell_size(), random);
                std::vector<std::size_t> order;
                std::vector<std::size_t> other_order;
                find(plain, boxes.size(), s, [&](std::size_t b, double limit) { return order.push_back(b), limit; });
                find(other, boxes.size(), s,
                     [&](std::size_t b, double limit) { return other_order.push_back(b), limit; });
                ASSERT_EQ(order, other_order);
            }
        }
    }
}

}  // namespace
}  // namespace pierce::test
