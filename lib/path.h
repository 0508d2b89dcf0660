// The core's own points: plain doubles, into which float and double coordinates both go without change.
#pragma once

#include <array>
#include <limits>

#include <pierce/sides.h>

namespace pierce::detail {

using Point = std::array<double, 3>;

/// The corners of a triangle, counter-clockwise seen from its front.
using Corners = std::array<Point, 3>;

/// What a query goes along: from `from` to `to`, or for a ray from `from` to `from + to`, a sum that need not be a
/// number. Fractions are of that way. Of a ray it has a finite length, whatever the ray's (query/ray_path.h).
struct Path {
    Point from;
    Point to;
    bool ray = false;
    /// A ray of floats whose direction is not in the range in which the filter is proved for floats (meeting.h).
    bool wild = false;
    /// The caller's parameter is 2^exponent times the fraction.
    int exponent = 0;
    /// Hits beyond this fraction don't count.
    double most = std::numeric_limits<double>::infinity();
    /// The fraction at which a ray ends, if that is before its way does.
    double end = std::numeric_limits<double>::infinity();
};

/// Whether a hit that lies exactly on the end of a path counts, by the side that it comes from: it does where on the
/// plane is another side than the start's (decision.h).
[[nodiscard]] constexpr bool counts_at_end(Sides side, Sides sides) {
    return side == Sides::back && sides == Sides::both;
}

}  // namespace pierce::detail
