// A mesh made ready for queries: built once, then immutable and shared by threads.
#pragma once

#include <concepts>
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
#include <pierce/export.h>
#include <pierce/hit.h>
#include <pierce/location.h>
#include <pierce/mesh_report.h>
#include <pierce/mesh_view.h>
#include <pierce/motion_sweeps.h>
#include <pierce/options.h>
#include <pierce/passage.h>
#include <pierce/ray.h>
#include <pierce/result.h>
#include <pierce/sphere.h>
#include <pierce/types.h>

namespace pierce {

template <class Scalar>
class Regions;

template <class Scalar>
class DeformationStep;
template <class Scalar>
class DeformingMesh;

namespace detail {
struct Inside;
}

/// What was built, and what was odd about it. Bytes are those the library holds, all of them counted.
struct MeshStatistics {
    std::size_t vertices = 0;                  ///< positions, used or not
    std::size_t faces = 0;                     ///< of the caller: different numbers in `MeshView::faces`
    std::size_t triangles = 0;                 ///< all of them, those without area too
    std::size_t degenerate = 0;                ///< triangles of area exactly zero: kept, and never hit
    std::size_t clusters = 0;                  ///< records of up to eight triangles
    Broadphase broadphase = Broadphase::tree;  ///< what was chosen: `tree` or `grid`
    std::size_t nodes = 0;                     ///< of the tree; 0 with a grid
    double cell_size = 0;                      ///< of the grid; 0 with a tree
    std::size_t grid_references = 0;           ///< entries of all its cell lists together
    std::string_view backend;                  ///< the instruction set of the wide kernels; empty if nothing was built
    std::size_t bytes = 0;                     ///< 0 if nothing was built
    std::uint64_t invalid_queries = 0;  ///< queries so far with a coordinate that is NaN or infinite: they had no hit
};

/// Triangles in a broadphase (`BuildOptions`). Copies what it needs of the mesh.
///
/// Queries never throw, never assert and end for every input. The answer depends on the mesh and the segment only, to
/// the last bit: not on the broadphase, the threads, the machine or the order of queries. Ends may be as far away as
/// numbers go. Where both are further from the mesh than some 10^10 times its size, the values of a hit take exact
/// arithmetic in double, some 7 us a hit; `any_hit` and misses cost what they cost from near.
///
/// As a rule a query takes the logarithm of the number of triangles, and more for what it comes near; at worst it looks
/// at all of them.
template <class Scalar>
class PIERCE_EXPORT CollisionMesh : public MotionSweeps<Scalar> {
    static_assert(is_scalar_v<Scalar>, "pierce works in float or double");

  public:
    /// Throws `MeshError` where an index is out of range or a coordinate not finite, naming it; for more than 2^32 - 2
    /// vertices or 2^28 - 1 triangles; and for a flat mesh that is 2^122 (double: 2^1018) of its sizes from the origin.
    /// std::invalid_argument: an option has no meaning. A mesh without triangles is fine, and is never hit. Takes
    /// n log n time for n triangles.
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

    /// New positions for all vertices, in the order of those that the mesh was built from: triangles, faces and their
    /// numbers stay. Records and bounds are written again where they are, without a new order, in a quarter of the time
    /// of a build. Every query answers as a mesh does that is built from these positions, to the last bit, and errors
    /// are those of the constructor; only counters differ, and the time, which grows as the mesh leaves the shape that
    /// it was built in: `refit_cost` says by how much. A mesh in which a triangle has an area that had none when it was
    /// built, or none has any more, is built anew instead.
    ///
    /// Nobody may ask the mesh anything meanwhile (`DeformingMesh` has states that stay). Throws std::invalid_argument
    /// where there are not as many positions as vertices, `MeshError` for one that is not finite, and the mesh stays as
    /// it was; where memory runs out it has no triangles any more. The first call makes 40 bytes a triangle.
    void refit(const PointsView<Scalar>& positions, const Executor& executor = {});
    /// The same where only some vertices moved: of `positions`, which has all, only those of `changed` are looked at,
    /// and the others are where they were. The time is that of the clusters around them, and of the nodes above these.
    /// std::invalid_argument: there is no vertex of that number. The first call makes 20 bytes a triangle more.
    void refit(const PointsView<Scalar>& positions, std::span<const std::uint32_t> changed);
    /// The same as `refit`, by a build: in the time of the constructor, less a copy of the triangles, or in half of it
    /// where triangles that were near one another still are, and are kept together (for seven calls in a row at most).
    void rebuild(const PointsView<Scalar>& positions, const Executor& executor = {});
    /// What a query may be expected to go through, in nodes and clusters by the areas of their boxes (the surface area
    /// heuristic, Goldsmith and Salmon 1987), in parts of what it was when the mesh was built: 1 without a refit since
    /// then, and for a grid. From 1.5 or 2 on a rebuild pays where some queries are asked for each face: it costs as
    /// much as some 200 ns of queries a face. Linear in the size of the tree.
    [[nodiscard]] double refit_cost() const noexcept;

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

    /// The same for a ray (`Ray` says what it is). `fraction`, `exact_fraction`, `max_fraction` and `Contact::fraction`
    /// are then the ray's t, the exact one within 1 ulp, or the largest number where t is above it. The rules are those
    /// of the segment that ends at the ray's true end, and so are the promises: the way from `origin` to the hit's
    /// `point` has no hit, so that a chain of rays from point to point cannot get through a closed surface. A ray
    /// visits what the part of it in the mesh's box visits, from origins up to some 2^80 mesh sizes away; what a hit's
    /// values cost from far away is said above. (Templates, so that `first_hit({from, to})` is a segment.)
    template <std::same_as<Ray<Scalar>> Way>
    [[nodiscard]] std::optional<Hit<Scalar>> first_hit(const Way& ray,
                                                       const QueryOptions& options = {}) const noexcept {
        return first_hit_of_ray(ray, options);
    }
    /// Whether the ray hits anything.
    template <std::same_as<Ray<Scalar>> Way>
    [[nodiscard]] bool any_hit(const Way& ray, const QueryOptions& options = {}) const noexcept {
        return any_hit_of_ray(ray, options);
    }
    /// As `all_hits` of a segment.
    template <std::same_as<Ray<Scalar>> Way>
    std::size_t all_hits(const Way& ray, std::span<Hit<Scalar>> out, const QueryOptions& options = {}) const noexcept {
        return all_hits_of_ray(ray, out, options);
    }
    /// As `crossings` of a segment.
    template <std::same_as<Ray<Scalar>> Way>
    [[nodiscard]] int crossings(const Way& ray, QueryCounters* counters = nullptr) const noexcept {
        return crossings_of_ray(ray, counters);
    }

    /// A point moves in a straight line from `step.from` to `step.to`: when and where does it first run into the mesh?
    /// If the answer is empty it may be moved to `to`; otherwise to the hit's `point`, and never further. The hit's
    /// `fraction` is the time of impact: the part of the step after which the point is still certainly outside.
    [[nodiscard]] std::optional<Hit<Scalar>> sweep(const Segment<Scalar>& step,
                                                   const QueryOptions& options = {}) const noexcept {
        return first_hit(step, options);
    }

    /// The same for a mesh that moves or turns meanwhile, single and in batches: `MotionSweeps` has them.
    using MotionSweeps<Scalar>::sweep;
    using MotionSweeps<Scalar>::sweeps;

    /// Many queries in one call: answer i is what the single query for number i gives, to the last bit, whatever the
    /// executor and however the queries are cut into calls. With an executor they are answered in parallel, in parts of
    /// a thousand or so. With the tree sixteen queries go on together, each while others wait for memory; where it has
    /// more than 16 nodes on a path, one after the other. Returns the number of hits. Allocates nothing.
    ///
    /// Throws std::invalid_argument, naming the call and both lengths, where there are not as many starts as ends, or
    /// not as many places for answers as segments; nothing is written then. A program without exceptions ends there.
    std::size_t first_hits(const Segments<Scalar>& segments, const HitsOut<Scalar>& out,
                           const QueryOptions& options = {}, const Executor& executor = {}) const;
    /// The same as `first_hits`, for steps of moving points.
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

    /// The first `out.size()` places where the segment passes through the surface or touches it, in exact order, the
    /// faces of each taken together (`Passage`). Returns how many there are in all, unless `count_all` is false. The
    /// faces of passage p go to `faces[p.first_face]` and so on, `p.face_count` of them in order of (face, triangle),
    /// if all of them fit. The time is that of one traversal for each 32 passages, and as much again for `faces`.
    std::size_t passages(const Segment<Scalar>& segment, std::span<Passage<Scalar>> out,
                         const PassageOptions& options = {}, std::span<FaceTouch> faces = {}) const noexcept;

    /// How many times the surface winds around the point: 1 inside of a closed mesh whose faces look outwards, 0
    /// outside. A point of the surface itself is taken as moved as in `crossings`. On an open mesh the answer is that
    /// of one way out, along an axis; see `mesh_report`. Not finite: 0.
    [[nodiscard]] int winding_number(const Vec3<Scalar>& point, QueryCounters* counters = nullptr) const noexcept;

    /// Whether the winding number is not 0.
    [[nodiscard]] bool contains(const Vec3<Scalar>& point, QueryCounters* counters = nullptr) const noexcept;

    /// Whether the point is outside, inside or on the surface, exactly, with its winding number. The triangles that it
    /// lies on go to `faces` in order of (face, triangle), as many of them as fit; `Location::face_count` has how many
    /// there are. The time is that of `winding_number` and of a look at the triangles near the point.
    [[nodiscard]] Location locate(const Vec3<Scalar>& point, std::span<FaceTouch> faces = {},
                                  QueryCounters* counters = nullptr) const noexcept;

    /// Many questions in one call: `out[i]` is what the single call for number i gives, to the last bit, whatever the
    /// executor. With the tree sixteen queries go on together, as in `first_hits`, and lengths that differ are an error
    /// in the same way.
    ///
    /// Returns the number of points that are contained; `out[i]` is 1 for these, else 0. Points that are given in no
    /// order are sorted first: then this one and `winding_numbers` take 16 bytes of memory a point while they run, 16
    /// MiB at most. The others allocate nothing.
    std::size_t contains_points(const PointsView<Scalar>& points, std::span<std::uint8_t> out,
                                QueryCounters* counters = nullptr, const Executor& executor = {}) const;
    /// `out[i]` is the winding number at point i.
    void winding_numbers(const PointsView<Scalar>& points, std::span<int> out, QueryCounters* counters = nullptr,
                         const Executor& executor = {}) const;
    /// Returns the number of points that are on the surface.
    std::size_t locate_points(const PointsView<Scalar>& points, std::span<Location> out,
                              QueryCounters* counters = nullptr, const Executor& executor = {}) const;
    /// `out[i]` is what `crossings` of segment i says.
    void crossings(const Segments<Scalar>& segments, std::span<int> out, QueryCounters* counters = nullptr,
                   const Executor& executor = {}) const;

    /// All hits of many segments as compressed rows: those of segment i, in order, are `hits[offsets[i]]` up to
    /// `hits[offsets[i + 1]]`, without that. `offsets` must be one longer than `segments`. Returns how many hits there
    /// are in all, `offsets.back()`. The hits of a segment are written if all of them fit: call with no `hits` to learn
    /// how many there are, which is much faster than writing them, make room, and call again. Allocates nothing.
    std::size_t all_hits(const Segments<Scalar>& segments, std::span<std::size_t> offsets, std::span<Hit<Scalar>> hits,
                         const QueryOptions& options = {}, const Executor& executor = {}) const;

    /// Batches of rays: a vector or span of them, or `first_hits(Rays(origins, directions), out)`.
    template <detail::RaysOf<Scalar> Batch>
    std::size_t first_hits(const Batch& rays, const HitsOut<Scalar>& out, const QueryOptions& options = {},
                           const Executor& executor = {}) const {
        return first_hits_of_rays(rays, out, options, executor);
    }
    /// An answer is 1 or 0.
    template <detail::RaysOf<Scalar> Batch>
    std::size_t any_hits(const Batch& rays, std::span<std::uint8_t> out, const QueryOptions& options = {},
                         const Executor& executor = {}) const {
        return any_hits_of_rays(rays, out, options, executor);
    }
    /// `out[i]` is what `crossings` of ray i says.
    template <detail::RaysOf<Scalar> Batch>
    void crossings(const Batch& rays, std::span<int> out, QueryCounters* counters = nullptr,
                   const Executor& executor = {}) const {
        crossings_of_rays(rays, out, counters, executor);
    }
    /// Compressed rows, as of segments.
    template <detail::RaysOf<Scalar> Batch>
    std::size_t all_hits(const Batch& rays, std::span<std::size_t> offsets, std::span<Hit<Scalar>> hits,
                         const QueryOptions& options = {}, const Executor& executor = {}) const {
        return all_hits_of_rays(rays, offsets, hits, options, executor);
    }

    /// A ball of this radius moves in a straight line, its center from `step.from` to `step.to`: when and where does it
    /// first run into the mesh? `SphereHit` says what that means and what is promised. If the answer is empty the
    /// center may be moved to `to`, otherwise to the hit's `center`. Where several triangles stop it at the start, the
    /// one that it overlaps most is named. A radius that is not finite, not a number or not more than 0 makes the query
    /// invalid, as a coordinate that is not finite does: it has no hit and is counted. `options.sides` is not looked
    /// at. Costs grow with the number of triangles that come within the radius of the way.
    [[nodiscard]] std::optional<SphereHit<Scalar>> sweep_sphere(const Segment<Scalar>& step, Scalar radius,
                                                                const QueryOptions& options = {}) const noexcept;

    /// The first `out.size()` contacts of the step in order of (fraction, face, triangle), each as if nothing had
    /// stopped the ball before it; returns how many there are in all. Each contact comes once: an edge or a corner that
    /// several triangles share is that of one of them, as are triangles that coincide, and it is left out where one of
    /// its triangles was hit on its face, or before. Takes time in the number of triangles hit times that of those
    /// around a vertex.
    std::size_t sphere_hits(const Segment<Scalar>& step, Scalar radius, std::span<SphereHit<Scalar>> out,
                            const QueryOptions& options = {}) const noexcept;

    /// The same for a ball that does not move: contacts with triangles that are no further from `center` than the
    /// radius, decided exactly, the deepest first as far as a Scalar can tell their overlaps apart. An edge or a corner
    /// is left out where one of its triangles is nearer elsewhere. A radius of 2^300 mesh sizes and more overlaps
    /// everything alike in double: contacts may then be left out for others.
    std::size_t sphere_contacts(const Vec3<Scalar>& center, Scalar radius, std::span<SphereHit<Scalar>> out,
                                const QueryOptions& options = {}) const noexcept;

    /// Many sweeps in one call: answer i is what `sweep_sphere` gives for number i, whatever the executor. All have one
    /// radius, or each its own. Returns the number of hits. Throws std::invalid_argument where lengths differ, as
    /// `first_hits`.
    std::size_t sweep_spheres(const Segments<Scalar>& steps, Scalar radius,
                              std::span<std::optional<SphereHit<Scalar>>> out, const QueryOptions& options = {},
                              const Executor& executor = {}) const;
    std::size_t sweep_spheres(const Segments<Scalar>& steps, std::span<const Scalar> radii,
                              std::span<std::optional<SphereHit<Scalar>>> out, const QueryOptions& options = {},
                              const Executor& executor = {}) const;

    /// Why each face near the segment is its first hit or is not, in the order of triangles. Near are those whose box
    /// is no further from the segment's, along each axis, than that is long along its longest. For debugging: it looks
    /// at all faces, in exact arithmetic where boxes overlap, and takes memory for the answer.
    [[nodiscard]] std::vector<FaceVerdict> explain(const Segment<Scalar>& segment,
                                                   const QueryOptions& options = {}) const;

    /// What is odd about the mesh, and whether it can keep particles in. Computed anew by each call, on one thread.
    /// On a closed mesh in about the time of a build, at most three times that (n log n for n triangles around one
    /// vertex). Each border edge takes the logarithm of the number of border vertices, and more where it passes close
    /// to many: as long as the mesh, about the cube root of their number, the square root if all lie in a plane, at
    /// worst all of them.
    [[nodiscard]] MeshReport mesh_report() const;

    /// What was built, and how many queries were invalid so far. Takes constant time.
    [[nodiscard]] MeshStatistics statistics() const noexcept;

  private:
    std::optional<Hit<Scalar>> first_hit_of_ray(const Ray<Scalar>& ray, const QueryOptions& options) const noexcept;
    bool any_hit_of_ray(const Ray<Scalar>& ray, const QueryOptions& options) const noexcept;
    std::size_t all_hits_of_ray(const Ray<Scalar>& ray, std::span<Hit<Scalar>> out,
                                const QueryOptions& options) const noexcept;
    int crossings_of_ray(const Ray<Scalar>& ray, QueryCounters* counters) const noexcept;
    std::size_t first_hits_of_rays(const Rays<Scalar>& rays, const HitsOut<Scalar>& out, const QueryOptions& options,
                                   const Executor& executor) const;
    std::size_t any_hits_of_rays(const Rays<Scalar>& rays, std::span<std::uint8_t> out, const QueryOptions& options,
                                 const Executor& executor) const;
    void crossings_of_rays(const Rays<Scalar>& rays, std::span<int> out, QueryCounters* counters,
                           const Executor& executor) const;
    std::size_t all_hits_of_rays(const Rays<Scalar>& rays, std::span<std::size_t> offsets, std::span<Hit<Scalar>> hits,
                                 const QueryOptions& options, const Executor& executor) const;

    friend class Regions<Scalar>;
    friend struct detail::Inside;  // for rooms that stand on the queries (lib/query/inside.h)
    friend class DeformationStep<Scalar>;
    friend class DeformingMesh<Scalar>;

    struct PIERCE_HIDDEN Impl;
    struct PIERCE_HIDDEN Release {
        void operator()(Impl* impl) const noexcept;
    };
    std::unique_ptr<Impl, Release> impl_;  ///< never null: that of a mesh which was not built is shared by all such
};

extern template class PIERCE_EXPORT CollisionMesh<float>;
extern template class PIERCE_EXPORT CollisionMesh<double>;

}  // namespace pierce
