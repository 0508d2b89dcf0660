// No chain of steps gets through a closed mesh that deforms, by the one-sided rules.
//
// The chains of a lattice are all walked at once: where a step without a hit leads is a graph, whose nodes are a shape
// of the mesh together with a place of the point. A leak is a way in it from one side to the other. The shapes fold
// their edges over, close up to be flat, and pass through one another's places; the places lie on faces, edges and
// vertices.
#include <gtest/gtest.h>

#include <random>

#include <exact/crossing.h>
#include <exact/decide.h>
#include <exact/touch.h>
#include <motion/moving.h>

namespace pierce::test {

namespace {

using detail::Corners;
using detail::Point;

using Faces = std::vector<std::array<int, 3>>;
using Shape = std::vector<Point>;

Corners corners_of(const Shape& shape, const std::array<int, 3>& face) {
    return {shape[static_cast<std::size_t>(face[0])], shape[static_cast<std::size_t>(face[1])],
            shape[static_cast<std::size_t>(face[2])]};
}

enum class State { outside, on, inside };

State state_of(const Shape& shape, const Faces& faces, const Point& point) {
    const detail::Path path{{17.5, 1001.25, 33.125}, point};
    int winding = 0;
    for (const auto& face : faces) {
        const Corners corners = corners_of(shape, face);
        if (detail::touch(point, corners).hit) return State::on;
        winding += detail::crossing(path, corners);
    }
    return winding > 0 ? State::inside : State::outside;
}

bool any_strike(const Shape& from, const Shape& to, const Faces& faces, const Point& p, const Point& q, Sides sides) {
    for (const auto& face : faces)
        if (detail::strikes({p, q}, {corners_of(from, face), corners_of(to, face)}, sides).hit) return true;
    return false;
}

/// How many nodes on the wrong side a point gets to, unseen, from any on the right one.
int leaks(const std::vector<Shape>& shapes, const Faces& faces, const std::vector<Point>& points, Sides sides) {
    const std::size_t count = shapes.size() * points.size();
    std::vector<State> state;
    for (const Shape& shape : shapes)
        for (const Point& point : points) state.push_back(state_of(shape, faces, point));
    int found = 0;
    // Once from in front, once from behind: on the surface counts as in front for `front` and `both`, else as behind.
    for (const bool from_outside : {true, false}) {
        if (sides != Sides::both && from_outside != (sides == Sides::front)) continue;
        const bool on_is_outside = sides != Sides::back;
        const auto is_outside = [&](std::size_t node) {
            return state[node] == State::outside || (state[node] == State::on && on_is_outside);
        };
        std::vector<bool> reached(count);
        std::vector<std::size_t> queue;
        for (std::size_t node = 0; node < count; ++node)
            if (is_outside(node) == from_outside) {
                reached[node] = true;
                queue.push_back(node);
            }
        const std::size_t starts = queue.size();
        EXPECT_GT(starts, 0U);
        EXPECT_LT(starts, count);
        while (!queue.empty()) {
            const std::size_t node = queue.back();
            queue.pop_back();
            const std::size_t a = node / points.size();
            const std::size_t p = node % points.size();
            for (std::size_t next = 0; next < count; ++next) {
                if (reached[next]) continue;
                const std::size_t b = next / points.size();
                const std::size_t q = next % points.size();
                if (any_strike(shapes[a], shapes[b], faces, points[p], points[q], sides)) continue;
                reached[next] = true;
                queue.push_back(next);
                if (is_outside(next) == from_outside) continue;
                ++found;
                ADD_FAILURE() << "shape " << a << " to " << b << ", point " << points[p][0] << ' ' << points[p][1]
                              << ' ' << points[p][2] << " to " << points[q][0] << ' ' << points[q][1] << ' '
                              << points[q][2] << " sides " << static_cast<int>(sides);
                if (found > 3) return found;
            }
        }
    }
    return found;
}

constexpr Sides k_all_sides[] = {Sides::front, Sides::back, Sides::both};

/// Two triangles on an edge along z, over a ridge or a valley as the heights of their other corners say, closed below.
const Faces k_wedge_faces = {{0, 1, 2}, {1, 0, 3}, {2, 1, 4}, {0, 2, 4}, {3, 0, 4}, {1, 3, 4}};
Shape wedge(double left, double right, double edge) {
    return {{0, edge, 1}, {0, edge, -1}, {-1, left, 0}, {1, right, 0}, {0, -8, 0}};
}

/// A vertex with a ring of four around it, closed below.
const Faces k_tent_faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {5, 2, 1}, {5, 3, 2}, {5, 4, 3}, {5, 1, 4}};
Shape tent(const std::array<double, 4>& ring, double top) {
    return {{0, top, 0}, {1, ring[0], 0}, {0, ring[1], -1}, {-1, ring[2], 0}, {0, ring[3], 1}, {0, -8, 0}};
}

}  // namespace

// The counter-example to "in front just before and behind just after" for edges as well: the roof over the edge becomes
// a valley while the point passes the edge. It stays in front of one plane and behind the other, and gets inside.
TEST(MovingLeaks, AnEdgeThatFoldsOverAPoint) {
    const Shape roof = wedge(-1, -1, 0);
    const Shape valley = wedge(1, 1, 0);
    const Point left = {-0.5, 0, 0};
    const Point right = {0.5, 0, 0};
    ASSERT_EQ(state_of(roof, k_wedge_faces, left), State::outside);
    ASSERT_EQ(state_of(valley, k_wedge_faces, right), State::inside);
    for (const Sides sides : {Sides::front, Sides::both}) {
        int strikes = 0;
        for (const auto& face : k_wedge_faces) {
            const detail::Impact impact =
                detail::strikes({left, right}, {corners_of(roof, face), corners_of(valley, face)}, sides);
            if (!impact.hit) continue;
            ++strikes;
            EXPECT_EQ(impact.feature, Feature::edge);
            EXPECT_LE(impact.earliest, 0.5);
            EXPECT_GE(impact.latest, 0.5);
        }
        EXPECT_EQ(strikes, 2);
    }
}

// What the rule leaves open (lib/motion/README.md): two faces close on a point in front of both exactly at the end of a
// step, and go through each other in the next. In one step they count.
TEST(MovingLeaks, ABookThatClosesAtTheEndOfAStep) {
    const auto book = [](double open) {  // faces of a valley along the z axis that goes to x > 0
        return std::array<Corners, 2>{Corners{Point{0, 0, 1}, {0, 0, -1}, {4, 4 * open, 0}},
                                      Corners{Point{0, 0, -1}, {0, 0, 1}, {4, -4 * open, 0}}};
    };
    const auto strikes = [&](double from, double to) {
        const Point p = {from, 0, 0};
        const Point q = {to, 0, 0};
        int count = 0;
        for (std::size_t i = 0; i < 2; ++i)
            count += detail::strikes({p, q}, {book(from)[i], book(to)[i]}, Sides::front).hit ? 1 : 0;
        return count;
    };
    for (const auto& face : book(1)) EXPECT_GT(detail::side_of(face, {1, 0, 0}), 0);
    EXPECT_EQ(strikes(1, 0), 0);
    EXPECT_EQ(strikes(0, -1), 0);
    EXPECT_EQ(strikes(1, -1), 2);
}

TEST(MovingLeaks, NoChainOfStepsThroughAnEdge) {
    std::vector<Shape> shapes;
    for (int left = -1; left <= 1; ++left)
        for (int right = -1; right <= 1; ++right)
            for (int edge = -1; edge <= 1; ++edge) shapes.push_back(wedge(left, right, edge));
    std::vector<Point> points;
    for (int x = -1; x <= 1; ++x)
        for (int y = -2; y <= 2; ++y) points.push_back({x / 2.0, y / 2.0, 0});
    for (const Sides sides : k_all_sides) EXPECT_EQ(leaks(shapes, k_wedge_faces, points, sides), 0);
}

TEST(MovingLeaks, NoChainOfStepsThroughAVertex) {
    std::vector<Shape> shapes;
    for (int i = 0; i < 16; ++i)
        shapes.push_back(tent({i % 2 * 2.0 - 1, i / 2 % 2 * 2.0 - 1, i / 4 % 2 * 2.0 - 1, i / 8 * 2.0 - 1}, 0));
    // An edge that goes on straight beyond the vertex: it folds at the vertex as well.
    for (int i = 0; i < 4; ++i) shapes.push_back(tent({i % 2 * 2.0 - 1, 0, i / 2 * 2.0 - 1, 0}, 0));
    shapes.push_back(tent({0, 0, 0, 0}, 0));
    shapes.push_back(tent({0, 0, 0, 0}, 1));
    std::vector<Point> points;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z) points.push_back({x / 2.0, y / 2.0, z / 2.0});
    for (const Sides sides : k_all_sides) EXPECT_EQ(leaks(shapes, k_tent_faces, points, sides), 0);
}

namespace {

/// A ball of 26 vertices, the lattice points around the origin, each on its ray: at integer distances it has flat
/// places, folds and spikes, and the surface never meets itself.
struct Ball {
    Faces faces;
    std::vector<Point> rays;

    Ball() {
        const auto index = [this](int x, int y, int z) {
            const Point p = {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
            for (std::size_t i = 0; i < rays.size(); ++i)
                if (rays[i] == p) return static_cast<int>(i);
            rays.push_back(p);
            return static_cast<int>(rays.size()) - 1;
        };
        for (int axis = 0; axis < 3; ++axis)
            for (const int side : {-1, 1})
                for (int u = -1; u < 1; ++u)
                    for (int v = -1; v < 1; ++v) {
                        const auto at = [&](int a, int b) {
                            int p[3] = {};
                            p[axis] = side;
                            p[(axis + 1) % 3] = side > 0 ? a : b;
                            p[(axis + 2) % 3] = side > 0 ? b : a;
                            return index(p[0], p[1], p[2]);
                        };
                        const int q[4] = {at(u, v), at(u + 1, v), at(u + 1, v + 1), at(u, v + 1)};
                        if ((u + v) % 2 == 0) {
                            faces.push_back({q[0], q[1], q[2]});
                            faces.push_back({q[0], q[2], q[3]});
                        } else {
                            faces.push_back({q[0], q[1], q[3]});
                            faces.push_back({q[1], q[2], q[3]});
                        }
                    }
    }
    Shape shape(const std::vector<int>& distance) const {
        Shape out = rays;
        for (std::size_t i = 0; i < out.size(); ++i)
            for (double& x : out[i]) x *= distance[i];
        return out;
    }
};

struct WalkCounts {
    int leaks = 0, hits = 0, on = 0;
};

/// Walks of a point while the mesh moves: from outside until a hit, or some steps.
WalkCounts walk_around_balls(int walks, unsigned seed) {
    std::mt19937 random(seed);
    const auto number = [&random](int from, int to) { return std::uniform_int_distribution<int>(from, to)(random); };
    const Ball ball;
    WalkCounts counts;
    for (int i = 0; i < walks; ++i) {
        std::vector<int> distance(ball.rays.size());
        for (int& d : distance) d = number(1, 2);
        Shape shape = ball.shape(distance);
        Point p = {static_cast<double>(number(-2, 2)), static_cast<double>(number(-2, 2)),
                   static_cast<double>(number(-2, 2))};
        if (state_of(shape, ball.faces, p) == State::inside) continue;
        for (int step = 0; step < 12; ++step) {
            for (int& d : distance) d = number(0, 3) == 0 ? number(1, 2) : d;
            const Shape next = ball.shape(distance);
            Point q = p;
            for (double& x : q) x = std::clamp(x + number(-1, 1), -2.0, 2.0);
            if (any_strike(shape, next, ball.faces, p, q, Sides::front)) {
                ++counts.hits;
                break;
            }
            const State state = state_of(next, ball.faces, q);
            counts.on += state == State::on ? 1 : 0;
            if (state == State::inside) {
                ++counts.leaks;
                break;
            }
            shape = next;
            p = q;
        }
    }
    return counts;
}

}  // namespace

TEST(MovingLeaks, NoWalkIntoABallThatBulges) {
    const WalkCounts counts = walk_around_balls(4000, 1);
    EXPECT_EQ(counts.leaks, 0);
    EXPECT_GT(counts.hits, 1000);
    EXPECT_GT(counts.on, 1000);
}
TEST(MovingLeaksSoak, NoWalkIntoABallThatBulges) { EXPECT_EQ(walk_around_balls(400000, 2).leaks, 0); }

namespace {

/// A tetrahedron whose corners go anywhere, so that it is flat at times, turns inside out and meets itself. The first
/// shape is right side out, and only those chains count in which the point starts where the winding number is 0.
struct AnywhereCounts {
    int leaks = 0, ends = 0, between = 0;
};
AnywhereCounts walk_through_tetrahedra(int walks, unsigned seed, int size) {
    std::mt19937 random(seed);
    const auto number = [&random](int from, int to) { return std::uniform_int_distribution<int>(from, to)(random); };
    const Faces faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
    AnywhereCounts counts;
    const auto place = [&] {
        return Point{static_cast<double>(number(-size, size)), static_cast<double>(number(-size, size)),
                     static_cast<double>(number(-size, size))};
    };
    for (int i = 0; i < walks; ++i) {
        Shape shape = {place(), place(), place(), place()};
        Point p = place();
        if (state_of(shape, faces, p) != State::outside) continue;
        for (int step = 0; step < 6; ++step) {
            Shape next = shape;
            for (Point& x : next)
                if (number(0, 1) == 0) x = place();
            const Point q = place();
            if (any_strike(shape, next, faces, p, q, Sides::front)) break;
            const State state = state_of(next, faces, q);
            ++counts.between;
            if (state == State::inside) {
                ++counts.leaks;
                break;
            }
            counts.ends += state == State::on ? 1 : 0;
            shape = next;
            p = q;
        }
    }
    return counts;
}

}  // namespace

TEST(MovingLeaks, NoWalkIntoTetrahedraThatTurnInsideOut) {
    const AnywhereCounts counts = walk_through_tetrahedra(20000, 3, 1);
    EXPECT_EQ(counts.leaks, 0);
    EXPECT_GT(counts.ends, 1000);
}
TEST(MovingLeaksSoak, NoWalkIntoTetrahedraThatTurnInsideOut) {
    for (int size = 1; size <= 2; ++size) EXPECT_EQ(walk_through_tetrahedra(1000000, 4, size).leaks, 0);
}

}  // namespace pierce::test
