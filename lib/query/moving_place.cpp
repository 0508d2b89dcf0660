// A place at the end of a step from which a particle goes on.
//
// Tried first is where the contact's place on the mesh goes, a grain off the face. What is in the way of that, found by
// a sweep to it, is kept off as well, by its plane at the end of the step, until nothing is: as in a corner, where two
// or three faces meet. A way along a face that turns leaves the face's plane in between, by the square of the turn;
// so the next one to be tried is where the start itself would be carried by the face, which has no way along it. Each
// place that is tried is asked about as the caller would, so only what is clear is returned.
#include <query/moving_sweep.h>

#include <algorithm>
#include <cmath>

#include <query/grain.h>

namespace pierce::detail {

namespace {

double dot(const Point& x, const Point& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
Point moved(const Point& x, const Point& way, double by) {
    return {x[0] + by * way[0], x[1] + by * way[1], x[2] + by * way[2]};
}
bool is_zero(const Point& x) { return x == Point{}; }

/// A plane that a place has to be in front of.
struct Guard {
    Point at;
    Point normal;
};

class Guards {
  public:
    static constexpr std::size_t k_most = 12;

    /// The face's plane at the end of the step, on the side that the point comes from. False: it has none, or there
    /// are too many.
    bool add(const MovingPoint& point, const MovingCandidate& candidate) {
        if (count_ == k_most) return false;
        Point normal = values_at(point, candidate, 1).normal;
        if (is_zero(normal)) return false;
        if (candidate.impact.side == Sides::back)
            for (double& x : normal) x = -x;
        guards_[count_++] = {candidate.triangle.at[1][0], normal};
        return true;
    }
    /// The place brought `distance` in front of all planes, or of as many as a few rounds reach.
    [[nodiscard]] Point in_front(Point place, double distance) const {
        for (int round = 0; round < 16; ++round) {
            bool moved_any = false;
            for (std::size_t g = 0; g < count_; ++g) {
                const Guard& guard = guards_[g];
                Point s;
                for (std::size_t k = 0; k < 3; ++k) s[k] = place[k] - guard.at[k];
                const double short_of = distance - dot(s, guard.normal);
                if (!(short_of > distance * 0x1p-6)) continue;
                place = moved(place, guard.normal, short_of);
                moved_any = true;
            }
            if (!moved_any) break;
        }
        return place;
    }

  private:
    std::array<Guard, k_most> guards_;
    std::size_t count_ = 0;
};

}  // namespace

template <class Scalar>
bool find_place(const MovingScene<Scalar>& scene, const MovingPoint& point, const MovingCandidate& first,
                const MovingValues& values, const QueryOptions& options, QueryCounters& counters, Point& place) {
    QueryOptions whole = options;
    whole.max_fraction = std::numeric_limits<double>::infinity();
    MovingCandidate in_the_way;
    const auto clear = [&](const Point& to, bool any) {
        place = rounded_to<Scalar>(to);
        for (const double x : place)
            if (!std::isfinite(x)) return false;
        return !first_contact(scene, to_moving(point.at[0], place), whole, any, counters, in_the_way);
    };
    Point ahead{};  // where the contact's place on the mesh goes
    for (std::size_t c = 0; c < 3; ++c) ahead = moved(ahead, first.triangle.at[1][c], values.weights[c]);

    const Point along = carried(point, first, values);
    for (const Point& base : {ahead, along}) {
        Guards guards;
        bool guarded = guards.add(point, first);
        double distance = scene.grain;
        for (std::size_t round = 0; round < Guards::k_most && guarded; ++round) {
            in_the_way = {};
            if (clear(guards.in_front(base, distance), false)) return true;
            ++counters.retreats;
            if (in_the_way.number == first.number) distance *= 16;
            guarded = guards.add(point, in_the_way);
        }
    }
    // In all directions, further each time.
    double distance = scene.grain;
    for (int round = 0; round < 14; ++round, distance *= 8)
        for (int direction = 0; direction < 27; ++direction) {
            const Point way{static_cast<double>(direction % 3 - 1), static_cast<double>(direction / 3 % 3 - 1),
                            static_cast<double>(direction / 9 - 1)};
            if (clear(moved(along, way, distance), true)) return true;
            ++counters.retreats;
        }
    // On the mesh itself, for a start that lies on a vertex and goes with it.
    if (clear(ahead, true)) return true;
    return clear(along, true);
}

template bool find_place(const MovingScene<float>&, const MovingPoint&, const MovingCandidate&, const MovingValues&,
                         const QueryOptions&, QueryCounters&, Point&);
template bool find_place(const MovingScene<double>&, const MovingPoint&, const MovingCandidate&, const MovingValues&,
                         const QueryOptions&, QueryCounters&, Point&);

}  // namespace pierce::detail
