// Which closed triangles a point lies in, and which ones a segment meets in one point: more than the closed rule hits,
// and all that either rule may count.
#pragma once

#include <decision.h>
#include <point.h>

namespace pierce::detail {

/// Whether the point lies in the closed triangle (`hit`), and on what of it. In one of area zero no point lies.
[[nodiscard]] Decision touch(const Point& point, const Corners& corners);

struct PathTouch {
    Decision decision;    ///< `hit`: it is touched; `side`: the one that the path's direction comes from
    bool at_end = false;  ///< the path ends on the plane: its fraction is 1
};

/// Whether the closed segment meets the closed triangle in one point and leads through its plane or up to it: its ends
/// are neither both on the plane nor both strictly on one side.
///
/// All that the closed rule hits under any `Sides` is touched, and so is all that `crossing` counts: an infinitesimal
/// move brings no two closed sets together that are apart, and ends in one plane stay on one side of it.
[[nodiscard]] PathTouch touch(const Path& path, const Corners& corners);

}  // namespace pierce::detail
