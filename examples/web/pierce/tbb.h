// In a browser there is one thread, and no oneTBB: this file takes the place of include/pierce/tbb.h.
#pragma once

#include <pierce/executor.h>

namespace pierce {

[[nodiscard]] inline Executor tbb_executor() { return {}; }

}  // namespace pierce
