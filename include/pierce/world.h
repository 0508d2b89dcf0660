// Many meshes: each where its pose puts it, all of them asked at once.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <pierce/batch.h>
#include <pierce/collision_mesh.h>
#include <pierce/executor.h>
#include <pierce/export.h>
#include <pierce/pose.h>
#include <pierce/ray.h>
#include <pierce/types.h>
#include <pierce/world_hit.h>

namespace pierce {

/// What a mesh is given when it is added.
template <class Scalar>
struct InstanceOptions {
    Pose<Scalar> pose = {};
    /// Bits that a query's mask is compared with (`WorldOptions::mask`).
    std::uint32_t layers = 0xffffffff;
    /// Bits of each face, by the caller's number; a face beyond its end has none. Null: those of all faces are set.
    /// Shared, not copied, and must not change while it is in use.
    std::shared_ptr<const std::vector<std::uint32_t>> face_layers = {};
};

struct WorldStatistics {
    std::size_t meshes = 0;             ///< in it, each as often as it was added
    std::size_t triangles = 0;          ///< of all of them
    std::size_t depth = 0;              ///< of the tree over them: the most boxes on a path to a mesh
    std::size_t bytes = 0;              ///< that the world holds beside the meshes
    std::uint64_t invalid_queries = 0;  ///< queries so far with a coordinate that is NaN or infinite: they had no hit
};

/// A set of meshes. A mesh may be added many times: it is shared, and an instance takes some 300 bytes.
///
/// **What is decided.** A world point p has a local image in each mesh, the point that stands for it there:
///
///     L(p) = rotation^T (p - translation)
///
/// by one fixed formula in double, rounded to Scalar: `to_mesh` gives it. It has the same bits on every machine. For a
/// segment, a mesh is hit as `CollisionMesh` is by the segment between the images of the ends: exactly. Where hits of
/// several meshes are compared, it is by the exact fractions of their own local segments; equal ones go to the lower
/// `MeshId::index`, then face, then triangle. So:
///
/// - A mesh without a pose has L(p) = p. A world of such meshes answers as one mesh of all their triangles would,
///   exactly, winding numbers of open meshes excepted.
/// - A mesh that is only translated has for L(p) the difference, rounded once (float: to double, then to float). Where
///   p - translation is a number of the type, as on a lattice, the decision is exact in the world too. So it is for
///   rotations that only swap axes and signs.
/// - For other poses L is off by rounding: L(p) stands for a world point within 2^-46 |p - translation| of p for
///   double, and 2^-23 |p - translation| for float (derived in lib/rigid/placement.h).
/// - An image depends on the point alone. So a chain of steps p0 -> p1 -> p2 is a connected chain in the coordinates of
///   each mesh, and can't get through a closed one, however it is turned, as long as its pose stays.
/// - `Hit::point` is verified by the same rule: in no mesh has the way from L(from) to L(point) a hit that counts. As
///   in `Hit`, `point` keeps a grain off the face's plane, or as far as `from` was. The grain of an instance is four
///   units in the last place of the largest coordinate that it has in the world or in itself. For one that has a pose
///   half a grain may be lost to rounding, and for double the grain is four times as large. `position` and `normal` are
///   those in the mesh, taken to the world and rounded.
///
/// A ray is `origin` and `direction`: the image of the latter is rotated only, and rounded. Its parameters are compared
/// as they are.
///
/// An image that is not a finite number (p and translation at the far ends of the number range) hits nothing of that
/// mesh.
///
/// **Threads.** Queries are const, noexcept and thread-safe, and allocate nothing. Changes must not run at the same
/// time as queries or other changes of the same world. A copy is a snapshot: it shares the meshes, takes time and
/// memory for the instances only, and can be asked while the original changes.
///
/// **Cost.** A tree of boxes over the meshes, changed in place: a query takes the logarithm of their number, and so
/// does a change, one or two microseconds (tests/bench/world). The box of a turned mesh is that of its own box, turned.
/// Answers do not depend on the order of changes. In the tips of spikes, where a mesh alone takes some ten microseconds
/// to find a point (`Hit::point`), a world may take milliseconds.
template <class Scalar>
class PIERCE_EXPORT World {
    static_assert(is_scalar_v<Scalar>, "pierce works in float or double");

  public:
    using Mesh = std::shared_ptr<const CollisionMesh<Scalar>>;

    /// Without a mesh: nothing is hit.
    World();
    ~World();
    World(const World& other);
    World& operator=(const World& other);
    /// What was moved from can be assigned to and destroyed, no more.
    World(World&& other) noexcept;
    World& operator=(World&& other) noexcept;

    /// Throws std::invalid_argument where the mesh is null or the pose is none (`Pose`). The mesh must not be moved
    /// from while it is in a world. One without triangles is fine, and is never hit. A mesh that deforms is a new
    /// `CollisionMesh` a step, given to `replace`.
    MeshId add(Mesh mesh, const InstanceOptions<Scalar>& options = {});
    /// Whether there was such a mesh. From then on its id is stale for ever: a place that was used 2^32 - 1 times is
    /// not used again.
    bool remove(MeshId id) noexcept;
    /// These throw std::invalid_argument where the id is stale, or what is given is refused by `add`; then nothing has
    /// changed. Pose and layers stay when a mesh is replaced.
    void replace(MeshId id, Mesh mesh);
    void set_pose(MeshId id, const Pose<Scalar>& pose);
    void set_layers(MeshId id, std::uint32_t layers);
    void set_face_layers(MeshId id, std::shared_ptr<const std::vector<std::uint32_t>> face_layers);

    [[nodiscard]] bool holds(MeshId id) const noexcept;
    [[nodiscard]] std::size_t size() const noexcept;
    /// Null where the id is stale.
    [[nodiscard]] Mesh mesh(MeshId id) const noexcept;
    /// The local image of a point, as queries take it; NaN where the id is stale.
    [[nodiscard]] Vec3<Scalar> to_mesh(MeshId id, const Vec3<Scalar>& point) const noexcept;
    /// Where a point of a mesh is, rounded; NaN where the id is stale.
    [[nodiscard]] Vec3<Scalar> to_world(MeshId id, const Vec3<Scalar>& point) const noexcept;

    /// As in `CollisionMesh`. `Way`: a `Segment` or a `Ray`.
    [[nodiscard]] std::optional<WorldHit<Scalar>> first_hit(const Segment<Scalar>& segment,
                                                            const WorldOptions& options = {}) const noexcept;
    [[nodiscard]] bool any_hit(const Segment<Scalar>& segment, const WorldOptions& options = {}) const noexcept;
    /// In order of (fraction, mesh, face, triangle).
    std::size_t all_hits(const Segment<Scalar>& segment, std::span<WorldHit<Scalar>> out,
                         const WorldOptions& options = {}) const noexcept;
    /// The sum over all meshes, each in its own coordinates: where all are closed, the difference of the winding
    /// numbers at the ends.
    [[nodiscard]] int crossings(const Segment<Scalar>& segment, const WorldCountOptions& options = {}) const noexcept;

    template <std::same_as<Ray<Scalar>> Way>
    [[nodiscard]] std::optional<WorldHit<Scalar>> first_hit(const Way& ray,
                                                            const WorldOptions& options = {}) const noexcept {
        return first_hit_of_ray(ray, options);
    }
    template <std::same_as<Ray<Scalar>> Way>
    [[nodiscard]] bool any_hit(const Way& ray, const WorldOptions& options = {}) const noexcept {
        return any_hit_of_ray(ray, options);
    }
    template <std::same_as<Ray<Scalar>> Way>
    std::size_t all_hits(const Way& ray, std::span<WorldHit<Scalar>> out,
                         const WorldOptions& options = {}) const noexcept {
        return all_hits_of_ray(ray, out, options);
    }
    template <std::same_as<Ray<Scalar>> Way>
    [[nodiscard]] int crossings(const Way& ray, const WorldCountOptions& options = {}) const noexcept {
        return crossings_of_ray(ray, options);
    }

    /// The sum of the winding numbers of the point's images.
    [[nodiscard]] int winding_number(const Vec3<Scalar>& point, const WorldCountOptions& options = {}) const noexcept;
    /// Whether the winding number is not 0.
    [[nodiscard]] bool contains(const Vec3<Scalar>& point, const WorldCountOptions& options = {}) const noexcept;

    /// Batches: answer i is what the single call for number i gives, to the last bit, whatever the executor. Lengths
    /// that differ throw std::invalid_argument as in `CollisionMesh`. Queries of a part go one after the other. Return
    /// the number of hits, or of points contained.
    std::size_t first_hits(const Segments<Scalar>& segments, const WorldHitsOut<Scalar>& out,
                           const WorldOptions& options = {}, const Executor& executor = {}) const;
    std::size_t any_hits(const Segments<Scalar>& segments, std::span<std::uint8_t> out,
                         const WorldOptions& options = {}, const Executor& executor = {}) const;
    void crossings(const Segments<Scalar>& segments, std::span<int> out, const WorldCountOptions& options = {},
                   const Executor& executor = {}) const;
    template <detail::RaysOf<Scalar> Batch>
    std::size_t first_hits(const Batch& rays, const WorldHitsOut<Scalar>& out, const WorldOptions& options = {},
                           const Executor& executor = {}) const {
        return first_hits_of_rays(rays, out, options, executor);
    }
    template <detail::RaysOf<Scalar> Batch>
    std::size_t any_hits(const Batch& rays, std::span<std::uint8_t> out, const WorldOptions& options = {},
                         const Executor& executor = {}) const {
        return any_hits_of_rays(rays, out, options, executor);
    }
    template <detail::RaysOf<Scalar> Batch>
    void crossings(const Batch& rays, std::span<int> out, const WorldCountOptions& options = {},
                   const Executor& executor = {}) const {
        crossings_of_rays(rays, out, options, executor);
    }
    void winding_numbers(const PointsView<Scalar>& points, std::span<int> out, const WorldCountOptions& options = {},
                         const Executor& executor = {}) const;
    std::size_t contains_points(const PointsView<Scalar>& points, std::span<std::uint8_t> out,
                                const WorldCountOptions& options = {}, const Executor& executor = {}) const;

    [[nodiscard]] WorldStatistics statistics() const noexcept;

  private:
    std::optional<WorldHit<Scalar>> first_hit_of_ray(const Ray<Scalar>& ray,
                                                     const WorldOptions& options) const noexcept;
    bool any_hit_of_ray(const Ray<Scalar>& ray, const WorldOptions& options) const noexcept;
    std::size_t all_hits_of_ray(const Ray<Scalar>& ray, std::span<WorldHit<Scalar>> out,
                                const WorldOptions& options) const noexcept;
    int crossings_of_ray(const Ray<Scalar>& ray, const WorldCountOptions& options) const noexcept;
    std::size_t first_hits_of_rays(const Rays<Scalar>& rays, const WorldHitsOut<Scalar>& out,
                                   const WorldOptions& options, const Executor& executor) const;
    std::size_t any_hits_of_rays(const Rays<Scalar>& rays, std::span<std::uint8_t> out, const WorldOptions& options,
                                 const Executor& executor) const;
    void crossings_of_rays(const Rays<Scalar>& rays, std::span<int> out, const WorldCountOptions& options,
                           const Executor& executor) const;

    struct PIERCE_HIDDEN Impl;
    std::unique_ptr<Impl> impl_;
};

extern template class PIERCE_EXPORT World<float>;
extern template class PIERCE_EXPORT World<double>;

}  // namespace pierce
