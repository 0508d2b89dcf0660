// A mesh made ready for queries: built once, then immutable and shared by threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <pierce/batch.h>
#include <pierce/executor.h>
#include <pierce/explain.h>
#include <pierce/hit.h>
#include <pierce/mesh_report.h>
#include <pierce/mesh_view.h>
#include <pierce/options.h>
#include <pierce/result.h>
#include <pierce/types.h>

namespace pierce {

/// What was built, and what was odd about it. Bytes are those the library holds, all of them counted.
struct MeshStatistics {
    std::size_t vertices = 0;
    std::size_t faces = 0;      ///< of the caller: different numbers in `MeshView::faces`
    std::size_t triangles = 0;
    std::size_t degenerate = 0; ///< triangles of area exactly zero: kept, and never hit
    std::size_t clusters = 0;        ///< records of up to eight triangles
    Broadphase broadphase = Broadphase::tree;
    std::size_t nodes = 0;           ///< of the tree; 0 with a grid
    double cell_size = 0;            ///< of the grid; 0 with a tree
    std::size_t grid_references = 0; ///< entries of all its cell lists together
    std::string_view backend;        ///< the instruction set of the wide kernels; empty if nothing was built
    std::size_t bytes = 0;           ///< 0 if nothing was built
    std::uint64_t invalid_queries = 0; ///< queries so far with a coordinate that is NaN or infinite: they had no hit
};

/// Triangles in a broadphase (`BuildOptions`). Copies what it needs of the mesh.
///
/// Queries never throw, never assert and end for every input. The answer depends on the mesh and the segment only, to
/// the last bit: not on the broadphase, the threads, the machine or the order of queries. One end may be as far away as
/// numbers go; where both are further from the mesh than some 10^9 times its size, boxes are told apart less and less
/// well, and queries get slower.
template <class Scalar>
class CollisionMesh {
    static_assert(is_scalar_v<Scalar>, "pierce works in float or double");

  public:
    /// Throws `MeshError` when an index is out of range or a coordinate is not finite, naming the face or vertex, and
    /// when there are more than 2^32 - 2 vertices or 2^28 - 1 triangles; std::invalid_argument where a name or number
    /// of an option has no meaning. A mesh without triangles is fine, and is never hit.
    explicit CollisionMesh(const MeshView<Scalar>& mesh, const BuildOptions& options = {});
    /// The same without exceptions: an empty mesh, a status and the exception's text where the constructor throws.
    [[nodiscard]] static Result<CollisionMesh> try_make(const MeshView<Scalar>& mesh,
                                                        const BuildOptions& options = {}) noexcept;
    /// A mesh without triangles, as one that was moved from is: it is never hit, and counts nothing. Allocates nothing.
    CollisionMesh() noexcept;
    /// The same, for `CollisionMesh<float> mesh({{}, {}})`, which could mean a view or a mesh.
    CollisionMesh(std::initializer_list<std::nullptr_t>) noexcept : CollisionMesh() {}
    ~CollisionMesh();
    CollisionMesh(CollisionMesh&& other) noexcept;
    CollisionMesh& operator=(CollisionMesh&& other) noexcept;
    CollisionMesh(const CollisionMesh&) = delete;
    CollisionMesh& operator=(const CollisionMesh&) = delete;

    /// The hit with the exactly smallest fraction; between equal ones that of the smallest face, then triangle.
    [[nodiscard]] std::optional<Hit<Scalar>> first_hit(const Segment<Scalar>& segment,
                                                       const QueryOptions& options = {}) const noexcept;

    /// Whether there is any hit.
    [[nodiscard]] bool any_hit(const Segment<Scalar>& segment, const QueryOptions& options = {}) const noexcept;

    /// The first `out.size()` hits in order of (fraction, face, triangle), one for each triangle that is hit. Returns
    /// how many there are in all: if that is more than `out.size()`, the last ones were left out. Each point is
    /// verified on its own way from the start, so the time is quadratic in the number of hits kept; with an empty `out`
    /// they are only counted. `exact_fraction` never decreases from one hit to the next, and hits at exactly the same
    /// fraction have the same bits there.
    std::size_t all_hits(const Segment<Scalar>& segment, std::span<Hit<Scalar>> out,
                         const QueryOptions& options = {}) const noexcept;

    /// A point moves in a straight line from `step.from` to `step.to`: when and where does it first run into the mesh?
    /// If the answer is empty it may be moved to `to`; otherwise to the hit's `point`, and never further. The hit's
    /// `fraction` is the time of impact: the part of the step after which the point is still certainly outside.
    [[nodiscard]] std::optional<Hit<Scalar>> sweep(const Segment<Scalar>& step,
                                                   const QueryOptions& options = {}) const noexcept {
        return first_hit(step, options);
    }

    /// Many queries in one call: answer i is what the single query for number i gives, to the last bit, whatever the
    /// executor and however the queries are cut into calls. With an executor they are answered in parallel, in parts of
    /// a thousand or so. With the tree sixteen queries go on together, each while others wait for memory; where it has
    /// more than 16 nodes on a path, one after the other. Returns the number of hits. Allocates nothing.
    ///
    /// Throws std::invalid_argument, naming the call and both lengths, where there are not as many starts as ends, or
    /// not as many places for answers as segments; nothing is written then. A program without exceptions ends there.
    std::size_t first_hits(const Segments<Scalar>& segments, const HitsOut<Scalar>& out,
                           const QueryOptions& options = {}, const Executor& executor = {}) const;
    std::size_t sweeps(const Segments<Scalar>& steps, const HitsOut<Scalar>& out, const QueryOptions& options = {},
                       const Executor& executor = {}) const;
    /// An answer is 1 or 0.
    std::size_t any_hits(const Segments<Scalar>& segments, std::span<std::uint8_t> out,
                         const QueryOptions& options = {}, const Executor& executor = {}) const;

    /// How often the segment passes through the surface: +1 for each crossing from the front to the back of a face, -1
    /// for each from back to front. Another rule than that for hits: the ends are taken as moved by an infinitesimal
    /// step that is the same for all queries, so that every crossing belongs to exactly one face, also through edges
    /// and vertices. On a closed, consistently oriented mesh the result is the winding number at `to` less that at
    /// `from`. Not finite: 0.
    [[nodiscard]] int crossings(const Segment<Scalar>& segment, QueryCounters* counters = nullptr) const noexcept;

    /// How many times the surface winds around the point: 1 inside of a closed mesh whose faces look outwards, 0
    /// outside. A point of the surface itself is taken as moved as in `crossings`. On an open mesh the answer is that
    /// of one way out, along an axis; see `mesh_report`. Not finite: 0.
    [[nodiscard]] int winding_number(const Vec3<Scalar>& point, QueryCounters* counters = nullptr) const noexcept;

    /// Whether the winding number is not 0.
    [[nodiscard]] bool contains(const Vec3<Scalar>& point, QueryCounters* counters = nullptr) const noexcept;

    /// Why each face near the segment is its first hit or is not, in the order of triangles. Near are those whose box
    /// is no further from the segment's, along each axis, than that is long along its longest. For debugging: it looks
    /// at all faces, in exact arithmetic where boxes overlap, and takes memory for the answer.
    [[nodiscard]] std::vector<FaceVerdict> explain(const Segment<Scalar>& segment,
                                                   const QueryOptions& options = {}) const;

    /// What is odd about the mesh, and whether it can keep particles in. Computed anew by each call, on one thread.
    /// On a closed mesh in about the time of a build (n log n for n triangles around one vertex). Each border edge
    /// takes the logarithm of the number of border vertices, and more where it passes close to many: as long as the
    /// mesh, about the cube root of their number, the square root if all lie in a plane, at worst all of them.
    [[nodiscard]] MeshReport mesh_report() const;

    [[nodiscard]] MeshStatistics statistics() const noexcept;

  private:
    struct Impl;
    struct Release {
        void operator()(Impl* impl) const noexcept;
    };
    std::unique_ptr<Impl, Release> impl_;  ///< never null: that of a mesh which was not built is shared by all such
};

extern template class CollisionMesh<float>;
extern template class CollisionMesh<double>;

}  // namespace pierce
