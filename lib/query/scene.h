// A mesh made ready: what all queries read, and nothing that they write.
#pragma once

#include <algorithm>
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

    [[nodiscard]] Corners corners(std::uint32_t triangle) const {
        const IndexTriple& t = triangles[triangle];
        return {positions[t[0]], positions[t[1]], positions[t[2]]};
    }
    [[nodiscard]] std::uint32_t face_of(std::uint32_t triangle) const {
        return faces.empty() ? triangle : faces[triangle];
    }
    [[nodiscard]] std::size_t bytes() const;
};

[[nodiscard]] inline Box box_of(const Corners& corners) {
    Box box{};
    for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] = std::min({corners[0][k], corners[1][k], corners[2][k]});
        box.high[k] = std::max({corners[0][k], corners[1][k], corners[2][k]});
    }
    return box;
}

[[nodiscard]] inline Box box_of(const Path& path) {
    Box box{};
    for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] = std::min(path.from[k], path.to[k]);
        box.high[k] = std::max(path.from[k], path.to[k]);
    }
    return box;
}

/// Checks the mesh (throws `MeshError`), copies it, and prepares triangles and grid. Not inlined: see engine.h.
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] Scene make_scene(const MeshView<Scalar>& mesh, const BuildOptions& options);

}  // namespace pierce::detail
