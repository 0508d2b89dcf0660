// What is odd about a mesh.
#pragma once

#include <span>

#include <pierce/mesh_report.h>
#include <point.h>

namespace pierce::detail {

/// `epsilon` is that of the scalar type the coordinates were given in: what counts as rounding. Not inlined: see engine.h.
[[nodiscard]] [[gnu::noinline]] MeshReport report_on(std::span<const Point> positions,
                                                     std::span<const IndexTriple> triangles, double epsilon);

}  // namespace pierce::detail
