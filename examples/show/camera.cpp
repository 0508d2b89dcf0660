// See camera.h.
#include "show/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace show {

constexpr double k_tangent_of_view = 0.27;  // of half the vertical angle: about 30 degrees in all

Camera::Camera(std::span<const Point> points, const View& view)
    : tangent_(k_tangent_of_view * view.width / view.height, k_tangent_of_view) {
    const double azimuth = view.azimuth * std::numbers::pi / 180;
    const double elevation = view.elevation * std::numbers::pi / 180;
    const Point side = Point::UnitX();
    const Point front = view.z_is_up ? Point(0, -1, 0) : Point(0, 0, 1);
    const Point up = view.z_is_up ? Point(0, 0, 1) : Point(0, 1, 0);
    axes_.col(0) = std::cos(azimuth) * side - std::sin(azimuth) * front;
    axes_.col(2) =
        std::cos(elevation) * (std::cos(azimuth) * front + std::sin(azimuth) * side) + std::sin(elevation) * up;
    axes_.col(1) = axes_.col(2).cross(axes_.col(0));

    Eigen::AlignedBox3d box;
    for (const Point& point : points) box.extend(Point(axes_.transpose() * point));
    const Point middle = box.center();
    double distance = 0;
    const Eigen::Array2d inner = tangent_ * 0.92;  // leaves a margin
    for (const Point& point : points) {
        const Eigen::Array3d offset = Point(axes_.transpose() * point) - middle;
        distance = std::max(distance, offset.z() + (offset.head<2>().abs() / inner).maxCoeff());
    }
    distance /= view.zoom;
    eye_ = axes_ * (middle + Point(0, 0, distance));
    depth_ = 1.01 * (distance + middle.z() - box.min().z());
}

}  // namespace show
