// From the boxes of clusters to a tree: the second half of the build.
#pragma once

#include <span>

#include <cluster/clusters.h>
#include <pierce/executor.h>
#include <tree/tree.h>

namespace pierce::detail {

/// `boxes`, of which there is at least one, are in Morton order and in scene units, and are put in another order;
/// places without a child lead to `empty`; `frame` is that of the build (cluster/frame.h). The tree is the same for any
/// executor. Throws only std::bad_alloc.
template <class Scalar>
[[nodiscard]] Tree make_tree(std::span<ClusterBox<Scalar>> boxes, ClusterRef empty, const Frame& frame,
                             const Executor& executor);

}  // namespace pierce::detail
