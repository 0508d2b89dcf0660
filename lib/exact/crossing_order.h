// The order in which a path crosses faces, by the second rule.
#pragma once

#include <point.h>

namespace pierce::detail {

/// The order of two crossings of one path (crossing.h says what these are): < 0 where the first comes before the
/// second. 0 means that both triangles lie in one plane: then the path, moved, crosses both in one point, and the rule
/// has no order for them. Both triangles must be crossed by the path.
[[nodiscard]] int compare_crossings(const Path& path, const Corners& first, const Corners& second);

}  // namespace pierce::detail
