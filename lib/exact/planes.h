// The planes of Bloom's test for one triangle, rounded once from their exact values.
#pragma once

#include <point.h>

namespace pierce::detail {

/// Three linear functions of x - b, b being the second corner, which lies on all three planes (Bloom 2002, "Fast ray
/// tri (with precomputation)", in the corrected form: `normal` points to the front).
struct Planes {
    Point normal;    ///< n = (b-a) x (c-a), scaled by a power of two so that its largest component is in [1/2, 1]
    Point weight_c;  ///< the barycentric plane through edge ab and along n: reads 1 at c
    Point weight_a;  ///< the one through edge bc: reads 1 at a
};

/// Each number is within (1/2 + 2^-8) ulp of the exact one, or infinite or denormal where that is out of range. All are
/// zero for a triangle of area zero.
[[nodiscard]] Planes exact_planes(const Corners& corners);

}  // namespace pierce::detail
