// Where the values of a decided hit are rounded: fraction, weights, normal. (The verified point: place.h.)
#pragma once

#include <cmath>

#include <exact/decide.h>
#include <exact/fraction.h>
#include <pierce/hit.h>

namespace pierce::detail {

/// Writes everything but `fraction`, `point` and `position`, from what is certified (values.h).
template <class Scalar>
void report(const Measures& measures, const Point& normal, const Decision& decision, std::uint32_t face,
            std::uint32_t triangle, Hit<Scalar>& hit) {
    const double inverse = 1 / std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    for (int k = 0; k < 3; ++k) {
        const auto at = static_cast<std::size_t>(k);
        hit.normal[k] = static_cast<Scalar>(normal[at] * inverse);
        hit.barycentric[k] = static_cast<Scalar>(measures.barycentric[at]);
    }
    hit.exact_fraction = static_cast<Scalar>(measures.fraction);
    hit.face = face;
    hit.triangle = triangle;
    hit.side = decision.side;
    hit.feature = decision.feature;
    hit.feature_index = decision.feature_index;
    hit.at_start = decision.at_start;
}

}  // namespace pierce::detail
