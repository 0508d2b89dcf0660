// The grid lists every box in every cell it comes near, and neither the block of a short segment nor the walk of a long one misses any:
// against all boxes, judged in rational numbers.
#include <CGAL/Gmpq.h>

#include <gtest/gtest.h>
#include <grid/grid.h>
#include <kernel/backends.h>
#include <support/random.h>

namespace pierce::test {
namespace {

using namespace detail;
using Q = CGAL::Gmpq;
using Boxes = std::vector<PlainBox<double>>;

/// Whether a segment and a closed box have a point in common, and from which fraction on: clipping in rational numbers.
bool meets(const Path& path, const PlainBox<double>& box, Q& enter) {
    for (std::size_t k = 0; k < 3; ++k)
        if (std::max(path.from[k], path.to[k]) < box.low[k] || std::min(path.from[k], path.to[k]) > box.high[k]) return false;
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

Grid grid_of(const Boxes& boxes, double cell, std::size_t most = std::size_t{1} << 26) {
    return Grid(std::span<const PlainBox<double>>(boxes), {cell, most}, {});
}

// What a compare of packed boxes leaves, in plain words: the kernels do it with one instruction.
bool leaves(const Cull& cull, PackedBox box) {
    if ((box & cull.seen) != 0) return false;
    for (int place = 0; place < 64; place += 8)
        if (static_cast<signed char>(box >> place & 0xff) > static_cast<signed char>(cull.above >> place & 0xff)) return false;
    return true;
}

enum class Way { block, walk, walk_once };

/// How often each box is found near the path.
template <class Visited>
void find(const Backend& backend, const Grid& grid, const Path& path, Way way, double limit, bool& wide, Visited&& visited) {
    for (const Level& level : grid.levels()) {
        const auto visit = [&](const Stop& stop) {
            const Range range = level.range(stop.number);
            for (std::uint32_t i = range.begin; i < range.end; ++i)
                if (leaves(stop.cull, *level.boxes(i))) visited(*level.ids(i));
        };
        if (way == Way::block) {
            std::array<Stop, k_most_block> stops;
            Look look = Look::seen;
            Ray<double> ray;
            const Ends<double> ends{path.from.data(), path.to.data(), 3, 3};
            const unsigned found = backend.of<double>().find(level.packed(), ends, 0, 1, 1, stops.data(), &look, &ray);
            wide = wide || look == Look::alone;
            for (unsigned i = 0; i < found; ++i) visit(stops[i]);
        } else {
            Walk walk;
            const Walking walking =
                backend.start_walk(level.packed(), path.from.data(), path.to.data(), limit, way == Way::walk_once, walk);
            if (walking == Walking::no) continue;
            if (walking == Walking::never) {  // every triangle is to be asked: allowed for an end beyond 2^34 cells only
                double furthest = 0;
                for (std::size_t k = 0; k < 3; ++k)
                    for (const double x : {0.5 * path.from[k], 0.5 * path.to[k]})
                        furthest = std::max(furthest, std::abs(level.raster().place(k, x)) / k_steps);
                ASSERT_GE(furthest, 0x1p34);
                wide = true;
                continue;
            }
            std::array<Stop, 3> stops;
            for (unsigned found = 3; found == 3;) {
                found = backend.walk(level.packed(), walk, limit, stops.data(), 3);
                for (unsigned i = 0; i < found; ++i) visit(stops[i]);
            }
        }
    }
}

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

void check_walks(Maker maker, double cell, int count, int segments, double usual_size = 0.2) {
    Boxes boxes;
    for (int i = 0; i < count; ++i) {
        const Point a = maker.point(1);
        Point b = a;
        const double size = maker.random.chance(0.2) ? 10 * usual_size : usual_size;
        for (double& x : b)
            if (maker.random.chance(0.8)) x += maker.scale * maker.random.between(0, size);
        boxes.push_back({a, b});
    }
    Grid grid = grid_of(boxes, cell * maker.scale);
    const std::vector<std::uint32_t> order = grid.take_order();
    std::size_t met = 0;
    for (int i = 0; i < segments; ++i) {
        Path path{maker.point(1.5), maker.point(1.5)};
        if (maker.random.chance(0.8)) {  // aimed at a corner of a box, often just reaching it
            const PlainBox<double>& box = boxes[maker.random.below(boxes.size())];
            const double beyond = maker.random.chance(0.5) ? 0 : maker.random.unit();
            for (std::size_t k = 0; k < 3; ++k) {
                const double corner = maker.random.chance(0.5) ? box.low[k] : box.high[k];
                path.to[k] = corner + beyond * (corner - path.from[k]);
            }
        }
        for (std::size_t k = 0; k < 3; ++k)
            if (maker.random.chance(0.2)) path.from[k] = path.to[k];
        if (maker.random.chance(0.1))  // far, but not as far as the walk is not made for
            for (double& x : path.from) x *= maker.random.chance(0.5) && cell * maker.scale > 0 && maker.offset == 0 ? 1e6 : 1e-3;
        for (Point* end : {&path.from, &path.to})
            for (double& x : *end) x = std::clamp(x, -std::numeric_limits<double>::max(), std::numeric_limits<double>::max());
        const double limit = maker.random.chance(0.3) ? maker.random.unit() : 1;
        const Backend& backend = *backends()[maker.random.below(backends().size())];
        for (const Way way : {Way::block, Way::walk, Way::walk_once}) {
            std::vector<int> seen(boxes.size(), 0);
            bool wide = false;  // there is no block, or no walk
            find(backend, grid, path, way, limit, wide, [&](std::uint32_t id) { ++seen[order[id]]; });
            for (std::size_t n = 0; n < seen.size(); ++n) {
                if (wide) continue;
                if (way != Way::walk) {
                    ASSERT_LE(seen[n], 1) << "segment " << i << " box " << n;
                }
                Q enter;
                if (!meets(path, boxes[n], enter) || enter > Q(limit)) continue;
                ++met;
                ASSERT_GT(seen[n], 0) << "segment " << i << " box " << n << " scale " << maker.scale << " offset " << maker.offset
                                      << " cell " << cell << " " << backend.name << " way " << static_cast<int>(way);
            }
        }
    }
    EXPECT_GT(met, static_cast<std::size_t>(segments) / 2);
}

TEST(Walk, misses_no_box) {
    std::uint64_t seed = 0;
    for (bool lattice : {false, true})
        for (double scale : {1e-6, 1.0, 1e6})
            for (double offset : {0.0, 1e3, -1e6})
                for (const double cell : {0.0, 0.25, 0.06, 0.01}) check_walks({Random(++seed), scale, offset, lattice}, cell, 60, 100);
}

// Several slabs of bricks; and far more cells than boxes, so that the tree has layers.
TEST(Walk, misses_no_box_among_many) {
    check_walks({Random(91), 1, 0, false}, 0, 30'000, 60, 0.01);
    check_walks({Random(92), 1, 1e3, true}, 0, 20'000, 60, 0.01);
    check_walks({Random(93), 1, 0, false}, 0.002, 5'000, 60, 0.001);
}

// Lines that touch the grid in one point of its border: where they come in along one axis they leave it along another, so that any
// rounding of either would lose them. All numbers are small integers, so that the lines pass through the point exactly.
TEST(Walk, misses_no_box_at_the_border_of_the_grid) {
    Random random(5);
    for (int i = 0; i < 2000; ++i) {
        Boxes boxes;
        const int size = random.between_ints(1, 1000);
        const Point corner = {random.between_ints(-99, 99) * 1.0, random.between_ints(-99, 99) * 1.0, random.between_ints(-99, 99) * 1.0};
        Point other = corner;
        for (double& x : other) x += random.chance(0.5) ? size : -size;
        for (const Point& p : {corner, other}) boxes.push_back({p, p});
        Grid grid = grid_of(boxes, size * random.between(0.01, 2));
        const std::vector<std::uint32_t> order = grid.take_order();
        const int before = random.between_ints(1, 1 << random.between_ints(0, 20));
        const int after = random.between_ints(1, 1 << random.between_ints(0, 20));
        Path path{corner, corner};
        for (std::size_t k = 0; k < 3; ++k) {
            const int d = random.between_ints(-999, 999);
            path.from[k] -= before * static_cast<double>(d);
            path.to[k] += after * static_cast<double>(d);
        }
        for (const Way way : {Way::walk, Way::walk_once}) {
            bool found = false;
            bool wide = false;
            const Backend& backend = *backends()[random.below(backends().size())];
            find(backend, grid, path, way, 1, wide, [&](std::uint32_t id) { found = found || order[id] == 0; });
            ASSERT_TRUE(found || wide) << i;
        }
    }
}

// Segments along the walls of cells, of bricks and of larger nodes, and just beside them, and boxes that end there: what is in one cell and
// what in its neighbour is then a matter of rounding.
TEST(Walk, misses_no_box_at_the_walls_of_cells) {
    Random random(6);
    std::size_t met = 0;
    for (int i = 0; i < 60; ++i) {
        const double size = std::ldexp(1.0, random.between_ints(-30, 30));
        const double offset = random.chance(0.5) ? 0 : random.between(-1e4, 1e4) * size;
        const int cells = 1 << random.between_ints(2, 7);
        Boxes boxes;
        for (const double x : {offset, offset + (cells - 1) * size}) boxes.push_back({{x, x, x}, {x, x, x}});
        Raster raster;
        {
            const Grid grid = grid_of(boxes, size);
            ASSERT_EQ(grid.levels().size(), 1U);
            raster = grid.levels()[0].raster();
        }
        const auto near_wall = [&](std::size_t k) {
            const int every = 1 << 2 * random.between_ints(0, 3);  // walls of larger nodes more often than they are among all
            const int wall = random.between_ints(1, std::max(1, (cells - 1) / every)) * every;
            const double beside = random.chance(0.5) ? 0 : random.between(-1, 1) * std::ldexp(1.0, -random.between_ints(1, 50));
            const double x = 2 * (raster.half_low(k) + (std::min(wall, cells - 1) + beside) * k_steps / raster.scale(k));
            return std::clamp(x, offset, offset + (cells - 1) * size);
        };
        const auto point_near_walls = [&] { return Point{near_wall(0), near_wall(1), near_wall(2)}; };
        while (boxes.size() < 60) {
            Point low = point_near_walls();
            Point high = point_near_walls();
            for (std::size_t k = 0; k < 3; ++k) {
                if (random.chance(0.5)) high[k] = std::min(low[k] + random.unit() * size, offset + (cells - 1) * size);
                if (low[k] > high[k]) std::swap(low[k], high[k]);
            }
            boxes.push_back({low, high});
        }
        Grid grid = grid_of(boxes, size);
        const std::vector<std::uint32_t> order = grid.take_order();
        for (int j = 0; j < 60; ++j) {
            Path path{point_near_walls(), point_near_walls()};
            for (std::size_t k = 0; k < 3; ++k)
                if (random.chance(0.4)) path.to[k] = path.from[k];
            const Backend& backend = *backends()[random.below(backends().size())];
            for (const Way way : {Way::walk, Way::walk_once}) {
                std::vector<int> seen(boxes.size(), 0);
                bool wide = false;
                find(backend, grid, path, way, 1, wide, [&](std::uint32_t id) { ++seen[order[id]]; });
                ASSERT_FALSE(wide);
                for (std::size_t n = 0; n < seen.size(); ++n) {
                    if (way == Way::walk_once) {
                        ASSERT_LE(seen[n], 1) << i << " segment " << j << " box " << n << " " << backend.name;
                    }
                    Q enter;
                    if (!meets(path, boxes[n], enter)) continue;
                    ++met;
                    ASSERT_GT(seen[n], 0) << i << " segment " << j << " box " << n << " " << backend.name << " way " << static_cast<int>(way);
                }
            }
        }
    }
    EXPECT_GT(met, 3000U);
}

TEST(Walk, misses_no_box_at_the_ends_of_the_number_range) {
    for (double scale : {1e-310, 1e-300, 1e300, 5e307})
        for (const double cell : {0.0, 0.1}) check_walks({Random(7), scale, 0, false}, cell, 40, 150);
}

TEST(Walk, goes_from_start_to_end_and_stops_at_the_limit) {
    Boxes boxes;
    for (int i = 0; i < 10; ++i) boxes.push_back({{i == 0 ? 0 : i + 0.4, 0, 0}, {i + 0.6, 0.5, 0.5}});
    Grid grid = grid_of(boxes, 1);
    const std::vector<std::uint32_t> order = grid.take_order();
    for (bool backward : {false, true}) {
        Path path{{0.3, 0.3, 0.3}, {9.7, 0.3, 0.3}};
        if (backward) std::swap(path.from, path.to);
        std::vector<std::uint32_t> found;
        bool wide = false;
        find(choose_backend({}), grid, path, Way::walk_once, 0.47, wide, [&](std::uint32_t id) { found.push_back(order[id]); });
        EXPECT_EQ(found, backward ? (std::vector<std::uint32_t>{9, 8, 7, 6, 5}) : (std::vector<std::uint32_t>{0, 1, 2, 3, 4}));
    }
}

TEST(Walk, visits_few_cells) {
    // One box in each cell of a block: a short segment inside one cell reads that cell alone, a diagonal about three a slice.
    Boxes boxes;
    for (int x = 0; x < 40; ++x)
        for (int y = 0; y < 40; ++y)
            for (int z = 0; z < 40; ++z) boxes.push_back({{x + 0.3, y + 0.3, z + 0.3}, {x + 0.7, y + 0.7, z + 0.7}});
    const Grid grid = grid_of(boxes, 1);
    ASSERT_EQ(grid.levels().size(), 1U);
    const auto visited = [&](const Path& path) {
        unsigned count = 0;
        const Backend& backend = choose_backend({});
        const PackedLevel& level = grid.levels()[0].packed();
            Walk walk;
        if (backend.start_walk(level, path.from.data(), path.to.data(), 1, false, walk) != Walking::along) return count;
        for (Stop stop; backend.walk(level, walk, 1, &stop, 1) == 1;) ++count;
        return count;
    };
    EXPECT_EQ(visited({{10.5, 20.5, 30.5}, {10.9, 20.9, 30.9}}), 1U);
    EXPECT_LE(visited({{0.3, 0.5, 0.7}, {39.3, 38.5, 39.7}}), 121U);
    EXPECT_GE(visited({{0.3, 0.5, 0.7}, {39.3, 38.5, 39.7}}), 80U);
}

TEST(Grid, keeps_to_its_memory) {
    Boxes boxes;
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
        const Vec3<double> p = random.in_cube();
        boxes.push_back({{p[0], p[1], p[2]}, {p[0] + 0.5, p[1] + 0.5, p[2] + 0.5}});  // each covers a good part of the grid
    }
    for (std::size_t most : {std::size_t{0}, std::size_t{5000}, std::size_t{20'000}, std::size_t{1} << 20}) {
        const Grid grid = grid_of(boxes, 0, most);
        EXPECT_LE(grid.bytes(), std::max<std::size_t>(most, 16 * 1000) + 1024);
        std::size_t references = 0;
        for (const Level& level : grid.levels()) references += level.reference_count();
        EXPECT_GE(references, 1000U);
    }
    EXPECT_LE(grid_of(boxes, 1e-9, std::size_t{1} << 22).bytes(), (std::size_t{1} << 22) + 1024);
}

// Small boxes scattered over a wide space: nearly each has a branch of the tree for itself, which was not counted (108 bytes a box for 96;
// four times as many for less).
TEST(Grid, keeps_to_its_memory_where_boxes_are_scattered) {
    Random random(8);
    Boxes boxes;
    for (int i = 0; i < 5255; ++i) {
        const Vec3<double> p = 1000 * random.in_cube();
        boxes.push_back({{p[0], p[1], p[2]}, {p[0] + 0.01, p[1] + 0.01, p[2] + 0.01}});
    }
    for (const std::size_t each : {28U, 60U, 96U}) EXPECT_LE(grid_of(boxes, 0, each * boxes.size()).bytes(), each * boxes.size() + 1024) << each;
}

// Boxes of two sizes along a tube: cells one behind the other along x were taken for one, and small boxes so for crowded, which gave them
// levels of their own; along y and z they were not.
TEST(Grid, has_the_same_levels_however_a_mesh_is_turned) {
    for (const double length : {1000.0, 0.1}) {
        std::array<std::size_t, 3> levels{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Random random(9);
            Boxes boxes;
            for (int i = 0; i < 24'000; ++i) {
                const Vec3<double> p = random.in_cube();
                const double size = i < 4000 ? 0.002 : 0.1;
                PlainBox<double> box{};
                for (std::size_t k = 0; k < 3; ++k) {
                    box.low[(axis + k) % 3] = p[static_cast<int>(k)] * (k == 0 && i < 4000 ? length : k == 0 ? 1000 : 0.05);
                    box.high[(axis + k) % 3] = box.low[(axis + k) % 3] + size;
                }
                boxes.push_back(box);
            }
            levels[axis] = grid_of(boxes, 0).levels().size();
        }
        // All along the tube, each shares a large cell with a few others; in one place with thousands.
        EXPECT_EQ(levels, (length < 1 ? std::array<std::size_t, 3>{2, 2, 2} : std::array<std::size_t, 3>{1, 1, 1}));
    }
}

// A flat box a unit from the origin with cells of 1e-25, or a unit box with cells of 1e-300: a cell was less than the last place of its
// coordinates, so that the margin around the box was rounded to more cells than an int can count, one by one.
TEST(Grid, ends_for_cells_far_below_the_coordinates_last_place) {
    for (const double size : {1e-15, 1e-20, 1e-25, 1e-100, 1e-300})
        for (const double at : {1.0, -1e10}) {
            const Grid flat = grid_of({{{0, 0, at}, {size, size, at}}, {{0, 0, at}, {0, size, at}}}, 0);
            EXPECT_EQ(flat.bounds().high[2], at);
            const Grid wide = grid_of({{{0, 0, at}, {1, 1, at}}, {{0, 0, at}, {0, 1, at}}}, size);
            EXPECT_EQ(wide.bounds().high[2], at);
        }
}

TEST(Grid, gives_each_size_its_own_cells) {
    // A teapot in a stadium: ten thousand small boxes in a corner, twelve large ones around.
    Boxes boxes;
    Random random(4);
    for (int i = 0; i < 10'000; ++i) {
        const Vec3<double> p = random.in_cube();
        boxes.push_back({{p[0], p[1], p[2]}, {p[0] + 0.03, p[1] + 0.03, p[2] + 0.03}});
    }
    for (int i = 0; i < 12; ++i) boxes.push_back({{-1000.0 + i, -1000, -1000}, {1000.0 + i, 1000, 1000}});
    const Grid grid = grid_of(boxes, 0);
    ASSERT_EQ(grid.levels().size(), 2U);
    EXPECT_LT(grid.levels()[0].raster().size(0), 0.2);
    EXPECT_GT(grid.levels()[1].raster().size(0), 100);
    EXPECT_EQ(grid.bounds().low[0], -1000);
}

}  // namespace
}  // namespace pierce::test
