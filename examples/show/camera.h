// A camera that looks at the middle of a mesh from just so far that all of it is in view.
#pragma once

#include <array>
#include <optional>
#include <span>

#include <pierce/types.h>
#include <Eigen/Core>

namespace show {

using Point = pierce::Vec3<double>;

struct View {
    int width = 800;
    int height = 600;
    double azimuth = 30;    ///< degrees; 0 looks at the front, 90 at the right-hand side
    double elevation = 20;  ///< degrees above the horizon
    bool z_is_up = false;   ///< else y
    int samples = 1;        ///< along each side of a pixel: this many, squared, in all
    double zoom = 1;        ///< how many times nearer than where all is in view
};

class Camera {
  public:
    /// `points`: what is to be in view.
    Camera(std::span<const Point> points, const View& view);

    [[nodiscard]] const Point& eye() const { return eye_; }
    /// To the right, up, and towards the camera.
    [[nodiscard]] const Eigen::Matrix3d& axes() const { return axes_; }
    /// How far it sees: beyond all of the points, and no two of them are further apart.
    [[nodiscard]] double depth() const { return depth_; }

    /// The end, behind the mesh, of the line of sight through a place in the picture: -1 is left and bottom.
    [[nodiscard]] Point end_of_sight(double x, double y) const {
        return eye_ + depth_ * (axes_ * Point(x * tangent_.x(), y * tangent_.y(), -1));
    }
    /// Where a point is in the picture (x, y as above), and how far away along the middle line of sight: not above 0
    /// behind the camera.
    [[nodiscard]] Point project(const Point& point) const {
        const Point local = axes_.transpose() * (point - eye_);
        return {local.x() / -local.z() / tangent_.x(), local.y() / -local.z() / tangent_.y(), -local.z()};
    }
    [[nodiscard]] const Eigen::Array2d& tangent() const { return tangent_; }  ///< of half the angles of view

  private:
    Eigen::Array2d tangent_;
    Eigen::Matrix3d axes_;
    Point eye_;
    double depth_ = 0;
};

}  // namespace show
