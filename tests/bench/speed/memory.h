// What a built mesh holds, and the most that its build held.
#pragma once

#include "bench_meshes.h"
#include "results.h"

namespace pierce::bench {

namespace set_name {
inline constexpr std::string_view memory = "memory";  ///< bytes a face
}  // namespace set_name

void measure_memory(const std::string& mesh, const MeshView<float>& view, Results& results);

/// Builds the mesh in a process of its own, asks about segments and prints the most memory that it held, with the mesh.
void measure_peak(const BenchMesh& mesh);

}  // namespace pierce::bench
