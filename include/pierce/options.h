// What a caller may choose when a mesh is built and when a query is asked.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <pierce/types.h>

namespace pierce {

/// None of these changes an answer: they trade memory and build time for query time.
struct BuildOptions {
    /// Cells of the grid along x, y and z. A zero leaves all three to the library, which chooses them from the face
    /// count and the shape of the box. More than `max_grid_bytes` can hold are scaled down.
    std::array<std::uint32_t, 3> grid_cells = {0, 0, 0};
    /// An upper bound for the memory of the grid (cells and cell lists), kept by choosing a coarser grid. Zero stands
    /// for 192 bytes a face, and for 64 KiB where that is more. A grid of one cell, with four bytes a face, is always made.
    std::size_t max_grid_bytes = 0;
};

/// What a query went through, added up over the queries that were given the same counters. Not thread-safe: one
/// for each thread.
struct QueryCounters {
    std::uint64_t queries = 0;
    std::uint64_t cells = 0;           ///< grid cells visited
    std::uint64_t triangles = 0;       ///< triangles given to the kernel; a triangle counts once for each cell
    std::uint64_t exact_decisions = 0; ///< triangles that the filter left doubtful
    std::uint64_t exact_orders = 0;    ///< pairs of hits too close to be ordered without exact arithmetic
    std::uint64_t retreats = 0;        ///< points that had to be moved back before they were verified
};

struct QueryOptions {
    /// The side that a segment must come from to hit a triangle.
    Sides sides = Sides::front;
    /// Only hits whose exact fraction is at most this count. NaN: no hit.
    double max_fraction = 1.0;
    /// Adds up what the query went through, if given.
    QueryCounters* counters = nullptr;
};

}  // namespace pierce
