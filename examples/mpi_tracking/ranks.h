// What passes between the ranks: the mesh once, then numbers of particles to fly, and from time to time their tallies.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <mutex>
#include <span>
#include <string>

#include <pierce/triangle_soup.h>

namespace tracking {

/// MPI from its beginning to its end, in a program whose threads call it one at a time.
class Ranks {
  public:
    Ranks(int& argc, char**& argv);
    ~Ranks();
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;

    [[nodiscard]] int rank() const { return rank_; }
    [[nodiscard]] int size() const { return size_; }
    [[nodiscard]] bool is_first() const { return rank_ == 0; }

    /// Ends all ranks, wherever they are, with status 2: for errors of one of them, for which the others would wait.
    [[noreturn]] static void end_all(const std::string& why);

  private:
    int rank_ = 0, size_ = 1;
};

/// Gives the mesh of rank 0 to all others.
void broadcast(pierce::TriangleSoup<double>& soup);
/// Gives a number of rank 0 to all others.
void broadcast(std::uint64_t& number);

/// Sums in `total`, on rank 0 only.
void sum(std::span<const std::uint64_t> mine, std::span<std::uint64_t> total);
double sum(double mine);

/// Hands out numbers of particles, each once, to the threads of all ranks: a number on rank 0 that all others add to
/// without asking that rank. Made and destroyed by all ranks together.
class WorkCounter {
  public:
    explicit WorkCounter(std::uint64_t first);
    ~WorkCounter();
    WorkCounter(const WorkCounter&) = delete;
    WorkCounter& operator=(const WorkCounter&) = delete;

    /// The first one of the next `count` numbers. From any thread.
    std::uint64_t take(std::uint64_t count);

  private:
    std::mutex mutex_;
    MPI_Win window_ = MPI_WIN_NULL;
    std::uint64_t* next_ = nullptr;
};

}  // namespace tracking
