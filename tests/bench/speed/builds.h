// What is measured once a mesh: builds, and what a second thread is worth.
#pragma once

#include "measure.h"
#include "results.h"

namespace pierce::bench {

namespace set_name {
inline constexpr std::string_view build = "build";              ///< milliseconds of one thread, to the first answer
inline constexpr std::string_view build_fresh = "build.fresh";  ///< the same, in memory that the system has to give
inline constexpr std::string_view threads = "threads.batch";       ///< ns a query, on the wall
inline constexpr std::string_view thread_build = "threads.build";  ///< milliseconds, on the wall, to the first answer
}  // namespace set_name

void measure_builds(const std::string& mesh, const MeshView<float>& view, int repetitions, Results& results);
void measure_threads(const std::string& mesh, const MeshView<float>& view, const Effort& effort, Results& results);

}  // namespace pierce::bench
