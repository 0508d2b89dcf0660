// Batches and threads, as pierce will offer them. TO BE REPLACED by CollisionMesh::first_hits, any_hits and the executors of
// BatchOptions and BuildOptions: until then each is made of single calls here, and a build uses one thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <thread>

#include <pierce/collision_mesh.h>

namespace pierce::bench {

/// out[i] = first_hit(segments[i]); returns the number of hits.
template <class Scalar>
std::size_t first_hits(const CollisionMesh<Scalar>& mesh, std::span<const Segment<Scalar>> segments,
                       std::span<std::optional<Hit<Scalar>>> out, unsigned threads) {
    if (threads == 2) {
        const std::size_t half = segments.size() / 2;
        std::size_t others = 0;
        std::thread other([&] { others = first_hits(mesh, segments.first(half), out.first(half), 1); });
        const std::size_t hits = first_hits(mesh, segments.subspan(half), out.subspan(half), 1);
        other.join();
        return hits + others;
    }
    std::size_t hits = 0;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        out[i] = mesh.first_hit(segments[i]);
        hits += out[i].has_value() ? 1U : 0U;
    }
    return hits;
}

/// out[i] = any_hit(segments[i]); returns the number of hits.
template <class Scalar>
std::size_t any_hits(const CollisionMesh<Scalar>& mesh, std::span<const Segment<Scalar>> segments,
                     std::span<std::uint8_t> out) {
    std::size_t hits = 0;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        out[i] = mesh.any_hit(segments[i]) ? 1U : 0U;
        hits += out[i];
    }
    return hits;
}

template <class Scalar>
CollisionMesh<Scalar> build(const MeshView<Scalar>& mesh, unsigned /*threads*/) {
    return CollisionMesh<Scalar>(mesh);
}

}  // namespace pierce::bench
