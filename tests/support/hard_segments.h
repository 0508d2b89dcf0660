// Segments that are hard for a broadphase: in walls of its cells and through their corners, through vertices, along
// edges, and one unit in the last place beside all of these.
#pragma once

#include <array>
#include <cmath>

#include <support/segments.h>

namespace pierce::test {

namespace hard {

/// A point of the lattice that the walls of a grid's cells make, in some axes only; the others are those of `p`.
inline Vec3<double> on_walls(Vec3<double> p, const Vec3<double>& low, double cell, double chance, Random& random) {
    for (int k = 0; k < 3; ++k)
        if (random.chance(chance)) p[k] = low[k] + std::round((p[k] - low[k]) / cell) * cell;
    return p;
}

template <class Scalar>
Vec3<Scalar> beside(Vec3<Scalar> p, Random& random) {
    const Scalar far = std::numeric_limits<Scalar>::infinity();
    for (int k = 0; k < 3; ++k)
        if (random.chance(0.3)) p[k] = std::nextafter(p[k], random.chance(0.5) ? far : -far);
    return p;
}

}  // namespace hard

/// `cell`: the edge of the grid's cells, which begin at the lower end of the mesh. All numbers are finite.
template <class Scalar>
Segment<Scalar> hard_segment(const MeshView<Scalar>& mesh, const Extent<Scalar>& extent, double cell, Random& random) {
    const Vec3<double> size = extent.high - extent.low;
    const auto anywhere = [&] {
        return Vec3<double>(extent.low - 0.1 * size + 1.2 * size.cwiseProduct(random.in_cube().cwiseAbs()));
    };
    const std::size_t triangle = random.below(mesh.triangles.size());
    const std::size_t k = random.below(3);
    const Vec3<double> a = corner(mesh, triangle, k);
    Vec3<double> from = anywhere();
    Vec3<double> to = anywhere();
    switch (random.below(5)) {
        case 0:  // in walls
            from = hard::on_walls(from, extent.low, cell, 0.7, random);
            to = hard::on_walls(to, extent.low, cell, 0.5, random);
            for (int axis = 0; axis < 3; ++axis)
                if (random.chance(0.5)) to[axis] = from[axis];
            break;
        case 1:  // through corners of cells
            from = hard::on_walls(from, extent.low, cell, 1, random);
            to = hard::on_walls(to, extent.low, cell, 1, random);
            break;
        case 2: {  // through a vertex, or up to it
            const Vec3<double> d = (from - a) / 4;
            from = a - random.between_ints(0, 3) * d;
            to = a + random.between_ints(0, 3) * d;
            break;
        }
        case 3: {  // along an edge
            const Vec3<double> edge = corner(mesh, triangle, (k + 1) % 3) - a;
            const std::array ends = {-1.0, 0.0, 0.25, 0.5, 1.0, 2.0};
            from = a + ends[random.below(6)] * edge;
            to = a + ends[random.below(6)] * edge;
            break;
        }
        default: {  // through a point of an edge that is on walls
            const Vec3<double> edge = corner(mesh, triangle, (k + 1) % 3) - a;
            const Vec3<double> middle = hard::on_walls(a + random.unit() * edge, extent.low, cell, 0.5, random);
            to = middle + (middle - from) * (random.chance(0.3) ? 0 : random.unit());
        }
    }
    Segment<Scalar> segment{from.template cast<Scalar>(), to.template cast<Scalar>()};
    if (random.chance(0.3)) segment.from = hard::beside(segment.from, random);
    if (random.chance(0.3)) segment.to = hard::beside(segment.to, random);
    if (!segment.from.allFinite() || !segment.to.allFinite()) return hard_segment(mesh, extent, cell, random);
    return segment;
}

}  // namespace pierce::test
