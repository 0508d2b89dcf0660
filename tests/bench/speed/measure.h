// Takes the time of columns, interleaved: what happens to the machine meanwhile happens to all of them.
#pragma once

#include <functional>
#include <span>
#include <string_view>

#include "column.h"

namespace pierce::bench {

struct Effort {
    std::size_t segments;  ///< in each repetition, at most
    double seconds;  ///< for all repetitions of one figure together, at most: slow columns get through fewer segments
    int repetitions;
};

/// Of this thread's own time, or this process's, which other programs don't count in; or of the time on the wall, where
/// several threads are to be worth something.
enum class Clock { thread, process, wall };

double seconds_now(Clock clock);

/// Reports ns a query, once for each repetition and column. Columns have to be prepared with `segments` segments.
void measure(std::span<Column* const> columns, const Effort& effort, Clock clock,
             const std::function<void(std::string_view column, double ns)>& report);

}  // namespace pierce::bench
