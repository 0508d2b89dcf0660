// Sweeps against a mesh that keeps its shape and moves during the step: what `CollisionMesh` has of them.
#pragma once

#include <concepts>
#include <cstddef>
#include <optional>
#include <span>

#include <pierce/batch.h>
#include <pierce/executor.h>
#include <pierce/export.h>
#include <pierce/motion.h>
#include <pierce/options.h>
#include <pierce/rigid_hit.h>
#include <pierce/sweep_hit.h>
#include <pierce/types.h>

namespace pierce {

/// A part of `CollisionMesh`. A point goes straight from `way.from` to `way.to`, in the world, while the mesh moves:
/// the first contact in time; between equal ones that of the smallest face, then triangle. If the answer is empty the
/// point may be moved to `to`, otherwise to the hit's `place`, which is one for the end of the step. In a chain of
/// steps each begins where the one before ended, point and mesh: then it cannot get through a closed mesh without a hit
/// (lib/rigid/README.md has the proof). `QueryOptions::max_fraction` and `Contact::fraction` are times, in parts of the
/// step.
///
/// Total and noexcept as all queries. (Templates, so that `sweep(step, {})` is the one of a mesh that stands still.)
template <class Scalar>
class PIERCE_EXPORT MotionSweeps {
  public:
    /// The mesh moves without a turn: exactly the difference of the two motions, decided on the coordinates as they are
    /// given, by the rules of `Hit` for the way from `way.from - motion.from` to `way.to - motion.to`. Where one of
    /// these is beyond the range of `Scalar` the query is invalid: it has no hit, and is counted.
    template <std::same_as<Translation<Scalar>> Motion>
    [[nodiscard]] std::optional<SweepHit<Scalar>> sweep(const Segment<Scalar>& way, const Motion& motion,
                                                        const QueryOptions& options = {}) const noexcept {
        return sweep_straight(way, motion, options);
    }

    /// The mesh turns: within a tolerance of the true motion (`RigidMotion`), and exact where it comes to chains of
    /// steps. Takes one query of a mesh that stands still for each chord that comes near the mesh's box. Invalid where
    /// an image is not finite, or the curve is as large as numbers are.
    template <std::same_as<RigidMotion> Motion>
    [[nodiscard]] std::optional<RigidHit<Scalar>> sweep(const Segment<Scalar>& way, const Motion& motion,
                                                        const QueryOptions& options = {}) const noexcept {
        return sweep_turning(way, motion, options);
    }
    template <std::same_as<Ride<Scalar>> Way, std::same_as<RigidMotion> Motion>
    [[nodiscard]] std::optional<RigidHit<Scalar>> sweep(const Way& way, const Motion& motion,
                                                        const QueryOptions& options = {}) const noexcept {
        return sweep_turning(way, motion, options);
    }

    /// Many of them: answer i is that of the single query for number i, to the last bit, whatever the executor. Returns
    /// the number of hits. Throws std::invalid_argument where lengths differ; nothing is written then.
    template <std::same_as<Translation<Scalar>> Motion>
    std::size_t sweeps(const Segments<Scalar>& ways, const Motion& motion,
                       std::span<std::optional<SweepHit<Scalar>>> out, const QueryOptions& options = {},
                       const Executor& executor = {}) const {
        return sweeps_straight(ways, motion, out, options, executor);
    }
    template <std::same_as<RigidMotion> Motion>
    std::size_t sweeps(const Segments<Scalar>& ways, const Motion& motion,
                       std::span<std::optional<RigidHit<Scalar>>> out, const QueryOptions& options = {},
                       const Executor& executor = {}) const {
        return sweeps_turning(ways, motion, out, options, executor);
    }

  protected:
    MotionSweeps() = default;
    ~MotionSweeps() = default;
    MotionSweeps(const MotionSweeps&) = default;
    MotionSweeps& operator=(const MotionSweeps&) = default;

  private:
    std::optional<SweepHit<Scalar>> sweep_straight(const Segment<Scalar>& way, const Translation<Scalar>& motion,
                                                   const QueryOptions& options) const noexcept;
    std::optional<RigidHit<Scalar>> sweep_turning(const Segment<Scalar>& way, const RigidMotion& motion,
                                                  const QueryOptions& options) const noexcept;
    std::optional<RigidHit<Scalar>> sweep_turning(const Ride<Scalar>& way, const RigidMotion& motion,
                                                  const QueryOptions& options) const noexcept;
    std::size_t sweeps_straight(const Segments<Scalar>& ways, const Translation<Scalar>& motion,
                                std::span<std::optional<SweepHit<Scalar>>> out, const QueryOptions& options,
                                const Executor& executor) const;
    std::size_t sweeps_turning(const Segments<Scalar>& ways, const RigidMotion& motion,
                               std::span<std::optional<RigidHit<Scalar>>> out, const QueryOptions& options,
                               const Executor& executor) const;
};

extern template class PIERCE_EXPORT MotionSweeps<float>;
extern template class PIERCE_EXPORT MotionSweeps<double>;

}  // namespace pierce
