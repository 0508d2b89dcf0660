// Many things in chunks for the caller's threads.
#pragma once

#include <algorithm>
#include <cstddef>

#include <pierce/executor.h>

namespace pierce::detail {

/// So much is a part of its own for a thread: some tens of microseconds of the build's work.
constexpr std::size_t k_chunk = std::size_t{1} << 12;

[[nodiscard]] inline std::size_t chunks_of(std::size_t count, std::size_t size = k_chunk) {
    return (count + size - 1) / size;
}

/// What is read in an order that is not that of memory is asked for so many things ahead. Measured: tests/bench/run
/// /build, a tenth.
constexpr std::size_t k_ahead = 8;

/// Calls `visit(chunk, begin, end)` for all chunks of `count` things, on the executor's threads.
template <class Visit>
void each_chunk(const Executor& executor, std::size_t count, Visit&& visit, std::size_t size = k_chunk) {
    executor(chunks_of(count, size),
             [&](std::size_t chunk) { visit(chunk, chunk * size, std::min(count, (chunk + 1) * size)); });
}

}  // namespace pierce::detail
