// What the loop of a move asks of a mesh: what a step runs into, and whether a point is in front of what was met.
#pragma once

#include <cmath>

#include <query/answer.h>
#include <query/half_spaces.h>

namespace pierce::detail {

/// How far from a plane a particle may be, in grains, and still be in contact with it. A stopped one is a grain off, or
/// three where its place was looked for near an edge (k_reach_units); rounding of a few slides adds to that.
inline constexpr double k_contact_grains = 4;

/// Whether a point is within `distance` of the prism on this side of a triangle; `normal`: the unit one on that side.
[[nodiscard]] inline bool is_above(const Corners& corners, int side, const Point& point, const Point& normal,
                                   double distance) {
    for (std::size_t k = 0; k < 3; ++k) {
        const Point edge = difference_of(corners[(k + 1) % 3], corners[k]);
        const double inside = side * dot_product(cross_product(normal, edge), difference_of(point, corners[k]));
        if (inside < -distance * std::sqrt(dot_product(edge, edge))) return false;
    }
    return true;
}

/// A cast is what a move loop (move_loop.h) is written over; a sphere's has the same (sphere_cast.h):
///   grain()                          how near a point may come to a plane, as a length
///   Surface                          what was met, to be asked about again
///   meet(from, to, stop)             whether the step from -> to runs into something
///   in_front(surface, from, point)   whether what goes from a place to a point is certainly not behind it there
///   is_near(surface, point, normal)  whether it is next to the point, which lies near its plane
template <class Scalar>
class MeshCast {
  public:
    struct Surface {
        Corners corners;
        int side = 1;  ///< 1: seen from the front; -1: from the back
    };
    struct Stop {
        bool in_contact;  ///< `from` is so near to the plane that the particle stays there; else it goes to `point`
        Point point;
        double fraction;  ///< of the step, up to `point`
        Point normal;     ///< unit, towards the particle
        double height;    ///< of `point` above the plane
        Surface surface;
        std::uint32_t face;
        std::uint32_t triangle;
    };

    MeshCast(const Scene<Scalar>& scene, const QueryOptions& options, QueryCounters& counters)
        : scene_(scene), options_(options), counters_(counters) {}

    [[nodiscard]] double grain() const { return scene_.grain; }

    [[nodiscard]] bool meet(const Point& from, const Point& to, Stop& stop) const {
        ++counters_.queries;
        const Path path{from, to};
        First<Scalar> first(scene_, path, counters_);
        traverse<Certified>(scene_, path, options_, counters_, first);
        if (!first.found()) return false;
        const Candidate& best = first.best();
        stop.surface = {scene_.corners(best.triangle), best.decision.side == Sides::front ? 1 : -1};
        stop.triangle = scene_.number_of(best.triangle);
        stop.face = scene_.face_of_number(stop.triangle);
        stop.fraction = 0;
        stop.point = from;
        // Where the particle stays, the normal and a height are all that is needed: what takes exact arithmetic in most
        // hits from so near, the fraction, is not.
        Values values;
        Rounded<Scalar> rounded;
        scene_.narrow().evaluate(best.measured, best.decision.side, scene_.grain, values, rounded);
        if (!normal_is_near<Scalar>(values)) Certified::certify(scene_, best, path, counters_, values, rounded);
        set_normal(values, stop);
        // (At the start it is 0 or meaningless.)
        stop.height = best.decision.at_start ? 0 : values.distance / values.length;
        stop.in_contact = stop.height <= k_contact_grains * scene_.grain;
        if (stop.in_contact) return true;
        Certified::certify(scene_, best, path, counters_, values, rounded);
        set_normal(values, stop);
        Hit<Scalar> hit;
        write_answer<Certified>(scene_, path, best, values, rounded, none_passed, options_, counters_, &first.list(),
                                hit);
        stop.fraction = static_cast<double>(hit.fraction);
        stop.point = to_point(hit.point.vec());
        stop.height = 0;
        for (std::size_t k = 0; k < 3; ++k)
            stop.height += stop.normal[k] * ((stop.point[k] - values.high[k]) - values.low[k]);
        return true;
    }
    /// Strictly, so that it is for both sides' rule as well.
    [[nodiscard]] bool in_front(const Surface& surface, const Point& /*from*/, const Point& point) const {
        ++counters_.exact_sides;
        return side_of(surface.corners, point) * surface.side > 0;
    }
    [[nodiscard]] bool is_near(const Surface& surface, const Point& point, const Point& normal) const {
        return is_above(surface.corners, surface.side, point, normal, k_contact_grains * scene_.grain);
    }

  private:
    static void set_normal(const Values& values, Stop& stop) {
        for (std::size_t k = 0; k < 3; ++k) stop.normal[k] = stop.surface.side * values.normal[k] / values.length;
    }

    const Scene<Scalar>& scene_;
    const QueryOptions& options_;
    QueryCounters& counters_;
};

}  // namespace pierce::detail
