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
#include <pierce/result.h>
#include <pierce/types.h>
#include <pierce/world_answers.h>
#include <pierce/world_hit.h>

namespace pierce {

/// What a mesh is given when it is added.
template <class Scalar>
struct InstanceOptions {
    Pose<Scalar> pose = {};  ///< where it stands
    /// Bits that a query's mask is compared with (`WorldOptions::mask`).
    std::uint32_t layers = 0xffffffff;
    /// Bits of each face, by the caller's number; a face beyond its end has none. Null: those of all faces are set.
    /// Shared, not copied, and must not change while it is in use.
    std::shared_ptr<const std::vector<std::uint32_t>> face_layers = {};
};

/// What a world holds.
struct WorldStatistics {
    std::size_t meshes = 0;             ///< in it, each as often as it was added
    std::size_t triangles = 0;          ///< of all of them
    std::size_t depth = 0;              ///< of the tree over them: the most boxes on a path to a mesh
    std::size_t bytes = 0;              ///< that the world holds beside the meshes
    std::uint64_t invalid_queries = 0;  ///< queries so far with a coordinate that is NaN or infinite: they had no hit
};

/// A set of meshes. A mesh may be added many times: it is shared, and an instance takes some half a kilobyte.
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
///   exactly, but for winding numbers of open meshes, and for passages, which are of one mesh each.
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
/// A ball has the same radius in every mesh. What is decided, exactly, is the way of its center's image: so a ball
/// keeps its radius from the mesh itself, and from where that is in the world within the above. A radius is not
/// rounded, and what is near is looked for in boxes that allow for all of it; so nothing is missed, and what is
/// promised of a ball's way (`SphereHit`) holds in the coordinates of each mesh, and for chains of steps.
///
/// An image that is not a finite number (p and translation at the far ends of the number range) hits nothing of that
/// mesh.
///
/// **Meshes that deform.** The state at the end of a `DeformationStep` is a mesh like any other, and takes no build: it
/// lives as long as the step does.
///
///     const auto kept = std::make_shared<const pierce::DeformationStep<float>>(deforming.step());
///     world.replace(id, {kept, &kept->after()});
///
/// A world does not sweep through steps itself: times in several meshes would have to be put in exact order, and places
/// looked for that are clear in all of them. What goes from `at` to `to` during a step asks both, and takes a place
/// only where both say that the straight way there is clear, from the step's beginning to its end; so it gets through
/// none of them. `still` leaves out the meshes that deform, which have no pose here:
///
///     const auto clear = [&](const Vec3& place) {
///         return !world.any_hit({at, place}, {.mask = still}) && !step.any_hit({at, place});
///     };
///     std::vector<Vec3> places = {to};                // where both are clear; else where the first contact leaves it
///     for (const Vec3& target : {to, at}) {           // `at`: something that moves may come to what rests
///         if (const auto hit = world.first_hit({at, target}, {.mask = still})) places.push_back(hit->hit.point);
///         if (const auto hit = step.sweep({at, target})) places.push_back(hit->place);
///     }
///     places.push_back(at);
///     const auto place = std::find_if(places.begin(), places.end(), clear);  // none: it is squeezed between the two
///
/// **Threads.** Queries are const, noexcept and thread-safe, and allocate nothing. Changes must not run at the same
/// time as queries or other changes of the same world. A copy is a snapshot: it shares the meshes, takes time and
/// memory for the instances only, and can be asked while the original changes.
///
/// **Cost.** A tree of boxes over the meshes, changed in place: a query takes the logarithm of their number, and so
/// does a change, two or three microseconds (tests/bench/world). The box of a turned mesh is that of its own box,
/// turned. Answers do not depend on the order of changes. In the tips of spikes, where a mesh alone takes some ten
/// microseconds to find a point (`Hit::point`), a world may take milliseconds.
template <class Scalar>
class PIERCE_EXPORT World {
    static_assert(is_scalar_v<Scalar>, "pierce works in float or double");

  public:
    /// A mesh as worlds share it.
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
    /// from while it is in a world. One without triangles is fine, and is never hit.
    MeshId add(Mesh mesh, const InstanceOptions<Scalar>& options = {});
    /// Whether there was such a mesh. From then on its id is stale for ever: a place that was used 2^32 - 1 times is
    /// not used again.
    bool remove(MeshId id) noexcept;
    /// Another mesh in the same place: pose and layers stay. Throws std::invalid_argument, as the next three do, where
    /// the id is stale, or what is given is refused by `add`; then nothing has changed.
    void replace(MeshId id, Mesh mesh);
    /// Moves and turns it.
    void set_pose(MeshId id, const Pose<Scalar>& pose);
    /// The bits of the mesh (`InstanceOptions::layers`).
    void set_layers(MeshId id, std::uint32_t layers);
    /// The bits of its faces; null sets those of all.
    void set_face_layers(MeshId id, std::shared_ptr<const std::vector<std::uint32_t>> face_layers);

    /// `add` without exceptions. Where nothing was done `value` is `MeshId{}`, and `message` says why.
    [[nodiscard]] Result<MeshId> try_add(Mesh mesh, const InstanceOptions<Scalar>& options = {}) noexcept;
    /// As `try_add`, of `replace`.
    [[nodiscard]] Result<MeshId> try_replace(MeshId id, Mesh mesh) noexcept;
    /// As `try_add`, of `set_pose`.
    [[nodiscard]] Result<MeshId> try_set_pose(MeshId id, const Pose<Scalar>& pose) noexcept;
    /// As `try_add`, of `set_layers`.
    [[nodiscard]] Result<MeshId> try_set_layers(MeshId id, std::uint32_t layers) noexcept;
    /// As `try_add`, of `set_face_layers`.
    [[nodiscard]] Result<MeshId> try_set_face_layers(
        MeshId id, std::shared_ptr<const std::vector<std::uint32_t>> face_layers) noexcept;

    /// Whether the id is not stale.
    [[nodiscard]] bool holds(MeshId id) const noexcept;
    /// How many meshes there are, each as often as it was added.
    [[nodiscard]] std::size_t size() const noexcept;
    /// Null where the id is stale.
    [[nodiscard]] Mesh mesh(MeshId id) const noexcept;
    /// The local image of a point, as queries take it; NaN where the id is stale.
    [[nodiscard]] Vec3<Scalar> to_mesh(MeshId id, const Vec3<Scalar>& point) const noexcept;
    /// Where a point of a mesh is, rounded; NaN where the id is stale.
    [[nodiscard]] Vec3<Scalar> to_world(MeshId id, const Vec3<Scalar>& point) const noexcept;

    /// As in `CollisionMesh`, here and below. `Way`: a `Segment` or a `Ray`.
    [[nodiscard]] std::optional<WorldHit<Scalar>> first_hit(const Segment<Scalar>& segment,
                                                            const WorldOptions& options = {}) const noexcept;
    /// Whether anything is hit.
    [[nodiscard]] bool any_hit(const Segment<Scalar>& segment, const WorldOptions& options = {}) const noexcept;
    /// In order of (fraction, mesh, face, triangle).
    std::size_t all_hits(const Segment<Scalar>& segment, std::span<WorldHit<Scalar>> out,
                         const WorldOptions& options = {}) const noexcept;
    /// The sum over all meshes, each in its own coordinates: where all are closed, the difference of the winding
    /// numbers at the ends.
    [[nodiscard]] int crossings(const Segment<Scalar>& segment, const WorldCountOptions& options = {}) const noexcept;

    /// The same of a ray.
    template <std::same_as<Ray<Scalar>> Way>
    [[nodiscard]] std::optional<WorldHit<Scalar>> first_hit(const Way& ray,
                                                            const WorldOptions& options = {}) const noexcept {
        return first_hit_of_ray(ray, options);
    }
    /// Whether the ray hits anything.
    template <std::same_as<Ray<Scalar>> Way>
    [[nodiscard]] bool any_hit(const Way& ray, const WorldOptions& options = {}) const noexcept {
        return any_hit_of_ray(ray, options);
    }
    /// In order of (t, mesh, face, triangle).
    template <std::same_as<Ray<Scalar>> Way>
    std::size_t all_hits(const Way& ray, std::span<WorldHit<Scalar>> out,
                         const WorldOptions& options = {}) const noexcept {
        return all_hits_of_ray(ray, out, options);
    }
    /// The sum over all meshes.
    template <std::same_as<Ray<Scalar>> Way>
    [[nodiscard]] int crossings(const Way& ray, const WorldCountOptions& options = {}) const noexcept {
        return crossings_of_ray(ray, options);
    }

    /// As `first_hit` of a segment: `CollisionMesh::sweep` says what a particle does with the answer.
    [[nodiscard]] std::optional<WorldHit<Scalar>> sweep(const Segment<Scalar>& step,
                                                        const WorldOptions& options = {}) const noexcept {
        return first_hit(step, options);
    }

    /// As `CollisionMesh::passages`, of all meshes, in order of (fraction, mesh). Faces are taken together that are of
    /// one mesh: where meshes meet, each has a passage of its own. So the passages of each mesh are its own ones, and
    /// their `crossings` add up to those of the world.
    std::size_t passages(const Segment<Scalar>& segment, std::span<WorldPassage<Scalar>> out,
                         const WorldPassageOptions& options = {}, std::span<FaceTouch> faces = {}) const noexcept;

    /// The sum of the winding numbers of the point's images.
    [[nodiscard]] int winding_number(const Vec3<Scalar>& point, const WorldCountOptions& options = {}) const noexcept;
    /// Whether the winding number is not 0.
    [[nodiscard]] bool contains(const Vec3<Scalar>& point, const WorldCountOptions& options = {}) const noexcept;

    /// The meshes whose winding number at the point is not 0, by their index. Returns how many there are; the first
    /// ones go to `out`.
    std::size_t containing(const Vec3<Scalar>& point, std::span<MeshId> out,
                           const WorldCountOptions& options = {}) const noexcept;
    /// As `CollisionMesh::locate`: the winding number is that of the world, and the point is on the surface where its
    /// image in some mesh is on that of the mesh, exactly. `faces` are in order of (mesh, face, triangle). Of one mesh
    /// the same is `mesh(id)->locate(to_mesh(id, point))`.
    [[nodiscard]] Location locate(const Vec3<Scalar>& point, std::span<WorldTouch> faces = {},
                                  const WorldCountOptions& options = {}) const noexcept;

    /// As in `CollisionMesh`, with the images of `center` and of the step's ends, see above. `center` of a hit is
    /// verified in all meshes: sweeping the ball there has no hit. Between meshes the earlier time is first, as rounded
    /// down (`SphereHit::fraction` before it is a Scalar), then the lower `MeshId::index`; a contact that is at the
    /// start comes first, the deepest of them before others. Where no two of the mesh's and the query's lengths are
    /// 2^300 times as large as one another, answers do not depend on the order of changes.
    [[nodiscard]] std::optional<WorldSphereHit<Scalar>> sweep_sphere(const Segment<Scalar>& step, Scalar radius,
                                                                     const WorldOptions& options = {}) const noexcept;
    /// Contacts of each mesh by itself: an edge that two meshes share is one of each.
    std::size_t sphere_hits(const Segment<Scalar>& step, Scalar radius, std::span<WorldSphereHit<Scalar>> out,
                            const WorldOptions& options = {}) const noexcept;
    /// As in `CollisionMesh`, of each mesh by itself.
    std::size_t sphere_contacts(const Vec3<Scalar>& center, Scalar radius, std::span<WorldSphereHit<Scalar>> out,
                                const WorldOptions& options = {}) const noexcept;

    /// Why each face near the segment is its first hit or is not, in order of (mesh, triangle): of each mesh whose
    /// layers count what `CollisionMesh::explain` says of the image. For debugging: it looks at all faces.
    [[nodiscard]] std::vector<WorldFaceVerdict> explain(const Segment<Scalar>& segment,
                                                        const WorldOptions& options = {}) const;

    /// Batches: answer i is what the single call for number i gives, to the last bit, whatever the executor. Lengths
    /// that differ throw std::invalid_argument as in `CollisionMesh`. Queries of a part go one after the other. Return
    /// the number of hits, or of points contained.
    std::size_t first_hits(const Segments<Scalar>& segments, const WorldHitsOut<Scalar>& out,
                           const WorldOptions& options = {}, const Executor& executor = {}) const;
    /// An answer is 1 or 0.
    std::size_t any_hits(const Segments<Scalar>& segments, std::span<std::uint8_t> out,
                         const WorldOptions& options = {}, const Executor& executor = {}) const;
    /// `out[i]` is what `crossings` says.
    void crossings(const Segments<Scalar>& segments, std::span<int> out, const WorldCountOptions& options = {},
                   const Executor& executor = {}) const;
    /// The same as `first_hits`.
    std::size_t sweeps(const Segments<Scalar>& steps, const WorldHitsOut<Scalar>& out, const WorldOptions& options = {},
                       const Executor& executor = {}) const;
    /// Compressed rows, as `CollisionMesh::all_hits`.
    std::size_t all_hits(const Segments<Scalar>& segments, std::span<std::size_t> offsets,
                         std::span<WorldHit<Scalar>> hits, const WorldOptions& options = {},
                         const Executor& executor = {}) const;
    /// Many of `sweep_sphere`, all of one radius or each of its own.
    std::size_t sweep_spheres(const Segments<Scalar>& steps, Scalar radius,
                              std::span<std::optional<WorldSphereHit<Scalar>>> out, const WorldOptions& options = {},
                              const Executor& executor = {}) const;
    std::size_t sweep_spheres(const Segments<Scalar>& steps, std::span<const Scalar> radii,
                              std::span<std::optional<WorldSphereHit<Scalar>>> out, const WorldOptions& options = {},
                              const Executor& executor = {}) const;
    /// Compressed rows, of rays.
    template <detail::RaysOf<Scalar> Batch>
    std::size_t all_hits(const Batch& rays, std::span<std::size_t> offsets, std::span<WorldHit<Scalar>> hits,
                         const WorldOptions& options = {}, const Executor& executor = {}) const {
        return all_hits_of_rays(rays, offsets, hits, options, executor);
    }
    /// Of rays, as of segments.
    template <detail::RaysOf<Scalar> Batch>
    std::size_t first_hits(const Batch& rays, const WorldHitsOut<Scalar>& out, const WorldOptions& options = {},
                           const Executor& executor = {}) const {
        return first_hits_of_rays(rays, out, options, executor);
    }
    /// An answer is 1 or 0.
    template <detail::RaysOf<Scalar> Batch>
    std::size_t any_hits(const Batch& rays, std::span<std::uint8_t> out, const WorldOptions& options = {},
                         const Executor& executor = {}) const {
        return any_hits_of_rays(rays, out, options, executor);
    }
    /// `out[i]` is what `crossings` says.
    template <detail::RaysOf<Scalar> Batch>
    void crossings(const Batch& rays, std::span<int> out, const WorldCountOptions& options = {},
                   const Executor& executor = {}) const {
        crossings_of_rays(rays, out, options, executor);
    }
    /// `out[i]` is the winding number at point i.
    void winding_numbers(const PointsView<Scalar>& points, std::span<int> out, const WorldCountOptions& options = {},
                         const Executor& executor = {}) const;
    /// An answer is 1 or 0.
    std::size_t contains_points(const PointsView<Scalar>& points, std::span<std::uint8_t> out,
                                const WorldCountOptions& options = {}, const Executor& executor = {}) const;

    /// Returns the number of points that are on the surface.
    std::size_t locate_points(const PointsView<Scalar>& points, std::span<Location> out,
                              const WorldCountOptions& options = {}, const Executor& executor = {}) const;

    /// What it holds, counted anew, in linear time.
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

    std::size_t all_hits_of_rays(const Rays<Scalar>& rays, std::span<std::size_t> offsets,
                                 std::span<WorldHit<Scalar>> hits, const WorldOptions& options,
                                 const Executor& executor) const;

    struct PIERCE_HIDDEN Impl;
    std::unique_ptr<Impl> impl_;
};

extern template class PIERCE_EXPORT World<float>;
extern template class PIERCE_EXPORT World<double>;

}  // namespace pierce
