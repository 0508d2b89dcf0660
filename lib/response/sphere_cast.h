// What the loop of a move asks where a ball moves: its center is what moves, and the planes that it is in contact with
// touch the ball.
//
// They are planes for corners and edges as well: the one across the way from the nearest point to the center. Along it
// the ball only gets further from the triangle, as the distance from a convex set is convex; so what slides along such
// planes goes round edges and corners, and the same loop, heights and targets as for points are right for it.
#pragma once

#include <query/sphere_step.h>
#include <response/mesh_cast.h>

namespace pierce::detail {

/// A cast (mesh_cast.h).
template <class Scalar>
class SphereCast {
  public:
    struct Surface {
        Corners corners;
        int side = 1;  ///< that the center is on
    };
    struct Stop : SphereStop {
        Point point;  ///< where its center goes
        Surface surface;
    };

    /// `from`: where the move begins.
    SphereCast(const Scene<Scalar>& scene, const Point& from, double radius, const QueryOptions& options,
               QueryCounters& counters)
        : scene_(scene),
          radius_(radius),
          grain_(sphere_grain(scene, from, radius)),
          options_(options),
          counters_(counters) {}

    [[nodiscard]] double grain() const { return grain_; }

    [[nodiscard]] bool meet(const Point& from, const Point& to, Stop& stop) const {
        ++counters_.queries;
        const double contact = k_contact_grains * grain_;
        if (!step_sphere(scene_, Path{from, to}, radius_, contact, options_, counters_, stop)) return false;
        stop.point = stop.center;
        stop.surface = {stop.corners, stop.side};
        return true;
    }
    /// Not in front of the triangle's plane: it gets no nearer to the triangle on the way there than it may.
    [[nodiscard]] bool in_front(const Surface& surface, const Point& from, const Point& point) const {
        ++counters_.exact_sides;
        return !sphere_is_stopped(surface.corners, Path{from, point}, radius_, counters_);
    }
    /// The triangle itself: a plane may touch the ball far from it.
    [[nodiscard]] bool is_near(const Surface& surface, const Point& point, const Point& /*normal*/) const {
        return distance_from(surface.corners, point) <= radius_ + 2 * k_contact_grains * grain_;
    }

  private:
    const Scene<Scalar>& scene_;
    double radius_;
    double grain_;
    const QueryOptions& options_;
    QueryCounters& counters_;
};

}  // namespace pierce::detail
