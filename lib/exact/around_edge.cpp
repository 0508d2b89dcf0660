// Turns about an edge: with n = (v - u) x (r - u) the way from the half-plane through r by the right hand is along n,
// the front of the triangle u, v, r. So the side of x says which half of the turn it is in. On the plane itself the
// normal of u, v, x is parallel to n, and along it where the half-planes are one.
#include <exact/around_edge.h>

#include <exact/decide.h>
#include <exact/volumes.h>

namespace pierce::detail {

namespace {

int normal_sign(const Corners& corners) {
    return with_volumes(Path{corners[0], corners[0]}, corners,
                        [](const auto& volumes) { return volumes.normal_shift(); });
}

}  // namespace

int turn_of(const Point& u, const Point& v, const Point& reference, const Point& x) {
    const Corners corners = {u, v, reference};
    const int side = side_of(corners, x);
    if (side != 0) return side > 0 ? 1 : 3;
    return normal_sign(corners) == normal_sign({u, v, x}) ? 0 : 2;
}

}  // namespace pierce::detail
