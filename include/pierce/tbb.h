// Builds and batches on the threads of oneTBB. Link `pierce::tbb`, or TBB itself.
#pragma once

#include <cstddef>

#include <tbb/parallel_for.h>

#include <pierce/executor.h>

namespace pierce {

namespace detail {

struct TbbLoop {
    void operator()(std::size_t parts, Task task) const {
        ::tbb::parallel_for(std::size_t{0}, parts, [task](std::size_t part) { task(part); });
    }
};

}  // namespace detail

/// For builds and batches. It works in the task arena of the thread that calls it, so `tbb::task_arena` and
/// `tbb::global_control` say how many threads there are.
[[nodiscard]] inline Executor tbb_executor() { return detail::TbbLoop{}; }

}  // namespace pierce
