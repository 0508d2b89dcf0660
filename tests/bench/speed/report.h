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

/// Each ratio on each mesh, and then lines `ratio NAME VALUE`: medians over the real meshes, some scenes alone, and how
/// time grows with faces. What was not measured has no line.
void print_ratios(const Results& results, const std::vector<Measured>& meshes);

/// Three digits, and more only before the point.
std::string number(double value);
/// The same, or a dash.
std::string cell(const std::optional<double>& value);

}  // namespace pierce::bench
