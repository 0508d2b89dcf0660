// A point against a mesh that moves without a turn: seen from the mesh the point goes straight, between ends that are
// differences of two points each. Decided exactly about these.
#pragma once

#include <optional>

#include <exact/difference.h>
#include <kernel/verdict.h>
#include <pierce/motion.h>
#include <pierce/options.h>
#include <pierce/sweep_hit.h>
#include <query/scene.h>

namespace pierce::detail {

/// A difference of two points as a sum: `high` rounded to double, `low` the rest, exactly (Moller 1965, Knuth 1969).
struct SplitPoint {
    Point high;
    Point low;
};

struct Glide {
    DifferencePath path;
    SplitPoint from;
    SplitPoint to;
};

/// The way of a point relative to the mesh. False: a difference is beyond the range of `Scalar`, or not a number.
template <class Scalar>
[[nodiscard]] bool set_glide(const Segment<Scalar>& way, const Translation<Scalar>& motion, Glide& glide);

/// Never wrong about a hit, on the open face, or a miss; the interval contains the exact fraction of a hit, and of what
/// is doubtful.
[[nodiscard]] Filtered filter(const Glide& glide, const Corners& corners, Sides sides);

/// All of a sweep. `max_fraction` is not NaN. Sets `valid`. Not inlined: see engine.h.
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] std::optional<SweepHit<Scalar>> sweep_glide(const Scene<Scalar>& scene,
                                                                            const Segment<Scalar>& way,
                                                                            const Translation<Scalar>& motion,
                                                                            const QueryOptions& options,
                                                                            QueryCounters& counters, bool& valid);

}  // namespace pierce::detail
