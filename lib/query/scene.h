// A mesh made ready: what all queries read, and nothing that they write.
#pragma once

#include <algorithm>
#include <vector>

#include <grid/grid.h>
#include <kernel/backends.h>
#include <pierce/mesh_view.h>
#include <pierce/options.h>
#include <raw_array.h>

namespace pierce::detail {

template <class Scalar>
struct Scene {
    // Triangles in an order of the library's own, in which what is near in space is near in memory, those of area zero last. `triangle`
    // means a place in it.
    RawArray<Scalar> coordinates;         ///< of the corners: nine a triangle, and one more that kernels may read
    RawArray<IndexTriple> triangles;      ///< the caller's vertices
    std::vector<std::uint32_t> triangle_numbers;  ///< the caller's, by triangle
    std::vector<std::uint32_t> faces;        ///< as in MeshView, by the caller's number; empty when that is the face as well
    std::size_t degenerate = 0;              ///< triangles of area zero
    Grid grid;                               ///< lists all the others
    const Backend* backend = nullptr;
    float scale = 1;                         ///< the power of two that makes a cell of the finest level about 1 wide
    std::size_t face_count = 0;
    std::size_t vertex_count = 0;

    [[nodiscard]] Corners corners(std::uint32_t triangle) const {
        const Scalar* x = &coordinates[9 * std::size_t{triangle}];
        const auto corner = [&](std::size_t k) {
            return Point{static_cast<double>(x[3 * k]), static_cast<double>(x[3 * k + 1]), static_cast<double>(x[3 * k + 2])};
        };
        return {corner(0), corner(1), corner(2)};
    }
    [[nodiscard]] std::uint32_t face_of(std::uint32_t triangle) const {
        const std::uint32_t number = triangle_numbers[triangle];
        return faces.empty() ? number : faces[number];
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

/// Checks the mesh (throws `MeshError`), copies it, and makes the grid. Not inlined: see engine.h.
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] Scene<Scalar> make_scene(const MeshView<Scalar>& mesh, const BuildOptions& options);

}  // namespace pierce::detail
