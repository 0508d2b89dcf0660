// A point against a mesh that turns: chord by chord.
#pragma once

#include <optional>

#include <pierce/options.h>
#include <pierce/rigid_hit.h>
#include <query/scene.h>
#include <rigid/turn.h>

namespace pierce::detail {

/// `start` and `end`: images of the way's ends, finite. `max_fraction` is not NaN. Not inlined: see engine.h.
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] std::optional<RigidHit<Scalar>> sweep_chords(const Scene<Scalar>& scene,
                                                                             const Turn& turn, const Point& start,
                                                                             const Point& end,
                                                                             const QueryOptions& options,
                                                                             QueryCounters& counters);

}  // namespace pierce::detail
