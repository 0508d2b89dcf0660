// Long work without the interpreter's lock: cut into calls of a tenth of a second, with the caller's own functions and
// Ctrl-C between them.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include <pierce/executor.h>
#include <pybind11/pybind11.h>

namespace pierce::python {

namespace py = pybind11;

/// Starts threads for each task and joins them at its end, so that there are none between calls: a fork of the process
/// finds no lock held. A task is long against their start.
class Threads {
  public:
    /// 0: as many as the machine has. ValueError: less than that.
    explicit Threads(int count) : count_(static_cast<std::size_t>(std::max(count, 0))) {
        if (count < 0) throw py::value_error("threads: " + std::to_string(count) + ", where 0 is all cores");
        if (count == 0) count_ = std::max(1U, std::thread::hardware_concurrency());
    }

    [[nodiscard]] Executor executor() const {
        if (count_ == 1) return {};
        return [count = count_](std::size_t parts, Task task) { run(std::min(count, parts), parts, task); };
    }

  private:
    static void run(std::size_t threads, std::size_t parts, Task task) {
        std::atomic<std::size_t> next = 0;
        const auto work = [&] {
            for (std::size_t part = next++; part < parts; part = next++) task(part);
        };
        std::vector<std::thread> others;
        others.reserve(threads);
        try {
            for (std::size_t i = 1; i < threads; ++i) others.emplace_back(work);
        } catch (const std::system_error&) {  // the system has no more: those that there are do it
        }
        work();
        for (std::thread& other : others) other.join();
    }

    std::size_t count_;
};

/// How a batch is to be done.
struct How {
    Threads threads;
    py::object progress;  ///< called with how many are done and how many there are, or None
};

/// Queries of a call: the first one shows how long they take, which differs by a factor of 10^5 between meshes.
inline constexpr std::size_t k_first_call = 256;
inline constexpr std::size_t k_least_in_a_call = 64;
inline constexpr std::size_t k_most_in_a_call = std::size_t{1} << 20;

/// Calls `some(first, number, executor)` for parts of `count` queries, one after the other, without the lock. What a
/// signal's handler or `progress` raises ends it.
template <class Some>
void in_calls(std::size_t count, const How& how, Some&& some) {
    using Clock = std::chrono::steady_clock;
    constexpr double k_wanted = 0.1;  // seconds
    std::size_t size = k_first_call;
    const Executor executor = how.threads.executor();
    for (std::size_t done = 0; done < count;) {
        const std::size_t number = std::min(size, count - done);
        const auto start = Clock::now();
        {
            const py::gil_scoped_release released;
            some(done, number, executor);
        }
        const double spent = std::chrono::duration<double>(Clock::now() - start).count();
        done += number;
        const double better = static_cast<double>(number) * k_wanted / std::max(spent, 1e-6);
        if (spent < k_wanted / 2 || spent > k_wanted * 2)
            size = static_cast<std::size_t>(
                std::clamp(better, static_cast<double>(k_least_in_a_call), static_cast<double>(k_most_in_a_call)));
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (!how.progress.is_none()) how.progress(done, count);
    }
}

}  // namespace pierce::python
