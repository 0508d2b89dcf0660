// Gives equal positions one vertex: STL files name a corner by its coordinates only.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "mesh/read_soup_builder.h"

namespace pierce::detail {

/// Two corners are one vertex if all three coordinates are equal as numbers: bit for bit, save that -0 becomes +0.
template <class Scalar>
class VertexMerger {
  public:
    explicit VertexMerger(SoupBuilder<Scalar>& soup) : soup_(soup), slots_(1024, k_free) {}

    std::uint32_t vertex_at(Vec3<Scalar> position) {
        position.array() += Scalar(0);  // makes -0 to +0
        // Open addressing, at most half full.
        if (2 * soup_.vertex_count() >= slots_.size()) {
            grow();
        }
        const std::size_t slot = slot_of(position);
        if (slots_[slot] == k_free) {
            soup_.add_vertex(position);
            slots_[slot] = static_cast<std::uint32_t>(soup_.vertex_count() - 1);
        }
        return slots_[slot];
    }

  private:
    static constexpr std::uint32_t k_free = 0xFFFF'FFFF;

    [[nodiscard]] std::size_t slot_of(const Vec3<Scalar>& position) const {
        std::uint64_t hash = 0;
        for (const Scalar x : position) {
            // Exact in double. The multiplier is that of SplitMix64 (Steele, Lea, Flood 2014); the shift brings the
            // high bits down, which hold all the information of round coordinates.
            hash = (hash ^ std::bit_cast<std::uint64_t>(static_cast<double>(x))) * 0xBF58'476D'1CE4'E5B9;
            hash ^= hash >> 32;
        }
        std::size_t slot = hash & (slots_.size() - 1);
        while (slots_[slot] != k_free && soup_.position(slots_[slot]) != position) {
            slot = (slot + 1) & (slots_.size() - 1);
        }
        return slot;
    }

    void grow() {
        slots_.assign(4 * slots_.size(), k_free);
        for (std::uint32_t vertex = 0; vertex < soup_.vertex_count(); ++vertex) {
            slots_[slot_of(soup_.position(vertex))] = vertex;
        }
    }

    SoupBuilder<Scalar>& soup_;
    std::vector<std::uint32_t> slots_;  // a power of two of them
};

}  // namespace pierce::detail
