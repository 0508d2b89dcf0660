// What is counted. Whole numbers only, so that sums do not depend on the order of the terms: on who flew which
// particle.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mpi_tracking/hash.h"

namespace tracking {

/// Sums over all particles.
enum class Sum : std::size_t {
    particles,  ///< whose flight is over: those below this number, between two rounds
    absorbed,   ///< by a wall
    stopped,    ///< still in flight when it had as many hits as are allowed
    lost,       ///< flew on without meeting a wall: impossible in a closed mesh
    outside,    ///< was found outside of the mesh: impossible as well
    flights,    ///< from wall to wall
    length,     ///< of these, in units of `Vessel::length_unit`
    hash_low,   ///< sums of the hashes of the particles' ends: any term that differs in one bit changes the sum
    hash_high,
    count,
};

/// The sums, and the hits and the particles absorbed for each face, as one array for MPI and for files.
class Tallies {
  public:
    explicit Tallies(std::size_t faces) : words_(k_sums + 2 * faces) {}

    std::uint64_t& operator[](Sum sum) { return words_[static_cast<std::size_t>(sum)]; }
    std::uint64_t operator[](Sum sum) const { return words_[static_cast<std::size_t>(sum)]; }
    std::uint64_t& hits(std::size_t face) { return words_[k_sums + 2 * face]; }
    std::uint64_t& absorbed(std::size_t face) { return words_[k_sums + 2 * face + 1]; }

    [[nodiscard]] std::size_t faces() const { return (words_.size() - k_sums) / 2; }
    [[nodiscard]] std::span<std::uint64_t> words() { return words_; }
    [[nodiscard]] std::span<const std::uint64_t> words() const { return words_; }

    void clear() { words_.assign(words_.size(), 0); }
    Tallies& operator+=(const Tallies& other) {
        for (std::size_t i = 0; i < words_.size(); ++i) words_[i] += other.words_[i];
        return *this;
    }

    /// Of everything here: what two runs must agree in.
    [[nodiscard]] Hash hash() const {
        Hash hash;
        for (const std::uint64_t word : words_) hash.add(word);
        return hash;
    }

  private:
    static constexpr std::size_t k_sums = static_cast<std::size_t>(Sum::count);
    std::vector<std::uint64_t> words_;
};

}  // namespace tracking
