// Lays a polygon flat along the dominant axis of its normal, and tells whether its fan is already a correct cut.
#include "mesh/read_polygon.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

namespace pierce::detail {

template <class Scalar>
void PolygonCutter<Scalar>::cut(std::span<IndexTriple> triangles) {
    collect_corners(triangles);
    project();
    if (fan_covers()) {
        return;
    }
    clipper_.cut(flat_, triangles);
    for (IndexTriple& triangle : triangles) {  // from places in the polygon to vertices
        for (std::uint32_t& corner : triangle) {
            corner = corners_[corner];
        }
    }
}

template <class Scalar>
void PolygonCutter<Scalar>::collect_corners(std::span<const IndexTriple> fan) {
    corners_.assign({fan[0][0], fan[0][1]});
    for (const IndexTriple& triangle : fan) {
        corners_.push_back(triangle[2]);
    }
    double largest = 0;
    points_.clear();
    for (const std::uint32_t corner : corners_) {
        points_.push_back(positions_[corner].template cast<double>());
        largest = std::max(largest, points_.back().template lpNorm<Eigen::Infinity>());
    }
    // Far from 1, squares would overflow or vanish. A power of two changes no sign.
    if (largest > 0x1p100 || (largest < 0x1p-100 && largest > 0)) {
        const int exponent = -std::ilogb(largest);
        for (Vec3<double>& point : points_) {
            point = point.unaryExpr([exponent](double x) { return std::scalbn(x, exponent); });
        }
    }
}

/// Drops the axis along which Newell's normal (Sutherland, Sproull, Schumacker 1974, "A Characterization of Ten
/// Hidden-Surface Algorithms") is longest; no coordinate is changed, so no sign of a turn is either. The two others are
/// ordered such that the polygon runs counter-clockwise.
template <class Scalar>
void PolygonCutter<Scalar>::project() {
    Vec3<double> normal = Vec3<double>::Zero();
    Eigen::AlignedBox3d box(points_[0]);
    for (std::size_t i = 2; i < points_.size(); ++i) {
        normal += (points_[i - 1] - points_[0]).cross(points_[i] - points_[0]);
    }
    for (const Vec3<double>& point : points_) {
        box.extend(point);
    }
    Eigen::Index axis = 0;
    if (normal.cwiseAbs().maxCoeff(&axis) == 0) {
        box.sizes().minCoeff(&axis);
    }
    flat_.clear();
    for (const Vec3<double>& point : points_) {
        flat_.push_back({point[(axis + 1) % 3], point[(axis + 2) % 3]});
    }
    const int turn = turn_at_lowest_corner();
    if (turn < 0 || (turn == 0 && normal[axis] < 0)) {
        for (Point2& point : flat_) {
            std::swap(point[0], point[1]);
        }
    }
}

/// A polygon that does not cross itself turns at its extreme corner as it does as a whole. This is exact, while the
/// sign of the rounded normal is wrong for some needles. If the outline passes the extreme point more than once, the
/// first turn that is not straight counts.
template <class Scalar>
int PolygonCutter<Scalar>::turn_at_lowest_corner() const {
    const Point2 lowest = *std::min_element(flat_.begin(), flat_.end());
    for (std::size_t i = 0; i < flat_.size(); ++i) {
        if (flat_[i] == lowest) {
            const Point2& before = flat_[i == 0 ? flat_.size() - 1 : i - 1];
            const Point2& after = flat_[i + 1 == flat_.size() ? 0 : i + 1];
            if (const int turn = orient2d(before, flat_[i], after); turn != 0) {
                return turn;
            }
        }
    }
    return 0;
}

/// Triangles that all turn left, and that together have the polygon's outline, cover it once: at each point, the number
/// of triangles around it is the winding number of the outline, which is 1 inside of a polygon that does not cross
/// itself.
template <class Scalar>
bool PolygonCutter<Scalar>::fan_covers() const {
    for (std::size_t i = 2; i < flat_.size(); ++i) {
        if (orient2d(flat_[0], flat_[i - 1], flat_[i]) <= 0) {
            return false;
        }
    }
    return true;
}

template class PolygonCutter<float>;
template class PolygonCutter<double>;

}  // namespace pierce::detail
