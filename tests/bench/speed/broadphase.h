// The second broadphase, the uniform grid, for the columns beside the default.
#pragma once

#include <pierce/options.h>

namespace pierce::bench {

inline BuildOptions grid_options() { return {.broadphase = Broadphase::grid}; }

}  // namespace pierce::bench
