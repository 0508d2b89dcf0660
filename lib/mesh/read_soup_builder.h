// Where every reader puts its vertices and faces; cuts the polygons when all vertices are known.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <pierce/triangle_soup.h>

#include "mesh/read_names.h"
#include "mesh/read_source.h"

namespace pierce::detail {

/// Indices are 32 bits wide and the largest value is kept for "none".
inline constexpr std::uint64_t k_most_vertices_or_triangles = 0xFFFF'FFFE;

template <class Scalar>
class SoupBuilder {
  public:
    SoupBuilder(const SourceFile& file, const ReadOptions& options, std::uint64_t most = k_most_vertices_or_triangles)
        : file_(file), options_(options), most_(most) {}

    /// Only a reader that has compared the counts with the size of the file may reserve.
    void reserve(std::uint64_t vertices, std::uint64_t faces) {
        soup_.positions.reserve(static_cast<std::size_t>(vertices));
        soup_.triangles.reserve(static_cast<std::size_t>(faces));
    }

    [[nodiscard]] std::uint64_t vertex_count() const { return soup_.positions.size(); }
    /// Also the number of the next face.
    [[nodiscard]] std::uint64_t face_count() const { return soup_.face_count(); }
    [[nodiscard]] const Vec3<Scalar>& position(std::uint32_t vertex) const { return soup_.positions[vertex]; }

    void add_vertex(const Vec3<Scalar>& position) {
        if (soup_.positions.size() >= most_) {
            fail_too_many("vertices");
        }
        soup_.positions.push_back(position);
    }

    /// What the faces from here on are made of, and belong to; "" is nothing. Passed over unless it was asked for.
    void set_material(std::string_view name) {
        if (options_.materials) {
            materials_.select(name);
        }
    }
    void set_group(std::string_view name) {
        if (options_.groups) {
            groups_.select(name);
        }
    }

    /// Adds one face of at least three corners. The corners may name vertices that come later, and must be in range by
    /// the time of `finish`.
    void add_face(std::span<const std::uint32_t> corners);

    /// Cuts the polygons and hands the mesh over. Refuses a file that held no face.
    TriangleSoup<Scalar> finish();

  private:
    [[noreturn]] void fail_too_many(const char* what) const;

    // A polygon lies in `triangles` as a fan around its first corner from the start. So its corners need no room of
    // their own, and a convex polygon is already cut.
    struct Polygon {
        std::uint32_t first_triangle;
        std::uint32_t triangles;
    };

    const SourceFile& file_;
    ReadOptions options_;
    std::uint64_t most_;
    TriangleSoup<Scalar> soup_;
    std::vector<Polygon> polygons_;
    NameTable materials_;
    NameTable groups_;
};

extern template class SoupBuilder<float>;
extern template class SoupBuilder<double>;

}  // namespace pierce::detail
