// A mesh whose vertices move: from step to step, and in each step straight from their old to their new positions.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include <pierce/batch.h>
#include <pierce/collision_mesh.h>
#include <pierce/executor.h>
#include <pierce/export.h>
#include <pierce/mesh_view.h>
#include <pierce/options.h>
#include <pierce/pose.h>
#include <pierce/sweep_hit.h>
#include <pierce/types.h>

namespace pierce {

/// One step of a deforming mesh: where its vertices were, where they go, and all that is asked of it. It stays as it is
/// for as long as anybody holds a copy, whatever the mesh goes on to: copies are cheap (a shared pointer), and any
/// number of threads may ask any of them. One that is made without a mesh has no triangles.
///
/// Queries never throw, never assert and end for every input; NaN or infinity hits nothing.
template <class Scalar>
class PIERCE_EXPORT DeformationStep {
  public:
    DeformationStep() noexcept;
    ~DeformationStep();
    DeformationStep(const DeformationStep&) noexcept;
    DeformationStep(DeformationStep&&) noexcept;
    DeformationStep& operator=(const DeformationStep&) noexcept;
    DeformationStep& operator=(DeformationStep&&) noexcept;

    /// The mesh as it stands still at the beginning: every query that `CollisionMesh` has.
    [[nodiscard]] const CollisionMesh<Scalar>& before() const noexcept;
    /// The same at the end.
    [[nodiscard]] const CollisionMesh<Scalar>& after() const noexcept;

    /// A point goes from `way.from` to `way.to` while the mesh goes from `before` to `after`: the first contact in
    /// time; between equal ones that of the smallest face, then triangle. `SweepHit` says what counts, and where the
    /// point may be put. If the answer is empty the point may be moved to `to`. `QueryOptions::max_fraction` is a time.
    [[nodiscard]] std::optional<SweepHit<Scalar>> sweep(const Segment<Scalar>& way,
                                                        const QueryOptions& options = {}) const noexcept;
    /// Whether there is any contact.
    [[nodiscard]] bool any_hit(const Segment<Scalar>& way, const QueryOptions& options = {}) const noexcept;

    /// Answer i is that of the single query for number i, to the last bit, whatever the executor. Returns the number of
    /// hits. Throws std::invalid_argument where lengths differ; nothing is written then.
    std::size_t sweeps(const Segments<Scalar>& ways, std::span<std::optional<SweepHit<Scalar>>> out,
                       const QueryOptions& options = {}, const Executor& executor = {}) const;

  private:
    template <class>
    friend class DeformingMesh;
    friend struct detail::Inside;  // for rooms that stand on the queries (lib/query/inside.h)
    struct PIERCE_HIDDEN Impl;
    PIERCE_HIDDEN explicit DeformationStep(std::shared_ptr<const Impl> impl) noexcept;
    std::shared_ptr<const Impl> impl_;  ///< null: no triangles
};

/// What may be chosen when a `DeformingMesh` is made.
struct DeformationOptions {
    /// How the static meshes of both ends are built; the executor is that of the first build only.
    BuildOptions build = {};
    /// A new order of the triangles is made where a query may be expected to cost so many times what it did when the
    /// last one was made (`CollisionMesh::refit_cost`). Infinity: never, NaN too. 1 or less: in each step.
    double rebuild_above = 2;
};

/// Holds the current step, and makes the next one.
///
/// **Threads.** One thread at a time calls `begin_step`. All other calls may come from any thread at any time, also
/// while a step is made: they see the step before until the new one is complete, and never a part of it. A thread that
/// asks more than one question of one step takes `step()` once and asks that: between two calls on the mesh itself a
/// new step may come. A step's memory is used again for a later one when nobody holds it any more.
template <class Scalar>
class PIERCE_EXPORT DeformingMesh {
    static_assert(is_scalar_v<Scalar>, "pierce works in float or double");

  public:
    /// The first step is one in which nothing moves. Copies what it needs of the mesh. Throws as `CollisionMesh` does.
    explicit DeformingMesh(const MeshView<Scalar>& mesh, const DeformationOptions& options = {});
    ~DeformingMesh();
    DeformingMesh(DeformingMesh&&) noexcept;
    DeformingMesh& operator=(DeformingMesh&&) noexcept;
    DeformingMesh(const DeformingMesh&) = delete;
    DeformingMesh& operator=(const DeformingMesh&) = delete;

    /// The next step leads from where the current one ends to these positions, in the order of the mesh's vertices.
    /// Triangles and their numbers stay. Bounds are written again without a new order, in some two thirds of the time
    /// of a build. Throws std::invalid_argument where there are not as many positions as vertices, `MeshError` for one
    /// that is not finite, or std::bad_alloc; the current step stays then.
    void begin_step(const PointsView<Scalar>& positions, const Executor& executor = {});

    /// The next step leads to a pose of the mesh as it was built: each vertex is put there, computed in double and
    /// rounded, and goes straight in between. All answers are exact about these positions and these ways, so nothing
    /// leaks from step to step. They are not those of the rigid motion: a vertex that turns by an angle a in a step, at
    /// a distance r from the axis, leaves its arc by r (1 - cos(a / 2)), and the mesh shrinks by as much in the middle
    /// of the step; halve the step where that is too much.
    void begin_step(const Pose<double>& pose, const Executor& executor = {});

    /// The current step.
    [[nodiscard]] DeformationStep<Scalar> step() const noexcept;

    /// What the current step says, for single questions.
    [[nodiscard]] std::optional<SweepHit<Scalar>> sweep(const Segment<Scalar>& way,
                                                        const QueryOptions& options = {}) const noexcept {
        return step().sweep(way, options);
    }
    /// The same for many.
    std::size_t sweeps(const Segments<Scalar>& ways, std::span<std::optional<SweepHit<Scalar>>> out,
                       const QueryOptions& options = {}, const Executor& executor = {}) const {
        return step().sweeps(ways, out, options, executor);
    }

  private:
    struct PIERCE_HIDDEN Impl;
    std::unique_ptr<Impl> impl_;
};

extern template class PIERCE_EXPORT DeformationStep<float>;
extern template class PIERCE_EXPORT DeformationStep<double>;
extern template class PIERCE_EXPORT DeformingMesh<float>;
extern template class PIERCE_EXPORT DeformingMesh<double>;

}  // namespace pierce
