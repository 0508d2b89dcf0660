// A mesh made ready: what all queries read, and nothing that they write.
#pragma once

#include <vector>

#include <grid/grid.h>
#include <mesh/prepared_triangle.h>
#include <pierce/mesh_view.h>
#include <pierce/options.h>

namespace pierce::detail {

struct Scene {
    std::vector<Point> positions;
    std::vector<IndexTriple> triangles;
    std::vector<std::uint32_t> faces;          ///< as in MeshView; empty when the numbers are the triangles' own
    std::vector<PreparedTriangle> prepared;    ///< by triangle; unset where the area is zero
    Grid grid;                                 ///< lists the triangles that can be hit: all but those of area zero
    std::size_t face_count = 0;
    std::size_t degenerate = 0;
    std::size_t duplicates = 0;

    [[nodiscard]] Corners corners(std::uint32_t triangle) const {
        const IndexTriple& t = triangles[triangle];
        return {positions[t[0]], positions[t[1]], positions[t[2]]};
    }
    [[nodiscard]] std::uint32_t face_of(std::uint32_t triangle) const {
        return faces.empty() ? triangle : faces[triangle];
    }
    [[nodiscard]] std::size_t bytes() const;
};

[[nodiscard]] Box box_of(const Corners& corners);

/// Checks the mesh (throws `MeshError`), copies it, and prepares triangles and grid.
template <class Scalar>
[[nodiscard]] Scene make_scene(const MeshView<Scalar>& mesh, const BuildOptions& options);

}  // namespace pierce::detail
