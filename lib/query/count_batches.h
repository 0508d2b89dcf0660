// Batches of crossings and winding numbers: behind calls that are not inlined, as all queries (engine.h).
#pragma once

#include <cstddef>
#include <cstdint>

#include <query/engine.h>

namespace pierce::detail {

/// Segments or rays `first` to `last`. Those that are not valid count as `invalid`. Returns the number of those that
/// are not 0.
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] std::size_t crossings(const Scene<Scalar>& scene, const Ways<Scalar>& ways,
                                                      std::size_t first, std::size_t last, int* out,
                                                      QueryCounters& counters, std::size_t& invalid);

/// Whether points that follow one another are near one another as a rule, as those of a grid are. There is one at
/// least.
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] bool are_in_order(const Scene<Scalar>& scene, const PointsView<Scalar>& points);

/// For points `first` to `last` a place in Z-order in 30 bits from bit 32 on, and below it the number of the point.
template <class Scalar>
[[gnu::noinline]] void key_points(const Scene<Scalar>& scene, const PointsView<Scalar>& points, std::size_t first,
                                  std::size_t last, std::uint64_t* entries);

/// Points `first` to `last`, or those that these entries name, if there are any. Writes winding numbers (`Out` is int),
/// or whether they are not 0 (std::uint8_t). Those that are not finite count as `invalid`. Returns the number of those
/// that are not 0.
template <class Scalar, class Out>
[[nodiscard]] [[gnu::noinline]] std::size_t winding_numbers(const Scene<Scalar>& scene,
                                                            const PointsView<Scalar>& points,
                                                            const std::uint64_t* entries, std::size_t first,
                                                            std::size_t last, Out* out, QueryCounters& counters,
                                                            std::size_t& invalid);

}  // namespace pierce::detail
