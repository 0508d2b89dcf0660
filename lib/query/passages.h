// Passages: behind a call that is not inlined, as all queries (engine.h). The segment is finite, and `max_fraction` at
// least 0.
#pragma once

#include <span>

#include <pierce/passage.h>
#include <query/scene.h>

namespace pierce::detail {

template <class Scalar>
[[nodiscard]] [[gnu::noinline]] std::size_t passages(const Scene<Scalar>& scene, const Segment<Scalar>& segment,
                                                     std::span<Passage<Scalar>> out, std::span<FaceTouch> faces,
                                                     const PassageOptions& options, QueryCounters& counters);

}  // namespace pierce::detail
