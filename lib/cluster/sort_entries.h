// Sorting by the keys of triangles.
#pragma once

#include <cstddef>
#include <cstdint>

#include <pierce/executor.h>

namespace pierce::detail {

/// Sorts entries by their keys, 30 bits that begin at bit 32, and leaves those of the same key in their order. They are
/// in `sorted` then, which has room for as many; what is in `entries` is lost.
void sort_entries(std::uint64_t* entries, std::uint64_t* sorted, std::size_t count, const Executor& executor);

}  // namespace pierce::detail
