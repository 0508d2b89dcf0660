// A mesh that owns its arrays, and the reader that fills one from a file without losing a face or a digit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include <pierce/export.h>
#include <pierce/mesh_view.h>

namespace pierce {

/// Positions and index triples with no connectivity: what a file holds, whatever its topology.
template <class Scalar>
struct TriangleSoup {
    std::vector<Vec3<Scalar>> positions;
    std::vector<IndexTriple> triangles;
    /// For each triangle the face of the file that it was cut from, counted from 0 in the order of the file. Empty when
    /// every face of the file is a triangle: then both numbers are the same.
    std::vector<std::uint32_t> faces;

    [[nodiscard]] MeshView<Scalar> view() const { return {positions, triangles, faces}; }
    /// How many faces the file had; with polygons in it, fewer than it has triangles.
    [[nodiscard]] std::size_t face_count() const {
        return faces.empty() ? triangles.size() : faces.back() + std::size_t{1};
    }
};

/// Reads OBJ, OFF, PLY (ascii and binary, both byte orders) or STL (ascii and binary); the kind is told from the name's
/// ending, in upper or lower case. Every number is read at the precision of `Scalar`, correctly rounded. Polygons are
/// cut into triangles; zero-area and duplicate faces are kept. The corners of an STL file become one vertex where their
/// coordinates are equal.
///
/// Throws `MeshError`, one line that names the file, the line or byte, and the reason, when the file can't be opened,
/// is cut short, holds an index out of range, a coordinate that is not finite or does not fit `Scalar`, a face of fewer
/// than three corners, or no face at all. Nothing is skipped. Memory is linear in the size of the file, whatever counts
/// its header claims, and so is time but for concave polygons of many corners (n log n as a rule, quadratic at worst).
template <class Scalar>
[[nodiscard]] PIERCE_EXPORT TriangleSoup<Scalar> read_mesh(const std::filesystem::path& path);

extern template PIERCE_EXPORT TriangleSoup<float> read_mesh<float>(const std::filesystem::path&);
extern template PIERCE_EXPORT TriangleSoup<double> read_mesh<double>(const std::filesystem::path&);

}  // namespace pierce
