// Who flies which particles: rank 0 hands out numbers, in order, to all who ask, its own threads among them. It answers
// while it flies itself, between two batches; the others ask early, so that as a rule they need not wait for it.
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <mutex>

#include "mpi_tracking/ranks.h"

namespace tracking {

class Work {
  public:
    /// Particles from `first` up to `end`, without that. A thread gets `batch` at a time, a rank that for all its
    /// threads in one message.
    Work(const Ranks& ranks, std::uint64_t first, std::uint64_t end, std::uint64_t batch, unsigned threads);
    Work(const Work&) = delete;
    Work& operator=(const Work&) = delete;

    /// Begins a round on this rank; each rank does so. It is over when all has been handed out, or by the clock of rank
    /// 0 when `seconds` are. What is handed out till then is one range of numbers, which begins where the last one
    /// ended.
    void begin(double seconds);

    struct Part {
        std::uint64_t first = 0;
        std::uint64_t count = 0;  ///< 0: the round is over
    };
    /// What a thread is to fly next. From any thread.
    Part take();

    /// Returns when all ranks know that the round is over.
    void end();

  private:
    Part hand_out(std::uint64_t count);  // rank 0 only, as the next one
    void answer_all();
    void ask();
    bool has_share();

    const Ranks& ranks_;
    std::uint64_t batch_, share_;
    std::mutex mutex_;  // MPI is called by one thread at a time

    // Rank 0: what has not been handed out.
    std::uint64_t next_, end_, begin_ = 0;
    double until_ = 0;
    int told_ = 0;  // how many others know that the round is over

    // All others: the share in hand, and the next one, which is on its way.
    Part mine_;
    std::array<std::uint64_t, 2> answer_{};
    MPI_Request request_ = MPI_REQUEST_NULL;
    bool is_over_ = false;
};

}  // namespace tracking
