// The queries themselves, behind a call that the compiler does not inline: the caller has made the arithmetic standard
// (environment.h), in which even the conversion of a float to double matters, and has seen that every coordinate is
// finite and `max_fraction` is not NaN.
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include <pierce/explain.h>
#include <pierce/hit.h>
#include <pierce/ray.h>
#include <query/scene.h>

namespace pierce::detail {

// `Way`: a Segment or a Ray of Scalar.
template <class Scalar, class Way>
[[gnu::noinline]] std::optional<Hit<Scalar>> first_hit(const Scene<Scalar>& scene, const Way& way,
                                                       const QueryOptions& options, QueryCounters& counters);

template <class Scalar, class Way>
[[gnu::noinline]] bool any_hit(const Scene<Scalar>& scene, const Way& way, const QueryOptions& options,
                               QueryCounters& counters);

/// The ends of many segments: number i is the three scalars at `from + i * from_stride`, and so on.
template <class Scalar>
struct Ends {
    const Scalar* from;
    const Scalar* to;
    std::ptrdiff_t from_stride;
    std::ptrdiff_t to_stride;
};

/// Whether the ends of query i are numbers.
template <class Scalar>
[[nodiscard]] bool is_finite(const Ends<Scalar>& ends, std::size_t i) {
    const auto at = static_cast<std::ptrdiff_t>(i);
    const auto finite = [](const Scalar* x) {
        return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
    };
    return finite(ends.from + at * ends.from_stride) && finite(ends.to + at * ends.to_stride);
}

/// Queries `first` to `last`. Those that are not finite count as `invalid`. Returns the number of hits.
template <class Scalar, class Answer>
[[gnu::noinline]] std::size_t first_hits(const Scene<Scalar>& scene, const Ends<Scalar>& ends, std::size_t first,
                                         std::size_t last, std::optional<Answer>* out, const QueryOptions& options,
                                         QueryCounters& counters, std::size_t& invalid);
template <class Scalar>
[[gnu::noinline]] std::size_t any_hits(const Scene<Scalar>& scene, const Ends<Scalar>& ends, std::size_t first,
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
