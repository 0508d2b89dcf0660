// The counts and times that `cast` prints after the hits.
#pragma once

#include <cstddef>
#include <ostream>

#include <pierce/collision_mesh.h>

#include "cast/options.h"

struct Report {
    std::size_t faces = 0;  ///< of the file; with polygons in it, fewer than it has triangles
    pierce::MeshStatistics mesh;
    pierce::MeshReport odd;
    pierce::QueryCounters counters;
    std::size_t segments = 0;
    std::size_t segments_hit = 0;
    std::size_t hits = 0;
    /// In seconds.
    double read_time = 0, build_time = 0, cast_time = 0, draw_time = 0;
};

void write_report(std::ostream& out, const Report& report, const Options& options);
