#include "measure.h"

#include <algorithm>
#include <chrono>
#include <ctime>

namespace pierce::bench {
namespace {

std::size_t g_hits = 0;  // keeps the answers from being optimized away

class Stopwatch {
  public:
    Stopwatch(Column& column, const Effort& effort, Clock clock)
        : column_(column), clock_(clock), segments_(effort.segments), count_(affordable(effort)) {}

    /// One repetition: over the segments after those of the one before, with caches and branches warmed by others.
    double repeat() {
        if (next_ + count_ > segments_) next_ = 0;
        const std::size_t warm = std::max<std::size_t>(1, count_ / 8);
        const std::size_t other =
            (next_ + count_ + warm <= segments_) ? next_ + count_ : (next_ >= warm ? next_ - warm : 0);
        g_hits += column_.ask(other, other + warm);
        const double ns = 1e9 * time(next_, next_ + count_) / static_cast<double>(count_);
        next_ += count_;
        return ns;
    }

    [[nodiscard]] std::string_view name() const { return column_.name(); }

  private:
    double time(std::size_t begin, std::size_t end) {
        const double start = seconds_now(clock_);
        g_hits += column_.ask(begin, end);
        return seconds_now(clock_) - start;
    }

    /// How many segments fit a repetition's share of the time, by trying more and more of them.
    std::size_t affordable(const Effort& effort) {
        const double share = effort.seconds / effort.repetitions;
        for (std::size_t tried = std::min<std::size_t>(32, segments_);; tried = std::min(2 * tried, segments_)) {
            const double taken = time(0, tried);
            if (taken < share / 8 && tried < segments_) continue;
            const double fits = static_cast<double>(tried) * share / std::max(taken, 1e-9);
            return fits >= static_cast<double>(segments_) ? segments_
                                                          : std::max<std::size_t>(32, static_cast<std::size_t>(fits));
        }
    }

    Column& column_;
    Clock clock_;
    std::size_t segments_;
    std::size_t count_;
    std::size_t next_ = 0;
};

}  // namespace

double seconds_now(Clock clock) {
    if (clock == Clock::wall)
        return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    timespec t{};
    clock_gettime(clock == Clock::thread ? CLOCK_THREAD_CPUTIME_ID : CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void measure(std::span<Column* const> columns, const Effort& effort, Clock clock,
             const std::function<void(std::string_view column, double ns)>& report) {
    std::vector<Stopwatch> watches;
    for (Column* column : columns) watches.emplace_back(*column, effort, clock);
    for (int r = 0; r < effort.repetitions; ++r)
        for (std::size_t i = 0; i < watches.size(); ++i) {  // each comes after another one every time
            Stopwatch& watch = watches[(i + static_cast<std::size_t>(r)) % watches.size()];
            report(watch.name(), watch.repeat());
        }
}

}  // namespace pierce::bench
