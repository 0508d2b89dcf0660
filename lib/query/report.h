// The rounded values of a decided hit, put into the caller's Hit. (The verified point and its fraction: place.h.)
#pragma once

#include <cstring>

#include <decision.h>
#include <kernel/values.h>
#include <pierce/hit.h>

namespace pierce::detail {

/// Writes everything but `fraction` and `point`, from what is certified (values.h).
template <class Scalar>
void report(const Rounded<Scalar>& rounded, const Decision& decision, std::uint32_t face, std::uint32_t triangle,
            Hit<Scalar>& hit) {
    std::memcpy(&hit.position, rounded.position, sizeof hit.position);
    std::memcpy(&hit.normal, rounded.normal, sizeof hit.normal);
    std::memcpy(&hit.barycentric, rounded.weights, sizeof hit.barycentric);
    hit.exact_fraction = rounded.weights[3];
    hit.face = face;
    hit.triangle = triangle;
    hit.side = decision.side;
    hit.feature = decision.feature;
    hit.feature_index = decision.feature_index;
    hit.at_start = decision.at_start;
    hit.reserved = 0;
}

}  // namespace pierce::detail
