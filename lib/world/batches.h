// Parts of a world's batch: single queries, one after the other.
#pragma once

#include <query/parts.h>
#include <query/sinks.h>
#include <world/engine.h>
#include <world/places.h>

namespace pierce::detail {

/// Queries `first` to `last`. Those that are not valid count as `invalid`. Returns the number of hits.
template <class Scalar>
std::size_t first_hits(const WorldScene<Scalar>& world, const Ways<Scalar>& ways, std::size_t first, std::size_t last,
                       const WorldHitsOut<Scalar>& out, const WorldOptions& options, QueryCounters& counters,
                       std::size_t& invalid) {
    const auto* const optionals = std::get_if<std::span<std::optional<WorldHit<Scalar>>>>(&out);
    const auto* const plain = std::get_if<std::span<WorldHit<Scalar>>>(&out);
    const auto* const arrays = std::get_if<WorldHitArrays<Scalar>>(&out);
    std::size_t hits = 0;
    for (std::size_t i = first; i < last; ++i) {
        std::optional<WorldHit<Scalar>> hit;
        if (!ways.is_valid(i))
            ++invalid;
        else if (is_limit(options.max_fraction))
            hit = ways.with(i, [&](const auto& way) { return first_hit(world, way, options, counters); });
        if (hit) ++hits;
        const WorldHit<Scalar>& answer = hit ? *hit : no_world_hit<Scalar>;
        if (optionals != nullptr) {
            (*optionals)[i] = hit;
        } else if (plain != nullptr) {
            (*plain)[i] = answer;
        } else {
            ArraysOfHits<Scalar>{arrays->hits}.scatter(i, answer.hit);
            if (arrays->mesh != nullptr) arrays->mesh[i] = answer.mesh;
        }
    }
    return hits;
}

template <class Scalar>
std::size_t any_hits(const WorldScene<Scalar>& world, const Ways<Scalar>& ways, std::size_t first, std::size_t last,
                     std::uint8_t* out, const WorldOptions& options, QueryCounters& counters, std::size_t& invalid) {
    std::size_t hits = 0;
    for (std::size_t i = first; i < last; ++i) {
        bool hit = false;
        if (!ways.is_valid(i))
            ++invalid;
        else if (is_limit(options.max_fraction))
            hit = ways.with(i, [&](const auto& way) { return any_hit(world, way, options, counters); });
        out[i] = hit ? 1 : 0;
        hits += out[i];
    }
    return hits;
}

template <class Scalar>
void all_crossings(const WorldScene<Scalar>& world, const Ways<Scalar>& ways, std::size_t first, std::size_t last,
                   int* out, std::uint32_t mask, QueryCounters& counters, std::size_t& invalid) {
    for (std::size_t i = first; i < last; ++i) {
        out[i] = 0;
        if (!ways.is_valid(i))
            ++invalid;
        else
            out[i] = ways.with(i, [&](const auto& way) { return crossings(world, way, mask, counters); });
    }
}

/// Calls `put(i, winding number)`.
template <class Scalar, class Put>
void all_winding_numbers(const WorldScene<Scalar>& world, const PointsView<Scalar>& points, std::size_t first,
                         std::size_t last, std::uint32_t mask, QueryCounters& counters, std::size_t& invalid,
                         Put&& put) {
    for (std::size_t i = first; i < last; ++i) {
        const Vec3<Scalar> point = points[i];
        const bool valid = is_valid(point);
        if (!valid) ++invalid;
        put(i, valid ? winding_number(world, point, mask, counters) : 0);
    }
}

}  // namespace pierce::detail
