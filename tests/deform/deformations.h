// Ways to move the vertices of a mesh, from gentle to what no mesh should be put through.
#pragma once

#include <cmath>
#include <vector>

#include <pierce/triangle_soup.h>
#include <support/meshes.h>
#include <support/random.h>

namespace pierce::test {

/// Vertices on their way: some of the moves take area from triangles, others give it back.
template <class Scalar>
std::vector<Vec3<Scalar>> deformed(const TriangleSoup<double>& rest, Random& random) {
    std::vector<Vec3<double>> p = rest.positions;
    const std::size_t one = random.below(p.size());
    const double size = std::ldexp(1.0, random.between_ints(-12, 12));
    const Vec3<double> way = random.in_cube();
    switch (random.below(9)) {
        case 0:
            break;  // back where they came from
        case 1:     // each by itself
            for (Vec3<double>& x : p) x += 0.02 * random.in_cube();
            break;
        case 2:  // all together
            for (Vec3<double>& x : p) x = size * x + 100 * way;
            break;
        case 3:  // a part falls into a point
            for (Vec3<double>& x : p)
                if (x.dot(way) > 0.1) x = way;
            break;
        case 4:  // flat along an axis, in part
            for (Vec3<double>& x : p)
                if (x.dot(way) > -0.1) x[static_cast<int>(one % 3)] = 0.25;
            break;
        case 5:  // one vertex far away
            p[one] += 1e4 * way;
            break;
        case 6:  // onto a coarse lattice: duplicates, and triangles without area
            for (Vec3<double>& x : p) x = (4 * x).array().round() / 4;
            break;
        case 7:  // twisted
            for (Vec3<double>& x : p) {
                const double a = 3 * x[2];
                x = {std::cos(a) * x[0] - std::sin(a) * x[1], std::sin(a) * x[0] + std::cos(a) * x[1], x[2]};
            }
            break;
        default:  // only some
            for (std::size_t i = 0; i < p.size(); i += 1 + one % 7) p[i] += 0.1 * way;
    }
    std::vector<Vec3<Scalar>> out;
    for (const Vec3<double>& x : p) out.push_back(x.template cast<Scalar>());
    return out;
}

inline std::vector<TriangleSoup<double>> deforming_meshes() {
    return {bumpy_sphere(5), polycube(4, 0.5, 2, 3), shards(60, 4), terrain(12, 0.3, 5), corner_triangle()};
}

}  // namespace pierce::test
