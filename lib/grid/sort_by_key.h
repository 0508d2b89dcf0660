// Sorting by counting, for the build: in parts for the caller's threads.
#pragma once

#include <cstdint>

#include <pierce/executor.h>
#include <raw_array.h>

namespace pierce::detail {

/// Sorts numbers by their keys, stably, and the keys.
void sort_by_key(RawArray<std::uint32_t>& keys, RawArray<std::uint32_t>& numbers, const Executor& executor);

}  // namespace pierce::detail
