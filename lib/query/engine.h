// The queries themselves, behind a call that the compiler does not inline: the caller has made the arithmetic standard
// (environment.h), in which even the conversion of a float to double matters, and has seen that every coordinate is
// finite and `max_fraction` is not NaN.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <pierce/explain.h>
#include <pierce/hit.h>
#include <query/scene.h>
#include <query/ways.h>

namespace pierce::detail {

// `Way`: a Segment or a Ray of Scalar.
template <class Scalar, class Way>
[[gnu::noinline]] std::optional<Hit<Scalar>> first_hit(const Scene<Scalar>& scene, const Way& way,
                                                       const QueryOptions& options, QueryCounters& counters);

template <class Scalar, class Way>
[[gnu::noinline]] bool any_hit(const Scene<Scalar>& scene, const Way& way, const QueryOptions& options,
                               QueryCounters& counters);

/// Queries `first` to `last` of a batch. Those that are not valid count as `invalid`. Returns the number of hits.
template <class Scalar>
[[gnu::noinline]] std::size_t first_hits(const Scene<Scalar>& scene, const Ways<Scalar>& ways, std::size_t first,
                                         std::size_t last, const HitsOut<Scalar>& out, const QueryOptions& options,
                                         QueryCounters& counters, std::size_t& invalid);
template <class Scalar>
[[gnu::noinline]] std::size_t any_hits(const Scene<Scalar>& scene, const Ways<Scalar>& ways, std::size_t first,
                                       std::size_t last, std::uint8_t* out, const QueryOptions& options,
                                       QueryCounters& counters, std::size_t& invalid);

template <class Scalar, class Way>
[[gnu::noinline]] std::size_t all_hits(const Scene<Scalar>& scene, const Way& way, std::span<Hit<Scalar>> out,
                                       const QueryOptions& options, QueryCounters& counters);

template <class Scalar, class Way>
[[gnu::noinline]] int crossings(const Scene<Scalar>& scene, const Way& way, QueryCounters& counters);

template <class Scalar>
[[gnu::noinline]] int winding_number(const Scene<Scalar>& scene, const Vec3<Scalar>& point, QueryCounters& counters);

template <class Scalar>
[[gnu::noinline]] std::vector<FaceVerdict> explain(const Scene<Scalar>& scene, const Segment<Scalar>& segment,
                                                   const QueryOptions& options, QueryCounters& counters);

}  // namespace pierce::detail
