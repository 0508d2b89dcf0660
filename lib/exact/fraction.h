// Where along a segment its hits lie: exact order, exact limits, and the values that are reported.
#pragma once

#include <exact/decide.h>

namespace pierce::detail {

/// The order of two hits of the same path: < 0 where the first comes before the second, 0 where their fractions are
/// equal.
/// Both triangles must be hit by the path.
[[nodiscard]] int compare_fractions(const Path& path, const Corners& first, const Corners& second);

/// Whether two hits of one path certainly lie on the same point because they lie on one edge or one vertex, by its
/// coordinates: a line that passes the plane of an edge meets it in one point. So their fractions are equal, and no
/// arithmetic is needed.
[[nodiscard]] bool same_place(const Corners& first, const Decision& one, const Corners& second, const Decision& two);

/// Whether two triangles certainly lie in one plane across an axis, by their coordinates: then a path that hits both
/// hits them at one fraction.
[[nodiscard]] bool in_one_axis_plane(const Corners& first, const Corners& second);

/// The order of the exact fraction of a hit and `limit`, which is at least 0.
[[nodiscard]] int compare_fraction(const Path& path, const Corners& corners, double limit);

/// Whether the exact fraction of a hit is at most `limit`. NaN: no.
[[nodiscard]] bool fraction_at_most(const Path& path, const Corners& corners, double limit);

/// Fraction and barycentric weights of a hit, each within (1/2 + 2^-8) ulp of the true value.
struct Measures {
    double fraction;
    Point barycentric;
};
[[nodiscard]] Measures measure(const Path& path, const Corners& corners);

}  // namespace pierce::detail
