// A mesh made ready for queries: built once, then immutable and shared by threads.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <pierce/explain.h>
#include <pierce/hit.h>
#include <pierce/mesh_report.h>
#include <pierce/mesh_view.h>
#include <pierce/options.h>
#include <pierce/ray.h>
#include <pierce/types.h>

namespace pierce {

template <class Scalar>
class Regions;

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
    std::string_view backend;        ///< the instruction set of the wide kernels
    std::size_t bytes = 0;
    std::uint64_t invalid_queries = 0; ///< queries so far with a coordinate that is NaN or infinite: they had no hit
};

/// Points as the columns of a matrix; a block or a map of one as well, if its columns are contiguous.
template <class Scalar>
using Points = Eigen::Ref<const Eigen::Matrix<Scalar, 3, Eigen::Dynamic>, 0, Eigen::OuterStride<>>;

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

    /// The first `out.size()` hits in order of (fraction, face, triangle), one for each triangle that is hit. Returns
    /// how many there are in all: if that is more than `out.size()`, the last ones were left out. Each point is
    /// verified on its own way from the start, so the time is quadratic in the number of hits kept; with an empty `out`
    /// they are only counted.
    std::size_t all_hits(const Segment<Scalar>& segment, std::span<Hit<Scalar>> out,
                         const QueryOptions& options = {}) const noexcept;

    /// The same for a ray (`Ray` says what it is). `fraction`, `exact_fraction`, `max_fraction` and `Contact::fraction`
    /// are then the ray's t, the exact one within 1 ulp, or the largest number where t is above it. The rules are those
    /// of the segment that ends at the ray's true end, and so are the promises: the way from `origin` to the hit's
    /// `point` has no hit, so that a chain of rays from point to point cannot get through a closed surface. A ray costs
    /// what the part of it in the mesh's box costs. (Templates, so that `first_hit({from, to})` is a segment.)
    template <std::same_as<Ray<Scalar>> Way>
    [[nodiscard]] std::optional<Hit<Scalar>> first_hit(const Way& ray, const QueryOptions& options = {}) const noexcept {
        return first_hit_of_ray(ray, options);
    }
    template <std::same_as<Ray<Scalar>> Way>
    [[nodiscard]] bool any_hit(const Way& ray, const QueryOptions& options = {}) const noexcept {
        return any_hit_of_ray(ray, options);
    }
    template <std::same_as<Ray<Scalar>> Way>
    std::size_t all_hits(const Way& ray, std::span<Hit<Scalar>> out, const QueryOptions& options = {}) const noexcept {
        return all_hits_of_ray(ray, out, options);
    }
    template <std::same_as<Ray<Scalar>> Way>
    [[nodiscard]] int crossings(const Way& ray, QueryCounters* counters = nullptr) const noexcept {
        return crossings_of_ray(ray, counters);
    }

    /// A point moves in a straight line from `from` to `to` over one step: when and where does it first run into the
    /// mesh? If the answer is empty it may be moved to `to`; otherwise to the hit's `point`, and never further.
    [[nodiscard]] std::optional<SweepHit<Scalar>> sweep(const Vec3<Scalar>& from, const Vec3<Scalar>& to,
                                                        const QueryOptions& options = {}) const noexcept;

    /// Many queries in one call: `out[i]` is what the single query for number i gives, to the last bit, whatever the
    /// executor and however the queries are cut into calls. With the tree sixteen queries go on together, each while
    /// others wait for memory; where it has more than 16 nodes on a path, one after the other. Returns the number of
    /// hits. Allocates nothing. `out` must be as long as the queries are many; if it is not, std::invalid_argument is
    /// thrown.
    std::size_t first_hits(std::span<const Segment<Scalar>> segments, std::span<std::optional<Hit<Scalar>>> out,
                           const BatchOptions& options = {}) const;
    std::size_t any_hits(std::span<const Segment<Scalar>> segments, std::span<std::uint8_t> out,
                         const BatchOptions& options = {}) const;
    std::size_t sweep_points(std::span<const Vec3<Scalar>> from, std::span<const Vec3<Scalar>> to,
                             std::span<std::optional<SweepHit<Scalar>>> out, const BatchOptions& options = {}) const;

    /// The same for points as the columns of matrices, which may be blocks or maps of others.
    std::size_t first_hits(const Points<Scalar>& from, const Points<Scalar>& to,
                           std::span<std::optional<Hit<Scalar>>> out, const BatchOptions& options = {}) const;
    std::size_t any_hits(const Points<Scalar>& from, const Points<Scalar>& to, std::span<std::uint8_t> out,
                         const BatchOptions& options = {}) const;
    std::size_t sweep_points(const Points<Scalar>& from, const Points<Scalar>& to,
                             std::span<std::optional<SweepHit<Scalar>>> out, const BatchOptions& options = {}) const;

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
    std::optional<Hit<Scalar>> first_hit_of_ray(const Ray<Scalar>& ray, const QueryOptions& options) const noexcept;
    bool any_hit_of_ray(const Ray<Scalar>& ray, const QueryOptions& options) const noexcept;
    std::size_t all_hits_of_ray(const Ray<Scalar>& ray, std::span<Hit<Scalar>> out,
                                const QueryOptions& options) const noexcept;
    int crossings_of_ray(const Ray<Scalar>& ray, QueryCounters* counters) const noexcept;

    friend class Regions<Scalar>;

    struct Impl;
    std::unique_ptr<Impl> impl_;
};

extern template class CollisionMesh<float>;
extern template class CollisionMesh<double>;

}  // namespace pierce
