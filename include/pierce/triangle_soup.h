// A mesh that owns its arrays, and the reader that fills one from a file without losing a face or a digit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <pierce/export.h>
#include <pierce/mesh_view.h>

namespace pierce {

/// Stands for the name of a face that has none, in `material_of_face` and `group_of_face`.
inline constexpr std::uint32_t k_no_name = 0xFFFF'FFFF;

/// Positions and index triples with no connectivity: what a file holds, whatever its topology.
template <class Scalar>
struct TriangleSoup {
    std::vector<Vec3<Scalar>> positions;  ///< in the units of the file
    std::vector<IndexTriple> triangles;   ///< corners as places in `positions`
    /// For each triangle the face of the file that it was cut from, counted from 0 in the order of the file. Empty when
    /// every face of the file is a triangle: then both numbers are the same.
    std::vector<std::uint32_t> faces = {};

    /// Names of materials, each once, in the order in which the file first says them; those that no face has are listed
    /// as well.
    std::vector<std::string> materials = {};
    /// Names of groups, in the same way.
    std::vector<std::string> groups = {};
    /// For each face of the file the place of its name in `materials`, or `k_no_name`: what a hit hits is
    /// `materials[material_of_face[hit.face]]`. Empty, or `face_count()` long; triangle i belongs to face `faces[i]`.
    std::vector<std::uint32_t> material_of_face = {};
    /// The same for `groups`.
    std::vector<std::uint32_t> group_of_face = {};

    /// The mesh to build from; valid while the soup is not changed.
    [[nodiscard]] MeshView<Scalar> view() const { return {positions, triangles, faces}; }
    /// How many faces the file had; with polygons in it, fewer than it has triangles.
    [[nodiscard]] std::size_t face_count() const {
        return faces.empty() ? triangles.size() : faces.back() + std::size_t{1};
    }
};

/// What `read_mesh` keeps beside the surface. Nothing unless asked: queries need none of it, and each takes four bytes
/// a face.
struct ReadOptions {
    bool materials = false;  ///< fill `TriangleSoup::materials` and `material_of_face`
    bool groups = false;     ///< fill `TriangleSoup::groups` and `group_of_face`
};

/// Reads OBJ, OFF, PLY (ascii and binary, both byte orders) or STL (ascii and binary); the kind is told from the name's
/// ending, in upper or lower case. Every number is read at the precision of `Scalar`, correctly rounded. Polygons are
/// cut into triangles; zero-area and duplicate faces are kept. The corners of an STL file become one vertex where their
/// coordinates are equal.
///
/// Throws `MeshError`, one line that names the file, the line or byte, and the reason, when the file can't be opened,
/// is packed or cut short, holds an index out of range, a coordinate that is not finite or does not fit `Scalar`, a
/// face of fewer than three corners, or no face at all. No vertex and no face is skipped. Memory is linear in the size
/// of the file, whatever counts its header claims, and so is time but for concave polygons of many corners (n log n as
/// a rule, quadratic at worst).
///
/// PLY's triangle strips (element `tristrips`) become faces: each three indices in succession are one. Those that
/// repeat an index, with which a strip jumps to another place, are kept as faces of zero area, which nothing hits.
///
/// Materials are what OBJ says with `usemtl`. Groups are the solids of a text STL, and what OBJ says with `g` and `o`:
/// the last one of either kind before a face counts. OFF, PLY and binary STL have neither. A name is the text behind
/// its keyword, without the blanks around it and without a comment, byte for byte: `g hull deck` is one name. A name
/// that comes again has the same number. A keyword without a name ends the one before; a face that comes before the
/// first has none. Texture coordinates, normals, colours and smoothing groups are left out, and the files that `mtllib`
/// names are not opened.
template <class Scalar>
[[nodiscard]] PIERCE_EXPORT TriangleSoup<Scalar> read_mesh(const std::filesystem::path& path,
                                                           const ReadOptions& options = {});

extern template PIERCE_EXPORT TriangleSoup<float> read_mesh<float>(const std::filesystem::path&, const ReadOptions&);
extern template PIERCE_EXPORT TriangleSoup<double> read_mesh<double>(const std::filesystem::path&, const ReadOptions&);

}  // namespace pierce
