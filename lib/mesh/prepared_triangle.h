// A triangle as the filter reads it: Bloom's three planes on an anchor, and how far they may be wrong.
#pragma once

#include <point.h>

namespace pierce::detail {

/// Twelve numbers (Bloom 2002) and three bounds. Bloom stores an offset for each plane; here the planes are evaluated on x - b
/// instead, which keeps the bound tight far from the world's origin: b lies on all three.
struct PreparedTriangle {
    Point b;         ///< the second corner, exactly
    Point normal;    ///< see `Planes`
    Point weight_c;
    Point weight_a;
    /// Error bounds in units of R and R^2, R being the larger distance (in the maximum norm) of the segment's ends from b;
    /// derived in kernel/filter.h. Infinite where the planes are out of the range that the derivation needs.
    double plane_error;     ///< of normal . (x - b):                 times R
    double weight_c_error;  ///< of the weight of c times D:          times R^2
    double weight_a_error;  ///< of the weight of a times D:          times R^2
};

/// For a triangle whose area is not zero. Uses exact arithmetic: around half a microsecond.
[[nodiscard]] PreparedTriangle prepare(const Corners& corners);

}  // namespace pierce::detail
