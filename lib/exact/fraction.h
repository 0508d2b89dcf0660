// Where along a segment its hits lie: exact order, exact limits, and the values that are reported.
#pragma once

#include <exact/decide.h>

namespace pierce::detail {

/// The order of two triangles along a path: < 0 where the first comes before the second, 0 where their fractions are
/// equal. The path must hit both, or touch them (touch.h): its ends are not both on a plane, nor strictly on one side.
[[nodiscard]] int compare_fractions(const Path& path, const Corners& first, const Corners& second);

/// The same for two paths, each with a triangle of its own.
[[nodiscard]] int compare_fractions(const Path& one, const Corners& first, const Path& other, const Corners& second);

/// Whether two triangles, hit or touched by one path, certainly are so in the same point because they lie on one edge
/// or one vertex, by its coordinates: a line that passes the plane of an edge meets it in one point. So their fractions
/// are equal, and no arithmetic is needed.
[[nodiscard]] bool same_place(const Corners& first, const Decision& one, const Corners& second, const Decision& two);

/// Whether two triangles certainly lie in one plane across an axis, by their coordinates: then a path that hits both
/// hits them at one fraction.
[[nodiscard]] bool in_one_axis_plane(const Corners& first, const Corners& second);

/// The order of the exact fraction of a triangle that the path hits or touches and `limit`, which is at least 0.
[[nodiscard]] int compare_fraction(const Path& path, const Corners& corners, double limit);

/// Whether the exact fraction of a triangle that the path hits or touches is at most `limit`. NaN: no.
[[nodiscard]] bool fraction_at_most(const Path& path, const Corners& corners, double limit);

/// Fraction and barycentric weights of a triangle that is hit or touched, each within (1/2 + 2^-8) ulp of the true
/// value.
struct Measures {
    double fraction;
    Point barycentric;
};
[[nodiscard]] Measures measure(const Path& path, const Corners& corners);

/// The caller's parameter of a triangle that a ray hits or touches (`Path::exponent`), as near. Its fraction may be far
/// below what a double can say. Infinity above the range.
[[nodiscard]] double measure_parameter(const Path& path, const Corners& corners);

}  // namespace pierce::detail
