// A progress bar on standard error, for work that takes longer than half a second. Nothing if that is not a terminal.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

class Progress {
  public:
    /// `total` is the number of pieces of work; with zero, nothing is known but the time that it takes.
    explicit Progress(std::string what, std::uint64_t total = 0);
    /// Wipes the bar away.
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// So many pieces more are done. From any thread.
    void add(std::uint64_t count) { done_.fetch_add(count, std::memory_order_relaxed); }

  private:
    using Clock = std::chrono::steady_clock;

    void draw_until_stopped();
    void draw() const;

    const std::string what_;
    const std::uint64_t total_;
    const Clock::time_point start_ = Clock::now();
    std::atomic<std::uint64_t> done_ = 0;
    bool stopped_ = false;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::thread drawer_;  // last: it uses all the others
};
