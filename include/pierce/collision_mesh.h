// A mesh made ready for queries: built once, then immutable and shared by threads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include <pierce/hit.h>
#include <pierce/mesh_view.h>
#include <pierce/options.h>
#include <pierce/types.h>

namespace pierce {

/// What was built, and what was odd about it. Bytes are those the library holds, all of them counted.
struct MeshStatistics {
    std::size_t vertices = 0;
    std::size_t faces = 0;      ///< of the caller: different numbers in `MeshView::faces`
    std::size_t triangles = 0;
    std::size_t degenerate = 0; ///< triangles of area exactly zero: kept, and never hit
    std::size_t duplicates = 0; ///< triangles with the same three corner positions as one before: kept
    std::array<std::uint32_t, 3> grid_cells = {0, 0, 0};
    std::size_t grid_references = 0; ///< entries of all cell lists together
    std::size_t bytes = 0;
    std::uint64_t invalid_queries = 0; ///< queries so far with a coordinate that is NaN or infinite: they had no hit
};

/// Triangles, prepared, in a uniform grid. Copies what it needs of the mesh.
///
/// Queries never throw, never assert and end for every input. The answer depends on the mesh and the segment only, to the
/// last bit: not on the grid, the threads, the machine or the order of queries.
template <class Scalar>
class CollisionMesh {
    static_assert(is_scalar_v<Scalar>, "pierce works in float or double");

  public:
    /// Throws `MeshError` when an index is out of range or a coordinate is not finite, naming the face or vertex, and
    /// when there are more than 2^32 - 2 vertices or triangles. A mesh without triangles is fine, and is never hit.
    explicit CollisionMesh(const MeshView<Scalar>& mesh, const BuildOptions& options = {});
    ~CollisionMesh();
    CollisionMesh(CollisionMesh&&) noexcept;
    CollisionMesh& operator=(CollisionMesh&&) noexcept;
    CollisionMesh(const CollisionMesh&) = delete;
    CollisionMesh& operator=(const CollisionMesh&) = delete;

    /// The hit with the exactly smallest fraction; between equal ones that of the smallest face, then triangle.
    [[nodiscard]] std::optional<Hit<Scalar>> first_hit(const Segment<Scalar>& segment,
                                                       const QueryOptions& options = {}) const noexcept;

    /// Whether there is any hit.
    [[nodiscard]] bool any_hit(const Segment<Scalar>& segment, const QueryOptions& options = {}) const noexcept;

    /// The first `out.size()` hits in order of (fraction, face, triangle), one for each triangle that is hit. Returns how
    /// many there are in all: if that is more than `out.size()`, the last ones were left out.
    std::size_t all_hits(const Segment<Scalar>& segment, std::span<Hit<Scalar>> out,
                         const QueryOptions& options = {}) const noexcept;

    /// A point moves in a straight line from `from` to `to` over one step: when and where does it first run into the mesh?
    /// If the answer is empty it may be moved to `to`; otherwise to the hit's `point`, and never further.
    [[nodiscard]] std::optional<SweepHit<Scalar>> sweep(const Vec3<Scalar>& from, const Vec3<Scalar>& to,
                                                        const QueryOptions& options = {}) const noexcept;

    [[nodiscard]] MeshStatistics statistics() const noexcept;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

extern template class CollisionMesh<float>;
extern template class CollisionMesh<double>;

}  // namespace pierce
