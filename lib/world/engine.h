// The queries of a world, behind a call that the compiler does not inline: as query/engine.h, whose conditions hold.
#pragma once

#include <optional>
#include <span>

#include <world/instances.h>

namespace pierce::detail {

// `Way`: a Segment or a Ray of Scalar.
template <class Scalar, class Way>
[[gnu::noinline]] std::optional<WorldHit<Scalar>> first_hit(const WorldScene<Scalar>& world, const Way& way,
                                                            const WorldOptions& options, QueryCounters& counters);

template <class Scalar, class Way>
[[gnu::noinline]] bool any_hit(const WorldScene<Scalar>& world, const Way& way, const WorldOptions& options,
                               QueryCounters& counters);

template <class Scalar, class Way>
[[gnu::noinline]] std::size_t all_hits(const WorldScene<Scalar>& world, const Way& way, std::span<WorldHit<Scalar>> out,
                                       const WorldOptions& options, QueryCounters& counters);

template <class Scalar, class Way>
[[gnu::noinline]] int crossings(const WorldScene<Scalar>& world, const Way& way, std::uint32_t mask,
                                QueryCounters& counters);

}  // namespace pierce::detail
