// When a sphere on its way comes nearer to a triangle than its radius: certainly not, or from a time on that is a lower
// bound. Certified, by plain doubles where they can tell, else exactly.
#pragma once

#include <cstdint>

#include <sphere/nearest.h>

namespace pierce::detail {

/// A sphere and its way, made ready for triangles. Numbers for these are in units of about the distance of the furthest
/// of them, relative to the start: `unit`, a power of two, times the caller's.
struct Sphere {
    Path path;
    double radius;  ///< the caller's
    double unit = 1;
    double scaled_radius = 0;
    Point scaled_from{};  ///< the start, times `unit` only
    Point way{};
    double way_size = 0;
    /// How much later than its lower bound a sphere may enter a triangle, in parts of the way.
    double width = 1;
    /// Numbers are in a range in which nothing overflows, and what underflows is nothing beside the bounds.
    bool tame = false;
    bool moves = false;  ///< the way's as well

    /// `reach` is at least the distance of any triangle's point from the start in each coordinate; may be infinite.
    Sphere(const Path& path, double radius, double reach);
};

/// Of a sphere that enters a triangle.
struct Entry {
    double time = 0;        ///< a lower bound, in parts of the way; not exact, but the same for the same input
    bool at_start = false;  ///< it is no further away than the radius at the start, and comes nearer
    bool overlaps = false;  ///< nearer than the radius at the start
    double distance = 0;    ///< at the start, about; in scaled units
    double reach = 0;       ///< how far the triangle's furthest corner is from the start, in a coordinate; scaled
    /// At that time: the nearest point of the triangle, where the center is, and the unit vector between; relative to
    /// the start, scaled.
    Nearest nearest;
    Point center{};
    Point normal{};
};

struct SphereCounts {
    std::uint64_t exact = 0;
};

/// Whether the sphere enters the triangle, unless that is certainly later than `limit`.
///
/// A sphere that is further away from the triangle than its radius at the start enters it if it comes nearer than that
/// on its way; to touch is not enough. One that is as far away as that or nearer does if it comes nearer than it was:
/// at time 0. As the distance from a convex set is convex in the time, it else never does.
[[nodiscard]] bool enters(const Sphere& sphere, const Corners& corners, double limit, SphereCounts& counts,
                          Entry& entry);

/// Whether the sphere at the start of its way is no further from the triangle than its radius. Sets all but `at_start`
/// of the entry.
[[nodiscard]] bool touches(const Sphere& sphere, const Corners& corners, SphereCounts& counts, Entry& entry);

}  // namespace pierce::detail
