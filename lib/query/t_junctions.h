// Vertices of a border in the middle of a border edge.
#pragma once

#include <span>
#include <vector>

#include <pierce/mesh_report.h>
#include <point.h>
#include <query/point_tree.h>

namespace pierce::detail {

/// What was looked at to find them.
struct TJunctionCounters {
    std::size_t boxes = 0;  ///< of nodes and of single vertices, in the tree
    std::size_t pairs = 0;  ///< vertices and edges that were measured
};

/// Whether vertex v lies beside the inner part of the edge, within rounding: a vertex that was put on an edge may be
/// off it by the rounding of each coordinate, and by a few roundings before that. Among denormal numbers that is 0:
/// what lies on an edge exactly is found there, and nothing else. `epsilon` is that of the scalar type the coordinates
/// were given in.
[[nodiscard]] bool lies_on(std::span<const Point> positions, std::uint32_t v, const MeshReport::Edge& edge,
                           double epsilon);

/// In ascending order.
[[nodiscard]] std::vector<std::uint32_t> t_junctions(std::span<const Point> positions,
                                                     std::span<const MeshReport::Edge> border, double epsilon,
                                                     TJunctionCounters& counters);

}  // namespace pierce::detail
