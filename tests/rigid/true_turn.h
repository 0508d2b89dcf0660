// The motion of a mesh on a screw, in long double, by sines: where the mesh truly is at any time of the step.
#pragma once

#include <cmath>

#include <pierce/motion.h>

namespace pierce::test {

using Long3 = Eigen::Matrix<long double, 3, 1>;

class TrueTurn {
  public:
    TrueTurn(const Pose<double>& pose, const Screw& screw)
        : rotation_(pose.rotation.cast<long double>()),
          translation_(pose.translation.cast<long double>()),
          point_(screw.point.cast<long double>()),
          axis_(screw.direction.cast<long double>().normalized()),
          angle_(screw.angle),
          slide_(screw.slide) {
        // The pose's rotation was rounded: one step towards the nearest one.
        const Eigen::Matrix<long double, 3, 3> square = rotation_.transpose() * rotation_;
        rotation_ = (rotation_ * (3 * Eigen::Matrix<long double, 3, 3>::Identity() - square) / 2).eval();
    }
    [[nodiscard]] Long3 in_mesh(const Long3& p, long double time) const {
        const Long3 back = turned(p - point_ - slide_ * time * axis_, -angle_ * time) + point_;
        return rotation_.transpose() * (back - translation_);
    }
    [[nodiscard]] Long3 in_world(const Long3& x, long double time) const {
        return turned(rotation_ * x + translation_ - point_, angle_ * time) + point_ + slide_ * time * axis_;
    }
    [[nodiscard]] Long3 direction(const Long3& x, long double time) const {
        return turned(rotation_ * x, angle_ * time);
    }

  private:
    [[nodiscard]] Long3 turned(const Long3& x, long double a) const {
        const Long3 u = axis_;
        const Long3 across(u[1] * x[2] - u[2] * x[1], u[2] * x[0] - u[0] * x[2], u[0] * x[1] - u[1] * x[0]);
        return std::cos(a) * x + std::sin(a) * across + (1 - std::cos(a)) * axis_.dot(x) * axis_;
    }
    Eigen::Matrix<long double, 3, 3> rotation_;
    Long3 translation_, point_, axis_;
    long double angle_, slide_;
};

}  // namespace pierce::test
