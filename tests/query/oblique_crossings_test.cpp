// Crossings of oblique surfaces on a lattice, where nearly every segment is degenerate, against ends that are really
// moved.
//
// On polycubes every plane is parallel to an axis, its normal has one component, and the tie rule of planes, the sign
// of normal . (e, e^2, e^3), can take the components in any order: code that took them backwards passed all tests. Here
// are tetrahedra, octahedra and sheared boxes with whole-numbered corners, which share corners and planes, and single
// triangles.
#include <algorithm>

#include <gtest/gtest.h>
#include <pierce/collision_mesh.h>
#include <pierce/triangle_soup.h>
#include <support/moved_oracle.h>
#include <support/random.h>

namespace pierce::test {
namespace {

using L = LatticePoint;
using T = MovedOracle::Triangle;

L operator+(const L& x, const L& y) { return {x[0] + y[0], x[1] + y[1], x[2] + y[2]}; }
L operator-(const L& x, const L& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
L operator*(int s, const L& x) { return {s * x[0], s * x[1], s * x[2]}; }
bool in_reach(const L& p) {
    return std::all_of(p.begin(), p.end(), [](int x) { return std::abs(x) <= 32; });
}

L lattice_point(Random& random, int most) {
    const int x = random.between_ints(-most, most);
    const int y = random.between_ints(-most, most);
    return {x, y, random.between_ints(-most, most)};
}

// A convex body as the triangles of its surface; with no volume, or turned inside out, as often as chance will have it.
using Solid = std::vector<T>;

Solid tetrahedron(const std::array<L, 4>& p) {
    return {{p[0], p[2], p[1]}, {p[0], p[1], p[3]}, {p[1], p[2], p[3]}, {p[2], p[0], p[3]}};
}

Solid octahedron(const L& centre, const L& u, const L& v, const L& w) {
    Solid solid;
    for (int octant = 0; octant < 8; ++octant) {
        const auto arm = [&](int k, const L& d) { return (octant >> k & 1) != 0 ? centre - d : centre + d; };
        T t = {arm(0, u), arm(1, v), arm(2, w)};
        if (((octant ^ octant >> 1 ^ octant >> 2) & 1) != 0) std::swap(t[1], t[2]);
        solid.push_back(t);
    }
    return solid;
}

Solid sheared_box(const L& corner, const L& u, const L& v, const L& w, Random& random) {
    Solid solid;
    const auto square = [&](const L& a, const L& x, const L& y) {  // its front is where x cross y points to
        const std::array<L, 4> c = {a, a + x, a + x + y, a + y};
        const std::size_t s = random.below(2);
        solid.push_back({c[s], c[s + 1], c[s + 2]});
        solid.push_back({c[s], c[s + 2], c[(s + 3) % 4]});
    };
    square(corner, v, u);
    square(corner, w, v);
    square(corner, u, w);
    square(corner + w, u, v);
    square(corner + u, v, w);
    square(corner + v, w, u);
    return solid;
}

// Of one solid around the moved point: it lies inside where it is behind all faces, or, inside out, in front of all.
int winding_of(const Solid& solid, const L& p) {
    int sum = 0;
    int faces = 0;
    for (const T& t : solid) {
        if (MovedOracle::zero_area(t)) continue;
        ++faces;
        sum += MovedOracle::side(t, p);
    }
    return faces == 0 ? 0 : sum == -faces ? 1 : sum == faces ? -1 : 0;
}

struct Scene {
    std::vector<Solid> solids;

    void add(Solid solid) {
        for (const T& t : solid)
            for (const L& p : t)
                if (!in_reach(p)) return;
        solids.push_back(std::move(solid));
    }
    [[nodiscard]] std::vector<T> triangles() const {
        std::vector<T> all;
        for (const Solid& solid : solids) all.insert(all.end(), solid.begin(), solid.end());
        return all;
    }
    [[nodiscard]] int winding(const L& p) const {
        int sum = 0;
        for (const Solid& solid : solids) sum += winding_of(solid, p);
        return sum;
    }
};

// Solids that share corners, and so edges, planes and faces. All coordinates are even: the middle of an edge is on the
// lattice.
Scene closed_scene(Random& random) {
    Scene scene;
    std::vector<L> corners;
    const auto corner = [&] {
        if (!corners.empty() && random.chance(0.4)) return corners[random.below(corners.size())];
        return corners.emplace_back(2 * lattice_point(random, 4));
    };
    const auto arm = [&] { return 2 * lattice_point(random, 3); };
    for (int count = random.between_ints(2, 6); count > 0; --count) switch (random.below(3)) {
            case 0: scene.add(tetrahedron({corner(), corner(), corner(), corner()})); break;
            case 1: scene.add(octahedron(corner(), arm(), arm(), arm())); break;
            default: scene.add(sheared_box(corner(), arm(), arm(), arm(), random)); break;
        }
    return scene;
}

// On a corner, in the middle of an edge, in the plane of a triangle inside of it or beyond, or anywhere.
L special_point(const std::vector<T>& triangles, Random& random) {
    if (triangles.empty() || random.chance(0.15)) return lattice_point(random, 12);
    const T& t = triangles[random.below(triangles.size())];
    const L u = t[1] - t[0];
    const L v = t[2] - t[0];
    const auto halves = [&](const L& a, const L& x, int i, const L& y, int j) {
        const L sum = 2 * a + i * x + j * y;
        return L{sum[0] / 2, sum[1] / 2, sum[2] / 2};  // all coordinates of triangles are even
    };
    L p{};
    do p = halves(t[0], u, random.between_ints(-1, 3), v, random.between_ints(-1, 3));
    while (!in_reach(p));
    return p;
}

// Both ends at special places, or its middle at one; some start between two corners, and so inside of a solid if they
// are its.
std::array<L, 2> special_segment(const std::vector<T>& triangles, Random& random) {
    const L p = special_point(triangles, random);
    if (!triangles.empty() && random.chance(0.3)) {
        const std::size_t i = random.below(triangles.size());
        const std::size_t j = std::min(i + random.below(4), triangles.size() - 1);
        const L sum = triangles[i][random.below(3)] + triangles[j][random.below(3)];
        return {L{sum[0] / 2, sum[1] / 2, sum[2] / 2}, p};
    }
    if (random.chance(0.3)) return {p, special_point(triangles, random)};
    const L d = random.chance(0.3)
                    ? L(random.between_ints(1, 9) * L{random.between_ints(-1, 1), random.between_ints(-1, 1), 1})
                    : lattice_point(random, 9);
    if (in_reach(p - d) && in_reach(p + d)) return {p - d, p + d};
    return {p, lattice_point(random, 9)};
}

// The same lattice at another place and size: every coordinate is exact.
template <class Scalar>
struct Placed {
    Scalar scale;
    Scalar offset;

    [[nodiscard]] Vec3<Scalar> operator()(const L& p) const {
        Vec3<Scalar> v;
        for (int k = 0; k < 3; ++k)
            v[k] = scale * static_cast<Scalar>(p[static_cast<std::size_t>(k)]) + offset * Scalar(k - 1);
        return v;
    }
    [[nodiscard]] TriangleSoup<Scalar> soup(const std::vector<T>& triangles) const {
        TriangleSoup<Scalar> out;
        for (const T& t : triangles) {
            const auto first = static_cast<std::uint32_t>(out.positions.size());
            for (const L& p : t) out.positions.push_back((*this)(p));
            out.triangles.push_back({first, first + 1, first + 2});
        }
        return out;
    }
};


template <class Scalar>
void closed_solids(const Placed<Scalar>& place, int scenes, std::uint64_t seed) {
    Random random(seed);
    int segments = 0;
    int changes = 0;
    for (int i = 0; i < scenes; ++i) {
        const Scene scene = closed_scene(random);
        const std::vector<T> triangles = scene.triangles();
        const CollisionMesh<Scalar> mesh(place.soup(triangles).view());
        for (int k = 0; k < 100; ++k) {
            const auto [p, q] = special_segment(triangles, random);
            const int from = scene.winding(p);
            const int to = scene.winding(q);
            ASSERT_EQ(mesh.crossings({place(p), place(q)}), to - from)
                << place(p).transpose() << " -> " << place(q).transpose() << ", scene " << i << " of seed " << seed;
            ++segments;
            changes += to != from ? 1 : 0;
            if (k % 10 != 0) continue;
            ASSERT_EQ(mesh.winding_number(place(p)), from)
                << place(p).transpose() << ", scene " << i << " of seed " << seed;
            ASSERT_EQ(mesh.contains(place(p)), from != 0);
        }
    }
    std::cout << segments << " segments, " << changes << " from one winding number to another\n";
    EXPECT_GT(changes, segments / 12);
}

TEST(ObliqueCrossings, equal_the_change_of_the_winding_number) {
    closed_solids<float>({1, 0}, 2000, 1);
    closed_solids<double>({1, 0}, 2000, 2);
    closed_solids<float>({0x1p-6F, 1000}, 1000, 3);
    closed_solids<double>({1, 1e15}, 1000, 4);
    closed_solids<double>({std::numeric_limits<double>::denorm_min(), 0}, 500, 5);
}

// Triangles that have nothing to do with one another: each is crossed, or not, by itself.
template <class Scalar>
void open_triangles(const Placed<Scalar>& place, int scenes, std::uint64_t seed) {
    Random random(seed);
    int segments = 0;
    int crossed = 0;
    for (int i = 0; i < scenes; ++i) {
        std::vector<T> triangles;
        for (int k = random.between_ints(1, 4); k > 0; --k) {
            T t{};
            for (L& p : t) p = 2 * lattice_point(random, 4);
            triangles.push_back(t);
        }
        const CollisionMesh<Scalar> mesh(place.soup(triangles).view());
        for (int k = 0; k < 100; ++k) {
            const auto [p, q] = special_segment(triangles, random);
            int expected = 0;
            bool any = false;
            for (const T& t : triangles) {
                const int one = MovedOracle::crossing(t, p, q);
                expected += one;
                any = any || one != 0;
            }
            ASSERT_EQ(mesh.crossings({place(p), place(q)}), expected)
                << place(p).transpose() << " -> " << place(q).transpose() << ", scene " << i << " of seed " << seed;
            ++segments;
            crossed += any ? 1 : 0;
        }
    }
    std::cout << segments << " segments, " << crossed << " of them cross a triangle\n";
    EXPECT_GT(crossed, segments / 12);
}

TEST(ObliqueCrossings, of_single_triangles_are_those_of_the_moved_segment) {
    open_triangles<float>({1, 0}, 2000, 11);
    open_triangles<double>({1, 0}, 2000, 12);
    open_triangles<float>({0x1p-6F, 1000}, 500, 13);
    open_triangles<double>({std::numeric_limits<double>::denorm_min(), 0}, 500, 14);
}

}  // namespace
}  // namespace pierce::test
