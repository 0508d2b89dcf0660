// See flights.h.
#include "mpi_tracking/flights.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace tracking {

Flights::Flights(const pierce::CollisionMesh<double>& mesh, const Vessel& vessel, const Physics& physics,
                 bool check_all)
    : mesh_(mesh),
      vessel_(vessel),
      physics_(physics),
      sticks_below_(static_cast<std::uint64_t>(physics.sticking * 0x1p32)),
      check_all_(check_all) {}

void Flights::fly(std::uint64_t first, std::uint64_t count, Tallies& tallies) {
    start(first, count);
    ended_.clear();
    hits_.resize(count);
    // Not one particle after the other: a batch has many rays in flight, each while others wait for memory.
    while (!flying_.empty()) {
        const std::size_t n = flying_.size();
        const pierce::Rays<double> rays({flying_[0].position.data(), n, sizeof(Particle)},
                                        {flying_[0].direction.data(), n, sizeof(Particle)});
        mesh_.first_hits(rays, std::span(hits_).first(n), {.sides = pierce::Sides::both});
        for (std::size_t i = 0; i < n; ++i) meet(flying_[i], hits_[i], tallies);
        if (check_all_) count_outside(flying_, tallies);
        std::erase_if(flying_, [this](const Particle& particle) {
            if (particle.end == End::none) return false;
            ended_.push_back(particle);
            return true;
        });
    }
    if (!check_all_) count_outside(ended_, tallies);
    for (const Particle& particle : ended_) count_end(particle, tallies);
}

/// All from the walls, evenly. So they are a gas in equilibrium from their first flight on, whatever the vessel's
/// shape: they hit walls in proportion to their area, and the mean way from wall to wall is `Vessel::mean_chord`.
void Flights::start(std::uint64_t first, std::uint64_t count) {
    flying_.assign(count, {});
    for (std::uint64_t i = 0; i < count; ++i) flying_[i].stream.particle = first + i;
    locations_.resize(count);
    // Where walls are close to one another a place may not be inside: then another one is drawn.
    std::size_t placed = 0;
    for (int attempt = 0; placed < count; ++attempt) {
        if (attempt == 1000) throw std::runtime_error("there is hardly any room between the walls of this mesh");
        for (std::size_t i = placed; i < count; ++i) {
            Particle& particle = flying_[i];
            const auto [point, normal] = vessel_.place(particle.stream.next(physics_.seed));
            particle.position = point;
            leave(particle, normal, particle.stream.next(physics_.seed));
        }
        const std::size_t tried = placed, n = count - placed;
        const std::span<pierce::Location> locations = std::span(locations_).first(n);
        mesh_.locate_points({flying_[placed].position.data(), n, sizeof(Particle)}, locations);
        for (std::size_t i = 0; i < n; ++i)
            if (locations[i].place == pierce::Place::inside) std::swap(flying_[placed++], flying_[tried + i]);
    }
}

/// By the cosine law, which the normal plus a point of the unit sphere follows.
void Flights::leave(Particle& particle, const Vec3& normal, Words words) const {
    for (;; words = particle.stream.next(physics_.seed)) {
        const Vec3 v = in_ball(words, particle.stream, physics_.seed);
        particle.direction = normal + v / std::sqrt(squared_length(v));
        if (squared_length(particle.direction) >= 0x1p-40) return;
    }
}

void Flights::meet(Particle& particle, const pierce::Hit<double>& hit, Tallies& tallies) const {
    ++tallies[Sum::flights];
    if (!hit) {
        particle.end = End::lost;
        return;
    }
    const double length = std::sqrt(squared_length(hit.point.vec() - particle.position));
    tallies[Sum::length] += static_cast<std::uint64_t>(length / vessel_.length_unit() + 0.5);
    // Not `position`, which may lie behind the wall by a rounding: from `point` the next flight begins inside, exactly.
    particle.position = hit.point;
    ++particle.hits;
    ++tallies.hits(hit.face);
    const Words words = particle.stream.next(physics_.seed);
    if (words[3] < sticks_below_) {
        ++tallies.absorbed(hit.face);
        particle.end = End::absorbed;
    } else if (particle.hits >= physics_.most_hits) {
        particle.end = End::stopped;
    } else {
        leave(particle, hit.facing(), words);
    }
}

void Flights::count_outside(const std::vector<Particle>& particles, Tallies& tallies) {
    const std::span<pierce::Location> locations = std::span(locations_).first(particles.size());
    mesh_.locate_points({particles[0].position.data(), particles.size(), sizeof(Particle)}, locations);
    for (const pierce::Location& location : locations) tallies[Sum::outside] += location.place != pierce::Place::inside;
}

void Flights::count_end(const Particle& particle, Tallies& tallies) const {
    ++tallies[Sum::particles];
    tallies[Sum::absorbed] += particle.end == End::absorbed;
    tallies[Sum::stopped] += particle.end == End::stopped;
    tallies[Sum::lost] += particle.end == End::lost;
    Hash hash;
    hash.add(particle.stream.particle);
    hash.add(std::uint64_t{particle.stream.drawn});
    hash.add(particle.hits);
    hash.add(static_cast<std::uint64_t>(particle.end));
    for (int k = 0; k < 3; ++k) hash.add(particle.position[k]);
    tallies[Sum::hash_low] += hash.low;
    tallies[Sum::hash_high] += hash.high;
}

}  // namespace tracking
