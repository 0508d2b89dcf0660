// Threads for pierce: an executor with a given number of them. Not oneTBB's: Embree limits those.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include <pierce/collision_mesh.h>

namespace pierce::bench {

/// Kept from one call to the next; parts go to whichever thread is free.
class Threads {
  public:
    explicit Threads(unsigned count) : work_(std::make_unique<Work>()) {
        for (unsigned t = 1; t < count; ++t)
            others_.emplace_back([work = work_.get()](const std::stop_token& stop) { work->serve(stop); });
    }
    ~Threads() {
        for (std::jthread& other : others_) other.request_stop();
        work_->wake();
    }
    Threads(const Threads&) = delete;
    Threads& operator=(const Threads&) = delete;

    void operator()(std::size_t parts, Task task) const {
        work_->task = task;
        work_->parts = parts;
        work_->next = 0;
        work_->busy = static_cast<int>(others_.size());
        work_->wake();
        work_->take();
        for (int busy = work_->busy; busy > 0; busy = work_->busy) wait_while(work_->busy, busy);
    }

  private:
    // A build calls some ten times within a few milliseconds: threads look for work for a while before they sleep.
    template <class Value>
    static void wait_while(const std::atomic<Value>& value, Value old) {
        constexpr int k_looks = 100'000;  // some tens of microseconds
        for (int look = 0; look < k_looks; ++look)
            if (value != old) return;
        value.wait(old);
    }

    struct Work {
        std::optional<Task> task;
        std::size_t parts = 0;
        std::atomic<std::size_t> next = 0;
        std::atomic<int> busy = 0;
        std::atomic<std::uint64_t> calls = 0;

        void wake() {
            ++calls;
            calls.notify_all();
        }
        void take() {
            for (std::size_t i = next++; i < parts; i = next++) (*task)(i);
        }
        void serve(const std::stop_token& stop) {
            for (std::uint64_t seen = 0;;) {
                wait_while(calls, seen);
                seen = calls;
                if (stop.stop_requested()) return;
                take();
                if (--busy == 0) busy.notify_all();
            }
        }
    };

    std::unique_ptr<Work> work_;
    std::vector<std::jthread> others_;
};

}  // namespace pierce::bench
