// The triangles in the order in which a curve through space meets them.
#pragma once

#include <cstdint>

#include <cluster/quad.h>
#include <pierce/executor.h>
#include <plain_mesh.h>
#include <raw_array.h>

namespace pierce::detail {

/// Keys of 30 bits above the numbers of the triangles, in 32 bits each, sorted by both. `box`: of all corners.
template <class Scalar>
struct MortonOrder {
    RawArray<std::uint64_t> entries;
    QuadBox<Scalar> box;
};

template <class Scalar>
[[nodiscard]] MortonOrder<Scalar> morton_order(const PlainMesh<Scalar>& mesh, const Executor& executor);

}  // namespace pierce::detail
