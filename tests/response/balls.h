// What is clear for balls that move: by rational arithmetic, triangle by triangle.
#pragma once

#include <support/sphere_oracle.h>

#include <point.h>

#include "ramps.h"

namespace pierce::test {

using detail::Corners;
using detail::to_point;

template <class Scalar>
std::vector<Corners> corners_of(const TriangleSoup<Scalar>& soup) {
    std::vector<Corners> all;
    for (const IndexTriple& t : soup.triangles)
        all.push_back({to_point(soup.positions[t[0]]), to_point(soup.positions[t[1]]), to_point(soup.positions[t[2]])});
    return all;
}

template <class Scalar>
bool is_clear(const std::vector<Corners>& triangles, const Vec3<Scalar>& at, Scalar radius) {
    const SphereOracle oracle({to_point(at), to_point(at)}, static_cast<double>(radius));
    return std::all_of(triangles.begin(), triangles.end(), [&](const Corners& c) { return oracle.gap(c) >= 0; });
}

// A move's ways are those from contact to contact, and from the last one to where it ends.
template <class Scalar>
int ways_with_a_hit(const std::vector<Corners>& triangles, const Vec3<Scalar>& from, Scalar radius,
                    const Move<Scalar>& move, std::span<const MoveContact<Scalar>> contacts) {
    std::vector<Vec3<Scalar>> places{from};
    for (std::size_t i = 0; i < move.contacts; ++i) places.push_back(contacts[i].point);
    places.push_back(move.position);
    int hits = 0;
    for (std::size_t i = 1; i < places.size(); ++i) {
        if (places[i] == places[i - 1]) continue;
        const SphereOracle oracle({to_point(places[i - 1]), to_point(places[i])}, static_cast<double>(radius));
        for (const Corners& c : triangles) hits += oracle.hits(c) ? 1 : 0;
    }
    return hits;
}

}  // namespace pierce::test
