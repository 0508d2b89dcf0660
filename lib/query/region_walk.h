// The legs of a flight.
#pragma once

#include <span>

#include <pierce/regions.h>
#include <query/region_scene.h>

namespace pierce::detail {

/// Which legs there are: `region`, `next`, `face`, `triangle`, `side` and `consistent` of each. Where it ends before
/// `out` does, the last one has no face, and no region where it is the only one.
template <class Scalar>
std::size_t find_legs(const RegionScene<Scalar>& regions, const Path& path, std::span<Leg<Scalar>> out,
                      QueryCounters& counters);

/// Of a point that is finite.
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] std::uint32_t region_at(const RegionScene<Scalar>& regions, const Point& point,
                                                        QueryCounters& counters);

/// `Way`: a Segment or a Ray of Scalar that is valid.
template <class Scalar, class Way>
[[gnu::noinline]] std::size_t walk(const RegionScene<Scalar>& regions, const Way& way, std::span<Leg<Scalar>> out,
                                   QueryCounters& counters);

}  // namespace pierce::detail
