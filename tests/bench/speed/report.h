// What is printed of a run: tables for people, and lines `ratio NAME VALUE` for scripts.
#pragma once

#include "bench_meshes.h"
#include "results.h"

namespace pierce::bench {

/// A mesh that was measured, and how many faces it has.
struct Measured {
    BenchMesh mesh;
    std::size_t faces;
};

/// One table for each set, a row for each mesh.
void print_figures(const Results& results, const std::vector<Measured>& meshes);

/// Each ratio on each mesh, and then the lines: the median over the real meshes, and the teapot in the stadium. A ratio is the
/// peer's time over ours, so more is better; what was not measured has no line.
void print_ratios(const Results& results, const std::vector<Measured>& meshes);

}  // namespace pierce::bench
