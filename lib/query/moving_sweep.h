// The first contact of a moving point with a moving mesh: broadphase, comparisons, lib/motion's decision.
#pragma once

#include <optional>

#include <pierce/options.h>
#include <pierce/sweep_hit.h>
#include <query/moving_scene.h>

#include <motion/moving.h>

namespace pierce::detail {

/// A triangle that is met, and when.
struct MovingCandidate {
    MovingTriangle triangle;
    Impact impact;
    std::uint32_t number = 0;
    std::uint32_t face = 0;
};

/// Values of a contact, from its time to the nearest double: not certified.
struct MovingValues {
    double time = 0;  ///< rounded down
    Point position{};
    Point normal{};
    Point weights{};
    Point motion{};  ///< of the surface, over the step
};

[[nodiscard]] MovingPoint to_moving(const Point& from, const Point& to);

/// False: nothing is met that counts. The first is in `best`, by exact time, then face, then triangle. `any`: one that
/// counts will do.
template <class Scalar>
[[nodiscard]] bool first_contact(const MovingScene<Scalar>& scene, const MovingPoint& point,
                                 const QueryOptions& options, bool any, QueryCounters& counters, MovingCandidate& best);

[[nodiscard]] MovingValues values_of(const MovingPoint& point, Sides sides, const MovingCandidate& candidate);

/// The same values where the time is `time`.
[[nodiscard]] MovingValues values_at(const MovingPoint& point, const MovingCandidate& candidate, double time);

/// Where the point would be at the end of the step if it moved with the triangle from the start on: as far off its
/// plane, and above the same place of it. Where the triangle has no area at an end it is moved as the contact's place.
[[nodiscard]] Point carried(const MovingPoint& point, const MovingCandidate& candidate, const MovingValues& values);

/// Looks for a place at the end of the step; false where none is verified: then it is the start, carried
/// along.
template <class Scalar>
[[nodiscard]] bool find_place(const MovingScene<Scalar>& scene, const MovingPoint& point, const MovingCandidate& first,
                              const MovingValues& values, const QueryOptions& options, QueryCounters& counters,
                              Point& place);

/// All of a sweep, behind a call that is not inlined (engine.h). Coordinates are finite, `max_fraction` is not NaN.
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] std::optional<SweepHit<Scalar>> sweep(const MovingScene<Scalar>& scene,
                                                                      const Segment<Scalar>& way,
                                                                      const QueryOptions& options,
                                                                      QueryCounters& counters);
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] bool any_sweep(const MovingScene<Scalar>& scene, const Segment<Scalar>& way,
                                               const QueryOptions& options, QueryCounters& counters);

}  // namespace pierce::detail
