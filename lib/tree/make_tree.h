// From clusters to the wide tree.
#pragma once

#include <span>

#include <cluster/clusters.h>
#include <pierce/executor.h>
#include <tree/tree.h>

namespace pierce::detail {

/// `boxes`, at least one, in Morton order; they are put into another order. `frame` has its unit; the rest but for the noise is filled in. O(n log n), in
/// parts for the executor; the same tree for any.
template <class Scalar>
[[nodiscard]] Tree make_tree(std::span<ClusterBox<Scalar>> boxes, ClusterRef empty, Frame& frame, const Executor& executor);

}  // namespace pierce::detail
