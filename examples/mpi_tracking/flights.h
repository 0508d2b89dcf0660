// The physics: a gas so thin that particles meet nothing but walls. They leave the walls anywhere, fly straight to
// where they meet one, and stay there, or leave again in a random direction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <pierce/pierce.h>

#include "mpi_tracking/random.h"
#include "mpi_tracking/tallies.h"
#include "mpi_tracking/vessel.h"

namespace tracking {

/// What decides what a particle does, beside the mesh and its number.
struct Physics {
    std::uint64_t seed = 1;
    double sticking = 0.1;           ///< the part of the hits that end a particle: 0 to 1
    std::uint64_t most_hits = 1000;  ///< after which one is stopped
};

/// Flies batches of particles. One for each thread: it keeps their memory; all may share a mesh.
class Flights {
  public:
    /// `mesh`: that of the vessel, which must be closed. Both must outlive this. `check_all`: ask after every flight
    /// whether the particle is in the mesh, not only in the end.
    Flights(const pierce::CollisionMesh<double>& mesh, const Vessel& vessel, const Physics& physics, bool check_all);

    /// Flies the particles of these numbers to their ends, and adds what became of them. Throws std::runtime_error
    /// where there is hardly a place to start from.
    void fly(std::uint64_t first, std::uint64_t count, Tallies& tallies);

  private:
    enum class End : std::uint32_t { none, absorbed, stopped, lost };
    struct Particle {
        Vec3 position;
        Vec3 direction;  // of any length: rays need none
        Stream stream;
        End end = End::none;
        std::uint64_t hits = 0;
    };

    void start(std::uint64_t first, std::uint64_t count);
    void leave(Particle& particle, const Vec3& normal, Words words) const;
    void meet(Particle& particle, const pierce::Hit<double>& hit, Tallies& tallies) const;
    void count_outside(const std::vector<Particle>& particles, Tallies& tallies);
    void count_end(const Particle& particle, Tallies& tallies) const;

    const pierce::CollisionMesh<double>& mesh_;
    const Vessel& vessel_;
    Physics physics_;
    std::uint64_t sticks_below_;
    bool check_all_;
    std::vector<Particle> flying_, ended_;
    std::vector<pierce::Hit<double>> hits_;
    std::vector<pierce::Location> locations_;
};

}  // namespace tracking
