// The ranks, and what all of them do together: the mesh is given to all once, and tallies are summed from time to time.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <exception>
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

    /// What rank 0 does for all, while the others wait. Where it throws a std::exception, rank 0 says why, and all
    /// throw `Failed`.
    struct Failed {};
    template <class Do>
    void first_does(const Do& something) const;

    /// Ends all ranks, wherever they are, with status 2: for errors of one of them that the others don't know of.
    [[noreturn]] static void end_all(const std::string& why);

  private:
    static void say(const std::string& what);

    int rank_ = 0, size_ = 1;
};

/// Gives the mesh of rank 0 to all others.
void broadcast(pierce::TriangleSoup<double>& soup);
/// Gives a number of rank 0 to all others.
void broadcast(std::uint64_t& number);

/// Sums in `total`, on rank 0 only.
void sum(std::span<const std::uint64_t> mine, std::span<std::uint64_t> total);
double sum(double mine);

template <class Do>
void Ranks::first_does(const Do& something) const {
    std::uint64_t has_failed = 0;
    try {
        if (is_first()) something();
    } catch (const std::exception& error) {
        say(error.what());
        has_failed = 1;
    }
    broadcast(has_failed);
    if (has_failed != 0) throw Failed{};
}

}  // namespace tracking
