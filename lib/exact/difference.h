// A way whose ends are differences of two points each, which need not be numbers: what is left of a point's way where
// the mesh moves as well, without a turn. Decided as any other.
#pragma once

#include <exact/fraction.h>

namespace pierce::detail {

/// From `from - from_off` to `to - to_off`.
struct DifferencePath {
    Point from;
    Point from_off;
    Point to;
    Point to_off;
};

// As in decide.h and fraction.h.
[[nodiscard]] Decision decide(const DifferencePath& path, const Corners& corners, Sides sides);
[[nodiscard]] int compare_fractions(const DifferencePath& path, const Corners& first, const Corners& second);
[[nodiscard]] int compare_fraction(const DifferencePath& path, const Corners& corners, double limit);
/// The fraction within (1/2 + 2^-8) ulp.
[[nodiscard]] double measure_fraction(const DifferencePath& path, const Corners& corners);

}  // namespace pierce::detail
