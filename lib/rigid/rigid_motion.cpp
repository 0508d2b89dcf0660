// Rigid motions made ready: checked, their poses made rotations, the turn cut into parts.
#include <pierce/motion.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <environment.h>
#include <point.h>
#include <rigid/turn.h>

namespace pierce {

using namespace detail;

namespace {

bool is_finite(const Vec3<double>& x) { return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]); }

// Not inlined: see environment.h.
[[gnu::noinline]] std::shared_ptr<const Turn> make_turn(const Pose<double>& from, const Pose<double>& to,
                                                        double tolerance, const Vec3<double>* pivot,
                                                        const Screw* screw) {
    if (!(tolerance > 0)) throw std::invalid_argument("RigidMotion: the tolerance is not more than 0");
    if (pivot != nullptr && !is_finite(*pivot)) throw std::invalid_argument("RigidMotion: the pivot is not finite");
    const auto turn = std::make_shared<Turn>();
    turn->before = make_placement(from);
    turn->after = make_placement(to);
    turn->tolerance = tolerance;
    if (pivot != nullptr) turn->pivot = to_point(*pivot);
    if (screw != nullptr) turn->pivot = image_of<double>(turn->before, to_point(screw->point));
    set_parts(*turn);
    return turn;
}

[[gnu::noinline]] Pose<double> pose_after(const Screw& screw, const Pose<double>& pose) {
    if (!is_finite(screw.point) || !is_finite(screw.direction) || !std::isfinite(screw.slide))
        throw std::invalid_argument("Screw: a number is not finite");
    if (!(std::abs(screw.angle) < std::numbers::pi)) throw std::invalid_argument("Screw: half a turn or more");
    const double size = screw.direction.cwiseAbs().maxCoeff();
    if (!(size > 0)) throw std::invalid_argument("Screw: no direction");
    const Vec3<double> axis = (screw.direction / size).normalized();
    const double s = std::sin(screw.angle);
    const double half = std::sin(screw.angle / 2);
    Eigen::Matrix3d across;
    across << 0, -axis[2], axis[1], axis[2], 0, -axis[0], -axis[1], axis[0], 0;
    // Rodrigues: 1 + sin K + (1 - cos) K^2
    const Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity() + s * across + 2 * half * half * (across * across);
    Pose<double> out;
    out.rotation = rotation * pose.rotation;
    out.translation = screw.point + rotation * (pose.translation - screw.point) + screw.slide * axis;
    return out;
}

template <class Scalar>
[[gnu::noinline]] Vec3<Scalar> image(const Placement& placement, const Vec3<Scalar>& point) {
    return to_vector<Scalar>(image_of<Scalar>(placement, to_point(point)));
}
template <class Scalar>
[[gnu::noinline]] Vec3<Scalar> outside(const Placement& placement, const Vec3<Scalar>& point) {
    return to_vector<Scalar>(out_of(placement, to_point(point)));
}
template <class Scalar>
[[gnu::noinline]] std::size_t count_chords(const Turn& turn, const Segment<Scalar>& way) {
    const Curve curve = Curve::between<Scalar>(turn, image_of<Scalar>(turn.before, to_point(way.from)),
                                               image_of<Scalar>(turn.after, to_point(way.to)));
    return std::isfinite(curve.rounding) ? std::size_t{1} << curve.level : 0;
}

template <class Scalar>
Vec3<Scalar> nowhere() {
    return Vec3<Scalar>::Constant(std::numeric_limits<Scalar>::quiet_NaN());
}

}  // namespace

Pose<double> moved_by(const Screw& screw, const Pose<double>& pose) {
    const StandardArithmetic standard;
    return pose_after(screw, pose);
}

RigidMotion::RigidMotion(const Pose<double>& from, const Pose<double>& to, double tolerance, const Vec3<double>& pivot)
    : end_(to) {
    const StandardArithmetic standard;
    turn_ = make_turn(from, to, tolerance, &pivot, nullptr);
}

RigidMotion::RigidMotion(const Pose<double>& from, const Screw& screw, double tolerance) {
    const StandardArithmetic standard;
    end_ = pose_after(screw, from);
    turn_ = make_turn(from, end_, tolerance, nullptr, &screw);
}

template <class Scalar>
Vec3<Scalar> RigidMotion::start_in_mesh(const Vec3<Scalar>& point) const noexcept {
    const StandardArithmetic standard;
    return turn_ ? image(turn_->before, point) : nowhere<Scalar>();
}
template <class Scalar>
Vec3<Scalar> RigidMotion::end_in_mesh(const Vec3<Scalar>& point) const noexcept {
    const StandardArithmetic standard;
    return turn_ ? image(turn_->after, point) : nowhere<Scalar>();
}
template <class Scalar>
Vec3<Scalar> RigidMotion::end_in_world(const Vec3<Scalar>& point) const noexcept {
    const StandardArithmetic standard;
    return turn_ ? outside(turn_->after, point) : nowhere<Scalar>();
}
template <class Scalar>
std::size_t RigidMotion::chords(const Segment<Scalar>& way) const noexcept {
    const StandardArithmetic standard;
    return turn_ ? count_chords(*turn_, way) : 0;
}

#define PIERCE_MOTIONS(Scalar)                                                                          \
    template PIERCE_EXPORT Vec3<Scalar> RigidMotion::start_in_mesh(const Vec3<Scalar>&) const noexcept; \
    template PIERCE_EXPORT Vec3<Scalar> RigidMotion::end_in_mesh(const Vec3<Scalar>&) const noexcept;   \
    template PIERCE_EXPORT Vec3<Scalar> RigidMotion::end_in_world(const Vec3<Scalar>&) const noexcept;  \
    template PIERCE_EXPORT std::size_t RigidMotion::chords(const Segment<Scalar>&) const noexcept
PIERCE_MOTIONS(float);
PIERCE_MOTIONS(double);
#undef PIERCE_MOTIONS

}  // namespace pierce
