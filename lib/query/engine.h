// The queries themselves, behind a call that the compiler does not inline: the caller has made the arithmetic standard
// (environment.h), in which even the conversion of a float to double matters, and has seen that every coordinate is
// finite and `max_fraction` is not NaN.
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include <pierce/batch.h>
#include <pierce/explain.h>
#include <pierce/hit.h>
#include <query/scene.h>

namespace pierce::detail {

template <class Scalar>
[[gnu::noinline]] std::optional<Hit<Scalar>> first_hit(const Scene<Scalar>& scene, const Segment<Scalar>& segment,
                                                       const QueryOptions& options, QueryCounters& counters);

template <class Scalar>
[[gnu::noinline]] bool any_hit(const Scene<Scalar>& scene, const Segment<Scalar>& segment, const QueryOptions& options,
                               QueryCounters& counters);

/// Whether the ends of query i are numbers.
template <class Scalar>
[[nodiscard]] bool is_finite(const Segments<Scalar>& segments, std::size_t i) {
    const auto finite = [](const Vec3<Scalar>& x) {
        return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
    };
    return finite(segments.starts()[i]) && finite(segments.ends()[i]);
}

/// Queries `first` to `last`. Those that are not finite count as `invalid`. Returns the number of hits.
template <class Scalar>
[[gnu::noinline]] std::size_t first_hits(const Scene<Scalar>& scene, const Segments<Scalar>& segments,
                                         std::size_t first, std::size_t last, const HitsOut<Scalar>& out,
                                         const QueryOptions& options, QueryCounters& counters, std::size_t& invalid);
template <class Scalar>
[[gnu::noinline]] std::size_t any_hits(const Scene<Scalar>& scene, const Segments<Scalar>& segments, std::size_t first,
                                       std::size_t last, std::uint8_t* out, const QueryOptions& options,
                                       QueryCounters& counters, std::size_t& invalid);

template <class Scalar>
[[gnu::noinline]] std::size_t all_hits(const Scene<Scalar>& scene, const Segment<Scalar>& segment,
                                       std::span<Hit<Scalar>> out, const QueryOptions& options,
                                       QueryCounters& counters);

template <class Scalar>
[[gnu::noinline]] int crossings(const Scene<Scalar>& scene, const Segment<Scalar>& segment, QueryCounters& counters);

template <class Scalar>
[[gnu::noinline]] int winding_number(const Scene<Scalar>& scene, const Vec3<Scalar>& point, QueryCounters& counters);

template <class Scalar>
[[gnu::noinline]] std::vector<FaceVerdict> explain(const Scene<Scalar>& scene, const Segment<Scalar>& segment,
                                                   const QueryOptions& options, QueryCounters& counters);

}  // namespace pierce::detail
