// Meshes that tests and benchmarks make for themselves, seeded: closed and open, smooth and on a lattice, and odd ones.
#pragma once

#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <pierce/triangle_soup.h>
#include <support/random.h>

namespace pierce::test {

/// Every position p becomes scale * p + offset, rounded once to `Scalar`.
template <class Scalar>
TriangleSoup<Scalar> moved(const TriangleSoup<double>& soup, double scale, const Vec3<double>& offset) {
    TriangleSoup<Scalar> out;
    for (const Vec3<double>& p : soup.positions) {
        const Vec3<double> q = scale * p + offset;
        out.positions.push_back(q.cast<Scalar>());
    }
    out.triangles = soup.triangles;
    out.faces = soup.faces;
    return out;
}

/// In the plane z = 0, its front up: a right angle at the origin, legs of 4 along x and y.
inline TriangleSoup<double> corner_triangle() { return {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}, {}}; }

/// One more triangle, with corners of its own.
template <class Scalar>
void add_triangle(TriangleSoup<Scalar>& soup, const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (const Vec3<double>& p : {a, b, c}) soup.positions.push_back(p.cast<Scalar>());
    soup.triangles.push_back({first, first + 1, first + 2});
}

/// Both meshes as one: the vertices and triangles of `more` come after those of `soup`. Neither has numbered faces.
template <class Scalar>
void append(TriangleSoup<Scalar>& soup, const TriangleSoup<Scalar>& more) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    soup.positions.insert(soup.positions.end(), more.positions.begin(), more.positions.end());
    for (const IndexTriple& t : more.triangles) soup.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

/// As an STL file gives them: each triangle with vertices of its own.
template <class Scalar>
TriangleSoup<Scalar> apart(const TriangleSoup<Scalar>& soup) {
    TriangleSoup<Scalar> out;
    for (const IndexTriple& t : soup.triangles) {
        const auto first = static_cast<std::uint32_t>(out.positions.size());
        for (const std::uint32_t v : t) out.positions.push_back(soup.positions[v]);
        out.triangles.push_back({first, first + 1, first + 2});
    }
    return out;
}

template <class Scalar>
TriangleSoup<Scalar> turned_inside_out(TriangleSoup<Scalar> soup) {
    for (IndexTriple& t : soup.triangles) std::swap(t[1], t[2]);
    return soup;
}

/// A closed surface around the origin, of 8 n^2 triangles facing outwards: an octahedron, divided n times along each
/// edge, whose point in direction d is put at d * radius(d).
template <class Radius>
TriangleSoup<double> star(int n, Radius&& radius) {
    TriangleSoup<double> soup;
    // Each point of the octahedron is known by x, y and the sign of z.
    constexpr std::uint32_t none = ~0U;
    const auto width = static_cast<std::size_t>(2 * n + 1);
    std::vector<std::uint32_t> index(2 * width * width, none);
    const auto vertex = [&](int x, int y, int z) {
        const std::size_t row = (z < 0 ? width : 0) + static_cast<std::size_t>(x + n);
        std::uint32_t& place = index[row * width + static_cast<std::size_t>(y + n)];
        if (place == none) {
            place = static_cast<std::uint32_t>(soup.positions.size());
            const Vec3<double> direction = Vec3<double>(x, y, z).normalized();
            soup.positions.push_back(direction * radius(direction));
        }
        return place;
    };
    for (int octant = 0; octant < 8; ++octant) {
        const int sx = (octant & 1) != 0 ? -1 : 1;
        const int sy = (octant & 2) != 0 ? -1 : 1;
        const int sz = (octant & 4) != 0 ? -1 : 1;
        const bool mirrored = sx * sy * sz < 0;
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            if (mirrored) std::swap(b, c);
            soup.triangles.push_back({a, b, c});
        };
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n - i; ++j) {
                const auto at = [&](int a, int b) { return vertex(sx * a, sy * b, sz * (n - a - b)); };
                add(at(i, j), at(i + 1, j), at(i, j + 1));
                if (i + j + 2 <= n) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            }
    }
    return soup;
}

inline TriangleSoup<double> bumpy_sphere(int n) {
    return star(n, [](const Vec3<double>& d) {
        return 1 + 0.12 * std::sin(5 * d[0] + 1) * std::sin(4 * d[1]) * std::cos(3 * d[2]) +
               0.03 * std::sin(19 * d[0]) * std::sin(23 * d[1] + 2) * std::sin(17 * d[2]);
    });
}

/// The inside of a bowl with a lid: a bumpy hemisphere below z = 0.3, flat above. Closed, facing outwards.
inline TriangleSoup<double> bowl(int n) {
    return star(n, [](const Vec3<double>& d) {
        const double bump = 1 + 0.08 * std::sin(7 * d[0] + 1) * std::sin(9 * d[1]) + 0.04 * std::sin(25 * d[0] * d[1]);
        return d[2] > 0 ? std::min(bump, 0.3 / d[2]) : bump;
    });
}

/// A random set of unit cubes within size^3 and its boundary, scaled by `edge`: closed, on a lattice, full of coplanar
/// faces, with edges and vertices that more than two faces meet in. The diagonal of each square is random.
struct Polycube {
    Polycube(int cubes, double filled, int edge_length, std::uint64_t seed) : size(cubes), edge(edge_length) {
        Random random(seed);
        for (int x = 0; x < size; ++x)
            for (int y = 0; y < size; ++y)
                for (int z = 0; z < size; ++z)
                    if (random.chance(filled)) cube.insert({x, y, z});
        std::map<std::array<int, 3>, std::uint32_t> index;
        const auto vertex = [&](const std::array<int, 3>& p) {
            const auto [at, isnew] = index.try_emplace(p, static_cast<std::uint32_t>(soup.positions.size()));
            if (isnew) soup.positions.push_back(Vec3<double>(p[0], p[1], p[2]) * edge);
            return at->second;
        };
        for (const std::array<int, 3>& place : cube)
            for (std::size_t axis = 0; axis < 3; ++axis)
                for (int up = 0; up < 2; ++up) {
                    std::array<int, 3> neighbour = place;
                    neighbour[axis] += up != 0 ? 1 : -1;
                    if (cube.contains(neighbour)) continue;
                    std::array<std::uint32_t, 4> corner{};
                    for (int k = 0; k < 4; ++k) {  // around the square, counter-clockwise seen from +axis
                        std::array<int, 3> p = place;
                        p[axis] += up;
                        p[(axis + 1) % 3] += (k == 1 || k == 2) ? 1 : 0;
                        p[(axis + 2) % 3] += k >= 2 ? 1 : 0;
                        corner[static_cast<std::size_t>(k)] = vertex(p);
                    }
                    if (up == 0) std::swap(corner[1], corner[3]);
                    const std::size_t s = random.below(2);
                    soup.triangles.push_back({corner[s], corner[s + 1], corner[s + 2]});
                    soup.triangles.push_back({corner[s], corner[s + 2], corner[(s + 3) % 4]});
                }
    }

    /// Whether the point, moved by an infinitesimal step upwards along each axis, lies in a cube.
    [[nodiscard]] bool inside_when_moved(const Vec3<double>& p) const {
        const auto cell = [&](int k) { return static_cast<int>(std::floor(p[k] / edge)); };
        return cube.contains({cell(0), cell(1), cell(2)});
    }

    /// Whether every cube that the point belongs to, or lies on the boundary of, is there.
    [[nodiscard]] bool strictly_inside(const Vec3<double>& p) const { return cubes_around(p) == 8; }
    /// Whether none is.
    [[nodiscard]] bool strictly_outside(const Vec3<double>& p) const { return cubes_around(p) == 0; }

  private:
    // Of the eight octants around a point, how many begin in a cube.
    [[nodiscard]] int cubes_around(const Vec3<double>& p) const {
        int count = 0;
        for (int corner = 0; corner < 8; ++corner) {
            std::array<int, 3> cell{};
            for (int k = 0; k < 3; ++k) {
                const double x = p[k] / edge;
                const bool below = (corner >> k & 1) != 0;
                cell[static_cast<std::size_t>(k)] = static_cast<int>(below ? std::ceil(x) - 1 : std::floor(x));
            }
            count += cube.contains(cell) ? 1 : 0;
        }
        return count;
    }

  public:
    int size;
    double edge;
    std::set<std::array<int, 3>> cube;
    TriangleSoup<double> soup;
};

inline TriangleSoup<double> polycube(int size, double filled, int edge, std::uint64_t seed) {
    return Polycube(size, filled, edge, seed).soup;
}

/// An open, bumpy square in [-1, 1]^2 facing up: 2 n^2 triangles.
inline TriangleSoup<double> terrain(int n, double height, std::uint64_t seed) {
    Random random(seed);
    TriangleSoup<double> soup;
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x)
            soup.positions.push_back({2.0 * x / n - 1, 2.0 * y / n - 1, height * random.unit()});
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const auto a = static_cast<std::uint32_t>(y * (n + 1) + x);
            const auto b = a + static_cast<std::uint32_t>(n) + 1;
            soup.triangles.push_back({a, a + 1, b + 1});
            soup.triangles.push_back({a, b + 1, b});
        }
    return soup;
}

/// Triangles of all sizes and shapes that have nothing to do with one another, in [-1, 1]^3.
inline TriangleSoup<double> shards(std::size_t count, std::uint64_t seed) {
    Random random(seed);
    TriangleSoup<double> soup;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3<double> a = random.in_cube();
        const double size = std::exp(random.between(-7, 0.5));
        const double thin = random.chance(0.3) ? 1e-6 : 1;
        const Vec3<double> e = size * random.direction();
        const Vec3<double> c = a + random.unit() * e + thin * size * random.direction();
        add_triangle(soup, a, a + e, c);
    }
    return soup;
}

}  // namespace pierce::test
