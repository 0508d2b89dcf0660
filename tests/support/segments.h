// Segments to try a mesh with: of all lengths, in free space and at the surface, generic and aimed at what is hardest.
#pragma once

#include <pierce/mesh_view.h>
#include <support/random.h>

namespace pierce::test {

template <class Scalar>
Vec3<double> corner(const MeshView<Scalar>& mesh, std::size_t triangle, std::size_t k) {
    return mesh.positions[mesh.triangles[triangle][k]].template cast<double>();
}

template <class Scalar>
struct Extent {
    explicit Extent(const MeshView<Scalar>& mesh)
        : low(Vec3<double>::Constant(std::numeric_limits<double>::infinity())), high(-low) {
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            for (const std::uint32_t v : mesh.triangles[i]) {
                low = low.cwiseMin(mesh.positions[v].template cast<double>());
                high = high.cwiseMax(mesh.positions[v].template cast<double>());
            }
    }
    [[nodiscard]] double diagonal() const { return (high - low).norm(); }
    Vec3<double> low;
    Vec3<double> high;
};

/// One segment of a mixture: lengths from a ten-thousandth of the diagonal to twice the diagonal; a third each aimed at
/// a point in a face, at one on an edge or vertex (as exactly as coordinates allow), and placed anywhere in the box;
/// some end exactly on their target, some start there, some are parallel to an axis or lie in the plane of a face.
template <class Scalar>
Segment<Scalar> mixed_segment(const MeshView<Scalar>& mesh, const Extent<Scalar>& extent, Random& random) {
    const double length = extent.diagonal() * std::exp(random.between(std::log(1e-4), std::log(2.0)));
    Vec3<double> direction = random.direction();
    const std::size_t triangle = random.below(mesh.triangles.size());
    if (random.chance(0.1)) {
        const auto axis = static_cast<int>(random.below(3));
        direction = Vec3<double>::Unit(axis) * (random.chance(0.5) ? 1 : -1);
    }
    if (random.chance(0.05)) {
        direction = corner(mesh, triangle, 1) - corner(mesh, triangle, 0);
        if (direction.norm() > 0) direction.normalize();
    }
    Vec3<double> target;
    const double kind = random.unit();
    if (kind < 0.33) {
        target = extent.low + (extent.high - extent.low).cwiseProduct(random.in_cube().cwiseAbs());
    } else {
        Vec3<double> w = random.weights();
        if (kind > 0.66) w = random.chance(0.5) ? Vec3<double>(0.5, 0.5, 0) : Vec3<double>(1, 0, 0);
        target = w[0] * corner(mesh, triangle, 0) + w[1] * corner(mesh, triangle, 1) + w[2] * corner(mesh, triangle, 2);
    }
    const double before = random.chance(0.1) ? 0 : random.chance(0.1) ? 1 : random.unit();
    Segment<Scalar> segment;
    segment.from = (target - before * length * direction).template cast<Scalar>();
    segment.to = (target + (1 - before) * length * direction).template cast<Scalar>();
    return segment;
}

}  // namespace pierce::test
