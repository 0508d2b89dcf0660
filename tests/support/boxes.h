// Boxes of segments and triangles, compared without rounding.
#pragma once

#include <algorithm>

#include <point.h>

namespace pierce::test {

inline bool boxes_apart(const detail::Path& path, const detail::Corners& c) {
    for (std::size_t k = 0; k < 3; ++k) {
        if (std::max(path.from[k], path.to[k]) < std::min({c[0][k], c[1][k], c[2][k]})) return true;
        if (std::min(path.from[k], path.to[k]) > std::max({c[0][k], c[1][k], c[2][k]})) return true;
    }
    return false;
}

}  // namespace pierce::test
