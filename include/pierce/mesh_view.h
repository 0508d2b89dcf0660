// A triangle mesh that somebody else owns: the only kind of mesh that the core knows.
#pragma once

#include <cstdint>
#include <cstring>
#include <iterator>
#include <span>

#include <pierce/mesh_error.h>
#include <pierce/points_view.h>
#include <pierce/types.h>

namespace pierce {

/// The corners of `size()` triangles, as indices of 32 bits, signed or not, or of 16: three in a row, and from one
/// triangle to the next a fixed number of bytes. A `std::vector<IndexTriple>`, the flat index buffer of a game (a list,
/// not a strip), or a part of either. Not owned, nothing is copied.
class TrianglesView {
  public:
    TrianglesView() = default;

    /// `stride`: bytes from one triangle's first index to the next one's. They need no alignment.
    TrianglesView(const std::uint32_t* first, std::size_t size, std::ptrdiff_t stride = 3 * sizeof(std::uint32_t))
        : first_(reinterpret_cast<const std::byte*>(first)), size_(size), stride_(stride) {}
    /// Signed ones, as in many programs: a negative one is out of range.
    TrianglesView(const std::int32_t* first, std::size_t size, std::ptrdiff_t stride = 3 * sizeof(std::int32_t))
        : first_(reinterpret_cast<const std::byte*>(first)), size_(size), stride_(stride) {}
    /// The same of 16 bits.
    TrianglesView(const std::uint16_t* first, std::size_t size, std::ptrdiff_t stride = 3 * sizeof(std::uint16_t))
        : first_(reinterpret_cast<const std::byte*>(first)), size_(size), stride_(stride), short_(true) {}

    /// A vector, an array or a span of triples.
    template <detail::SpanOf<IndexTriple> Range>
    TrianglesView(const Range& triangles)
        : TrianglesView(reinterpret_cast<const std::uint32_t*>(std::data(triangles)), std::size(triangles)) {}
    /// The same of triples of 16 bits.
    template <detail::SpanOf<std::array<std::uint16_t, 3>> Range>
    TrianglesView(const Range& triangles)
        : TrianglesView(reinterpret_cast<const std::uint16_t*>(std::data(triangles)), std::size(triangles)) {}

    /// Three indices a triangle. Building refuses a mesh that has some left.
    template <detail::SpanOf<std::uint32_t> Range>
    TrianglesView(const Range& indices) : TrianglesView(std::data(indices), std::size(indices) / 3) {
        left_over_ = std::size(indices) % 3;
    }
    template <detail::SpanOf<std::int32_t> Range>
    TrianglesView(const Range& indices) : TrianglesView(std::data(indices), std::size(indices) / 3) {
        left_over_ = std::size(indices) % 3;
    }
    template <detail::SpanOf<std::uint16_t> Range>
    TrianglesView(const Range& indices) : TrianglesView(std::data(indices), std::size(indices) / 3) {
        left_over_ = std::size(indices) % 3;
    }

    /// How many triangles there are.
    [[nodiscard]] std::size_t size() const { return size_; }
    /// Whether there are none.
    [[nodiscard]] bool empty() const { return size_ == 0; }
    /// Bytes from one triangle to the next.
    [[nodiscard]] std::ptrdiff_t stride() const { return stride_; }
    /// Where the first index is; null where indices have 16 bits.
    [[nodiscard]] const std::uint32_t* data() const {
        return short_ ? nullptr : reinterpret_cast<const std::uint32_t*>(first_);
    }
    /// How many indices of a flat array are too many for whole triangles, and too few for one more.
    [[nodiscard]] std::size_t left_over() const { return left_over_; }
    /// A copy of the corners of triangle i, which must be below `size()`.
    [[nodiscard]] IndexTriple operator[](std::size_t i) const {
        return short_ ? load<std::uint16_t>(i) : load<std::uint32_t>(i);
    }

  private:
    template <class Index>
    [[nodiscard]] IndexTriple load(std::size_t i) const {
        Index indices[3];
        std::memcpy(indices, first_ + static_cast<std::ptrdiff_t>(i) * stride_, sizeof indices);
        return {indices[0], indices[1], indices[2]};
    }

    const std::byte* first_ = nullptr;
    std::size_t size_ = 0;
    std::ptrdiff_t stride_ = 3 * sizeof(std::uint32_t);
    std::size_t left_over_ = 0;
    bool short_ = false;
};

/// Positions and triangles, not owned. It has to stay alive only while a `CollisionMesh` is built from it.
///
///     const MeshView<float> view{positions, triangles};         // vectors of Vec3<float> and IndexTriple
///     const MeshView<float> level{{&vertices[0].x, vertices.size(), sizeof(Vertex)}, indices};  // a game's buffers
///
/// The mesh may be open, non-manifold, self-intersecting, and may hold zero-area or duplicate triangles: all are kept.
/// `faces`, if it is not empty, gives for each triangle the number that the caller knows it by (the polygon of a file
/// that it was cut from, the handle of a half-edge mesh with holes in its numbering); several triangles may share one.
/// If it is empty, a triangle's number is its place in `triangles`.
template <class Scalar>
struct MeshView {
    static_assert(is_scalar_v<Scalar>, "pierce works in float or double");

    PointsView<Scalar> positions;               ///< of the vertices, in any unit of length
    TrianglesView triangles;                    ///< corners as indices of `positions`
    std::span<const std::uint32_t> faces = {};  ///< the caller's number of each triangle, or empty

    /// The number that hits name a triangle by.
    [[nodiscard]] std::uint32_t face_of(std::size_t triangle) const {
        return faces.empty() ? static_cast<std::uint32_t>(triangle) : faces[triangle];
    }
};

}  // namespace pierce
