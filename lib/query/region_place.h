// Where a particle is put that comes to a face: before it or beyond it.
#pragma once

#include <query/region_walk.h>

namespace pierce::detail {

/// Regions::stop and Regions::cross. `way`: a Segment or a Ray of Scalar that is valid; `leg`: the first of its walk.
template <class Scalar, class Way>
[[nodiscard]] [[gnu::noinline]] RegionPlace<Scalar> stop(const RegionScene<Scalar>& regions, const Way& way,
                                                         const Leg<Scalar>& leg, QueryCounters& counters);
template <class Scalar, class Way>
[[nodiscard]] [[gnu::noinline]] RegionPlace<Scalar> cross(const RegionScene<Scalar>& regions, const Way& way,
                                                          const Leg<Scalar>& leg, QueryCounters& counters);

}  // namespace pierce::detail
