// Executors that are as unlike the default as the contract allows: the last part first, and on threads.
#pragma once

#include <atomic>
#include <thread>
#include <vector>

#include <pierce/executor.h>

namespace pierce::test {

struct Reversed {
    void operator()(std::size_t parts, Task task) const {
        while (parts > 0) task(--parts);
    }
};

/// Four threads, whatever the machine: which of them takes a part is left to chance.
struct Threads {
    void operator()(std::size_t parts, Task task) const {
        std::atomic<std::size_t> next = 0;
        std::vector<std::thread> threads;
        for (int i = 0; i < 4; ++i)
            threads.emplace_back([&] {
                for (std::size_t part = next++; part < parts; part = next++) task(part);
            });
        for (std::thread& thread : threads) thread.join();
    }
};

}  // namespace pierce::test
