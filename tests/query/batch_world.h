// What batches are tried with: a mesh of lattice and random triangles whose faces are cut into several, and segments of
// all kinds, finite and not.
#pragma once

#include <limits>

#include <pierce/collision_mesh.h>
#include <support/meshes.h>
#include <support/segments.h>

namespace pierce::test {

/// A polycube, on whose edges and vertices segments are hard to decide, with shards of all sizes around and through it.
template <class Scalar>
TriangleSoup<Scalar> lattice_and_shards() {
    TriangleSoup<double> soup = polycube(4, 0.5, 2, 3);
    append(soup, moved<double>(shards(400, 5), 6, Vec3<double>::Zero()));
    soup.triangles.push_back({0, 0, 1});  // of area zero
    for (std::uint32_t i = 0; i < soup.triangles.size(); ++i) soup.faces.push_back(i / 2);
    return moved<Scalar>(soup, 1, Vec3<double>(0.5, 0.25, 0));
}

/// One in thirty has a coordinate that is NaN or infinite; a few are of no length, miss the mesh's box, or reach so far
/// that every triangle is asked.
template <class Scalar>
std::vector<Segment<Scalar>> batch_segments(const MeshView<Scalar>& mesh, std::size_t count, std::uint64_t seed) {
    constexpr auto infinity = std::numeric_limits<Scalar>::infinity();
    const Extent<Scalar> extent(mesh);
    Random random(seed);
    std::vector<Segment<Scalar>> segments;
    for (std::size_t i = 0; i < count; ++i) {
        Segment<Scalar> s = mixed_segment(mesh, extent, random);
        const double kind = random.unit();
        if (kind < 0.03) {
            const Scalar bad =
                std::array{infinity, -infinity, std::numeric_limits<Scalar>::quiet_NaN()}[random.below(3)];
            (random.chance(0.5) ? s.from : s.to)[random.between_ints(0, 2)] = bad;
        } else if (kind < 0.05) {
            s.to = s.from;
        } else if (kind < 0.07) {
            s.from.array() += static_cast<Scalar>(3 * extent.diagonal());
            s.to.array() += static_cast<Scalar>(3 * extent.diagonal());
        } else if (kind < 0.08) {
            s.to[random.between_ints(0, 2)] = Scalar(1e20);
        }
        segments.push_back(s);
    }
    return segments;
}

}  // namespace pierce::test
