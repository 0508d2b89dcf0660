// What is measured once a mesh: the build, memory, and threads.
#pragma once

#include "bench_meshes.h"
#include "measure.h"
#include "results.h"

namespace pierce::bench {

namespace set_name {
inline constexpr std::string_view build = "build";                 ///< milliseconds of one thread, to the first answer
inline constexpr std::string_view memory = "memory";               ///< bytes a face
inline constexpr std::string_view threads = "threads.batch";       ///< ns a query, on the wall
inline constexpr std::string_view thread_build = "threads.build";  ///< milliseconds, on the wall, to the first answer
}  // namespace set_name

void measure_builds(const std::string& mesh, const MeshView<float>& view, int repetitions, Results& results);
void measure_memory(const std::string& mesh, const MeshView<float>& view, Results& results);
void measure_threads(const std::string& mesh, const MeshView<float>& view, const Effort& effort, Results& results);

/// Builds the mesh in a process of its own, asks about segments and prints the most memory that it held, the mesh included.
void measure_peak(const BenchMesh& mesh);

}  // namespace pierce::bench
