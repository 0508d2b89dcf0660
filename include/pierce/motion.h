// How a mesh that keeps its shape moves during a step: along a straight line, or turning as well.
#pragma once

#include <cstddef>
#include <memory>

#include <pierce/export.h>
#include <pierce/pose.h>
#include <pierce/types.h>

namespace pierce {

template <class Scalar>
class MotionSweeps;

namespace detail {
struct Turn;
}

/// The mesh stands at `from` at the start of the step and at `to` at its end, and goes straight in between: a point x
/// of it is at x + from, and x + to. These are the exact sums, which need not be numbers of the type.
template <class Scalar>
struct Translation {
    Vec3<Scalar> from;  ///< the translation at the start of the step
    Vec3<Scalar> to;    ///< the translation at its end
};

template <class Scalar>
Translation(Vec3<Scalar>, Vec3<Scalar>) -> Translation<Scalar>;

/// The way of a point that sits on a turning mesh and leaves it: `from` in the mesh's own coordinates, as
/// `RigidHit::local` gives it, `to` in the world.
template <class Scalar>
struct Ride {
    Vec3<Scalar> from;  ///< in the mesh's coordinates
    Vec3<Scalar> to;    ///< in the world
};

template <class Scalar>
Ride(Vec3<Scalar>, Vec3<Scalar>) -> Ride<Scalar>;

/// A turn about an axis and a slide along it, as of a wheel or a door, in the world.
struct Screw {
    Vec3<double> point;      ///< of the axis, at the start of the step
    Vec3<double> direction;  ///< of the axis, of any length but 0
    double angle;      ///< in radians, counter-clockwise seen from where `direction` points; less than half a turn
    double slide = 0;  ///< along the axis, in units of the world
};

/// Where `pose` is after the screw. (By the C library's sine and cosine, which differ between systems by a bit; all
/// else in the library does not.)
[[nodiscard]] PIERCE_EXPORT Pose<double> moved_by(const Screw& screw, const Pose<double>& pose);

/// A mesh that turns during a step: from one pose to another at constant angular velocity, the shorter way round, while
/// one of its points, the pivot, goes straight at constant velocity.
///
/// **What a sweep decides.** Seen from the mesh, a point that goes straight in the world goes along a curve. The curve
/// is cut into 2^m equal parts of time, each replaced by its chord, between points rounded to the mesh's numbers; what
/// the chords hit is decided exactly. m is the least one for which, at each time, the point on the chord is no further
/// than `tolerance` (a length in the world, the same in the mesh) from where the point truly is, rounding included:
///
///     (a^2 r + 2 a v) / (8 * 4^m) + rounding <= tolerance
///
/// with the angle a of the turn, the point's largest distance r from the axis through the pivot, and v, how far the
/// point goes relative to the pivot. So a way that comes more than the tolerance deep into a closed mesh is a hit, and
/// what is hit is no further than the tolerance from where the point is. A tolerance below what rounding does is taken
/// as that: for float 2^-19, for double 2^-40 times the largest |coordinate| of the point, seen from the pivot, plus
/// that of the pivot. The angle is at most half a turn: cut longer ones into several steps.
///
/// **Chains.** The chord's ends are `start_in_mesh(from)` and `end_in_mesh(to)`: each is one fixed function of a pose
/// and a point. So where the next step's first pose is this one's last, and the point goes on from where it was put,
/// the chords of all steps are one chain, and no chain gets through a closed mesh without a hit: whatever the
/// tolerance.
///
/// Poses are as in a `World`: the nearest true rotation is taken for each. Copies are cheap (a shared pointer), and
/// any number of threads may use one. One that was moved from hits nothing.
class PIERCE_EXPORT RigidMotion {
  public:
    /// `pivot`: in the mesh's coordinates. Throws std::invalid_argument where a pose is none (`Pose`), a coordinate of
    /// the pivot is not finite, or the tolerance is not more than 0.
    RigidMotion(const Pose<double>& from, const Pose<double>& to, double tolerance,
                const Vec3<double>& pivot = Vec3<double>::Zero());
    /// Throws the same where the screw has a number that is not finite, no axis, or turns by half or more.
    RigidMotion(const Pose<double>& from, const Screw& screw, double tolerance);

    /// The last pose, as it was given or made: the next step's first one.
    [[nodiscard]] const Pose<double>& end() const noexcept { return end_; }

    /// Where the mesh has a point of the world at the start of the step: rounded to `Scalar`, and what sweeps go by.
    /// Not finite: not finite.
    template <class Scalar>
    [[nodiscard]] Vec3<Scalar> start_in_mesh(const Vec3<Scalar>& point) const noexcept;
    /// The same at the end of the step.
    template <class Scalar>
    [[nodiscard]] Vec3<Scalar> end_in_mesh(const Vec3<Scalar>& point) const noexcept;
    /// Where a point of the mesh is in the world at the end of the step, rounded: for a rider that stays where it is.
    template <class Scalar>
    [[nodiscard]] Vec3<Scalar> end_in_world(const Vec3<Scalar>& point) const noexcept;

    /// How many chords a sweep of this way has. Those that do not come near the mesh's box cost next to nothing.
    template <class Scalar>
    [[nodiscard]] std::size_t chords(const Segment<Scalar>& way) const noexcept;

  private:
    template <class Scalar>
    friend class MotionSweeps;

    Pose<double> end_;
    std::shared_ptr<const detail::Turn> turn_;  ///< null where it was moved from
};

}  // namespace pierce
