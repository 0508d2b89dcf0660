// What is odd about a mesh.
#pragma once

#include <span>

#include <pierce/mesh_report.h>
#include <point.h>
#include <query/t_junctions.h>

namespace pierce::detail {

/// `positions` of vertices that no triangle has are not numbers. `degenerate`: the triangles of area zero, ascending.
/// `epsilon` is that of the scalar type the coordinates were given in: what counts as rounding. Not inlined: see
/// engine.h.
[[nodiscard]] [[gnu::noinline]] MeshReport report_on(std::span<const Point> positions,
                                                     std::span<const IndexTriple> triangles,
                                                     std::span<const std::uint32_t> degenerate, double epsilon,
                                                     TJunctionCounters& counters);

}  // namespace pierce::detail
