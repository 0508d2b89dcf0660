// A place at the end of a step of a mesh that deforms (end_place.h).
#include <query/moving_sweep.h>

#include <cmath>

#include <query/end_place.h>
#include <query/grain.h>

namespace pierce::detail {

namespace {

/// The face's plane at the end of the step, on the side that the point comes from.
Guard guard_of(const MovingPoint& point, const MovingCandidate& candidate) {
    Guard guard{candidate.triangle.at[1][0], values_at(point, candidate, 1).normal, candidate.number};
    if (candidate.impact.side == Sides::back)
        for (double& x : guard.normal) x = -x;
    return guard;
}

}  // namespace

template <class Scalar>
bool find_place(const MovingScene<Scalar>& scene, const MovingPoint& point, const MovingCandidate& first,
                const MovingValues& values, const QueryOptions& options, QueryCounters& counters, Point& place) {
    QueryOptions whole = options;
    whole.max_fraction = std::numeric_limits<double>::infinity();
    const auto ask = [&](const Point& to, Guard* stop) {
        place = rounded_to<Scalar>(to);
        for (const double x : place)
            if (!std::isfinite(x)) return false;
        MovingCandidate in_the_way;
        if (!first_contact(scene, to_moving(point.at[0], place), whole, stop == nullptr, counters, in_the_way))
            return true;
        if (stop != nullptr) *stop = guard_of(point, in_the_way);
        return false;
    };
    Point ahead{};  // where the contact's place on the mesh goes
    for (std::size_t c = 0; c < 3; ++c) ahead = moved_by(ahead, first.triangle.at[1][c], values.weights[c]);
    const Point along = carried(point, first, values);
    return find_end_place(ahead, along, guard_of(point, first), scene.grain, counters, ask);
}

template bool find_place(const MovingScene<float>&, const MovingPoint&, const MovingCandidate&, const MovingValues&,
                         const QueryOptions&, QueryCounters&, Point&);
template bool find_place(const MovingScene<double>&, const MovingPoint&, const MovingCandidate&, const MovingValues&,
                         const QueryOptions&, QueryCounters&, Point&);

}  // namespace pierce::detail
