// The grid lists every box in every cell it touches, and the walk misses none: against all boxes, judged in rational numbers.
#include <set>

#include <CGAL/Gmpq.h>

#include <gtest/gtest.h>
#include <grid/walk.h>
#include <support/random.h>

namespace pierce::test {
namespace {

using namespace detail;
using Q = CGAL::Gmpq;

/// Whether a segment and a closed box have a point in common, and from which fraction on: clipping in rational numbers.
bool meets(const Path& path, const Box& box, Q& enter) {
    enter = 0;
    Q leave = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const Q from = path.from[k];
        const Q d = Q(path.to[k]) - from;
        if (d == 0) {
            if (from < Q(box.low[k]) || from > Q(box.high[k])) return false;
            continue;
        }
        Q s0 = (Q(box.low[k]) - from) / d;
        Q s1 = (Q(box.high[k]) - from) / d;
        if (s0 > s1) std::swap(s0, s1);
        enter = std::max(enter, s0);
        leave = std::min(leave, s1);
    }
    return enter <= leave;
}

struct Scene {
    std::vector<Box> boxes;
    std::vector<std::uint32_t> numbers;
    void add(const Point& a, const Point& b) {
        Box box{};
        for (std::size_t k = 0; k < 3; ++k) {
            box.low[k] = std::min(a[k], b[k]);
            box.high[k] = std::max(a[k], b[k]);
        }
        boxes.push_back(box);
        numbers.push_back(static_cast<std::uint32_t>(boxes.size() - 1));
    }
};

// Boxes and segments on multiples of the cell size, or anywhere; segments along cell walls, through cell corners, of no length.
struct Maker {
    Random random;
    double scale;
    double offset;
    bool lattice;

    double coordinate(double reach) {
        double x = random.between(-reach, reach);
        if (lattice) x = std::round(x * 4) / 4;
        return scale * x + offset;
    }
    Point point(double reach) { return {coordinate(reach), coordinate(reach), coordinate(reach)}; }
};

void check_walks(Maker maker, const GridOptions& options, int boxes, int segments) {
    Scene scene;
    for (int i = 0; i < boxes; ++i) {
        const Point a = maker.point(1);
        Point b = a;
        for (double& x : b)
            if (maker.random.chance(0.8)) x += maker.scale * maker.random.between(0, 0.2);
        scene.add(a, b);
    }
    const Grid grid(scene.boxes, scene.numbers, options);
    std::size_t met = 0;
    for (int i = 0; i < segments; ++i) {
        Path path{maker.point(1.5), maker.point(1.5)};
        if (maker.random.chance(0.8)) {  // aimed at a corner of a box, often just reaching it
            const Box& box = scene.boxes[maker.random.below(scene.boxes.size())];
            const double beyond = maker.random.chance(0.5) ? 0 : maker.random.unit();
            for (std::size_t k = 0; k < 3; ++k) {
                const double corner = maker.random.chance(0.5) ? box.low[k] : box.high[k];
                path.to[k] = corner + beyond * (corner - path.from[k]);
            }
        }
        for (std::size_t k = 0; k < 3; ++k)
            if (maker.random.chance(0.2)) path.from[k] = path.to[k];
        if (maker.random.chance(0.1))
            for (double& x : path.from) x *= maker.random.chance(0.5) ? 1e6 : 1e-3;
        for (Point* end : {&path.from, &path.to})
            for (double& x : *end) x = std::clamp(x, -std::numeric_limits<double>::max(), std::numeric_limits<double>::max());
        const double limit = maker.random.chance(0.3) ? maker.random.unit() : 1;
        std::vector<int> seen(scene.boxes.size(), 0);
        std::vector<int> first(scene.boxes.size(), 0);
        walk(
            grid, path, [&] { return limit; },
            [&](std::size_t cell, const Visit& visit) {
                for (const std::uint32_t n : grid.list(cell)) {
                    ++seen[n];
                    if (visit.first_with(grid.shape().range(scene.boxes[n]))) {
                        ++first[n];
                        EXPECT_EQ(seen[n], 1) << "the first visit comes first";
                    }
                }
            });
        for (std::size_t n = 0; n < seen.size(); ++n) {
            EXPECT_EQ(first[n], seen[n] > 0 ? 1 : 0) << "segment " << i << " box " << n;
            Q enter;
            if (!meets(path, scene.boxes[n], enter) || enter > Q(limit)) continue;
            ++met;
            ASSERT_GT(seen[n], 0) << "segment " << i << " box " << n << " scale " << maker.scale << " offset "
                                  << maker.offset;
        }
    }
    EXPECT_GT(met, static_cast<std::size_t>(segments) / 4);
}

TEST(Walk, misses_no_box) {
    std::uint64_t seed = 0;
    for (bool lattice : {false, true})
        for (double scale : {1e-6, 1.0, 1e6})
            for (double offset : {0.0, 1e3, -1e6})
                for (const auto& cells : {std::array<std::uint32_t, 3>{0, 0, 0}, {8, 8, 8}, {31, 1, 17}, {100, 100, 100}})
                    check_walks({Random(++seed), scale, offset, lattice}, {cells, std::size_t{1} << 24}, 60, 150);
}

TEST(Walk, misses_no_box_at_the_ends_of_the_number_range) {
    for (double scale : {1e-310, 1e-300, 1e300, 5e307})
        check_walks({Random(7), scale, 0, false}, {{8, 8, 8}, std::size_t{1} << 20}, 40, 150);
}

TEST(Walk, goes_from_start_to_end_and_stops_at_the_limit) {
    Scene scene;
    for (int i = 0; i < 10; ++i) scene.add({double(i), 0, 0}, {i + 1.0, 1, 1});
    const Grid grid(scene.boxes, scene.numbers, {{10, 1, 1}, 1 << 20});
    for (bool backward : {false, true}) {
        Path path{{0.5, 0.5, 0.5}, {9.5, 0.5, 0.5}};
        if (backward) std::swap(path.from, path.to);
        std::vector<std::size_t> cells;
        walk(grid, path, [] { return 0.5; }, [&](std::size_t cell, const Visit&) { cells.push_back(cell); });
        // 0.5 is at x = 5: exactly on the wall between two cells, so that both may hold a hit at the limit.
        EXPECT_EQ(cells, backward ? (std::vector<std::size_t>{9, 8, 7, 6, 5, 4}) : (std::vector<std::size_t>{0, 1, 2, 3, 4, 5}));
    }
}

TEST(Walk, visits_few_cells) {
    // A short segment inside one cell reads that cell alone; a diagonal reads about three a slice.
    Scene scene;
    scene.add({0, 0, 0}, {100, 100, 100});
    const Grid grid(scene.boxes, scene.numbers, {{100, 100, 100}, std::size_t{1} << 26});
    const auto visited = [&](const Path& path) {
        int count = 0;
        walk(grid, path, [] { return 1.0; }, [&](std::size_t, const Visit&) { ++count; });
        return count;
    };
    EXPECT_EQ(visited({{10.2, 20.2, 30.2}, {10.8, 20.8, 30.8}}), 1);
    EXPECT_LE(visited({{0.3, 0.5, 0.7}, {99.3, 98.5, 99.7}}), 400);
}

TEST(Grid, keeps_to_its_memory) {
    Scene scene;
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
        const Vec3<double> p = random.in_cube();
        scene.add({p[0], p[1], p[2]}, {p[0] + 0.5, p[1] + 0.5, p[2] + 0.5});  // each box covers a good part of the grid
    }
    for (std::size_t most : {std::size_t{0}, std::size_t{5000}, std::size_t{20'000}, std::size_t{1} << 20}) {
        const Grid grid(scene.boxes, scene.numbers, {{0, 0, 0}, most});
        EXPECT_LE(grid.bytes(), std::max<std::size_t>(most, 4 * 1000 + 64));
        EXPECT_GE(grid.entry_count(), 1000U);
    }
    const Grid fine(scene.boxes, scene.numbers, {{1U << 20, 1U << 20, 1U << 20}, std::size_t{1} << 22});
    EXPECT_LE(fine.bytes(), std::size_t{1} << 22);
}

TEST(Grid, follows_the_shape_of_the_box) {
    const auto shape = [](const Point& size) {
        Scene scene;
        Random random(4);
        for (int i = 0; i < 1000; ++i) {
            Point p{};
            for (std::size_t k = 0; k < 3; ++k) p[k] = size[k] * random.unit();
            scene.add(p, p);
        }
        return Grid(scene.boxes, scene.numbers, {{0, 0, 0}, std::size_t{1} << 20}).shape().cells;
    };
    const auto cube = shape({1, 1, 1});
    EXPECT_NEAR(cube[0], 16, 2);
    EXPECT_EQ(cube[0], cube[1]);
    const auto flat = shape({10, 10, 0});
    EXPECT_NEAR(flat[0], 63, 3);
    EXPECT_EQ(flat[2], 1);
    const auto line = shape({0, 1e300, 1e-300});
    EXPECT_NEAR(line[1], 4000, 50);
    EXPECT_EQ(line[0] * line[2], 1);
    EXPECT_EQ(shape({0, 0, 0}), (std::array<int, 3>{1, 1, 1}));
}

}  // namespace
}  // namespace pierce::test
