// The ranks, and what all of them do together: the mesh is given to all once, and tallies are summed from time to time.
#pragma once

#include <mpi.h>

#include <cstdint>
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

}  // namespace tracking
