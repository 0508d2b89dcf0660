// The place of a hit: its verified point, and the fraction of the segment up to there.
//
// The verified point keeps to the start's side of the face, a grain off its plane, or as far off as the start was if
// that is less. On the plane itself, or nearer than what rounding does to any point of the mesh, a point would be
// behind it by the next rounding, or could not leave. So the first point to be tried is the true one P, moved off by a
// grain along the normal, its coordinates rounded outwards, so that no term of n . (point - P) falls short of the
// grain; then the same rounded to nearest, which half of the time is too near to the plane (as the first one to be
// tried it cost a tenth of an answer). Near edges and corners of other faces neither may be clear. Then the triangle
// that stops the way says where it may be: on the start's side of its plane or past one of its three edges, seen from
// the start. Each of these is a half-space; the nearest point of those chosen so far is tried, and what stops the way
// to that adds another choice. All choices are gone through in the order of their distances, but those that lead
// further than a grain and eight units: first with room for any rounding, then with none but all eight ways to round.
// (Two planes at less than 19.5 degrees leave no place in their corner: 4 / sin 19.5 = 12.) Where that second round
// tried something and failed, each place on a lattice of one unit is tried; and only then points back along the way
// from the start.
//
// Cost: a half-space takes 64 sweeps of at most 8, and 92 corners where they don't do, some microseconds at worst; a
// try is a query among the triangles of the shortlist. There are 2 * `k_most_tries` + 8 tries at most, and the lattice
// has 7,152 places, some 1,900 of them a grain off the plane: all but a few are known to be hidden without being asked
// about (nearby.h). That happens a few times in 10^5 hits on bumpy meshes, and in the tips of thin spikes seen from
// inside. What this does not find are clear places that hold no point of that lattice and are missed by all eight
// roundings.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include <exact/place.h>
#include <pierce/hit.h>
#include <query/grain.h>
#include <query/half_spaces.h>
#include <query/lattice_places.h>
#include <query/parameter.h>
#include <query/values.h>

namespace pierce::detail {

template <class Scalar>
void stay_at_start(const Path& path, Hit<Scalar>& hit) {
    hit.fraction = 0;
    for (int k = 0; k < 3; ++k) hit.point[k] = static_cast<Scalar>(path.from[static_cast<std::size_t>(k)]);
}

/// Looks for the verified point of a hit that does not start on its face.
template <class Scalar, class Ways>
class PlaceSearch {
  public:
    /// `values`: as certify() left them. `corners`: of the face.
    PlaceSearch(const Path& path, const Corners& corners, const PlaceOf& of, const Values& values,
                QueryCounters& counters, const Ways& ways)
        : path_(path), corners_(corners), of_(of), values_(values), counters_(counters), ways_(ways) {
        // The true point was only rounded: half a unit a coordinate off.
        if (!values.located) of_.reach = k_reach_units - 1;
        const double inverse = 1 / values.length;
        off_length_ = std::min(of.grain, values.distance * inverse);
        for (std::size_t k = 0; k < 3; ++k) {
            high_[k] = values.high[k];
            low_[k] = values.low[k];
            out_[k] = of.side * values.normal[k];
            unit_normal_[k] = out_[k] * inverse;
            off_[k] = off_length_ * unit_normal_[k];
        }
    }

    /// Sets `fraction` and `point`; `below`: less than the true fraction, as the caller's parameter. Returns how many
    /// points were not clear.
    int find(double below, Hit<Scalar>& hit) {
        if (!find_near(hit))
            find_back(below, hit);
        else
            hit.fraction = to_point(hit.point.vec()) == path_.from ? Scalar{0} : rounded_down<Scalar>(below);
        return tries_;
    }

  private:
    bool find_near(Hit<Scalar>& hit) {
        if (try_near(off_, k_outwards, hit) == Found::clear) return true;
        if (try_near(off_, k_to_nearest, hit) == Found::clear) return true;
        return find_around(hit);
    }
    // Not inlined: what Nearby takes is on the stack only where it is needed.
    [[gnu::noinline]] bool find_around(Hit<Scalar>& hit) {
        typename Ways::Nearby nearby(ways_);
        Around around{high_, low_, of_.unit, {}};
        for (std::size_t k = 0; k < 3; ++k)
            around.rounding[k] = last_place<Scalar>(std::abs(high_[k]) + k_reach_units * of_.unit) / of_.unit / 2;
        HalfSpaces chosen;
        chosen.push({unit_normal_, off_length_ / of_.unit + around.slack(unit_normal_)});
        if (find_clear(around, chosen, hit)) return true;
        // As a rule that nothing was stopped says that no place is far enough. Not where P was rounded itself, or units
        // are subnormal and products with them too.
        if (tries_ == 0 && values_.located && of_.unit >= std::numeric_limits<double>::min()) return false;
        // Thin corners: room for no rounding, but all eight ways to round.
        thin_ = true;
        most_tries_ += k_most_tries;
        around.rounding = {};
        HalfSpaces again;
        again.push({unit_normal_, off_length_ / of_.unit});
        const int so_far = tries_;
        if (find_clear(around, again, hit)) return true;
        return tries_ != so_far && find_in_ball(hit);
    }

    // The last resort for corners whose half-spaces have a place that is too thin for any rounding tried: each point of
    // a lattice of one unit.
    bool find_in_ball(Hit<Scalar>& hit) {
        // P was rounded, so that places a unit nearer to the plane may be far enough.
        return each_on_lattice<Scalar, k_most_steps>(
            high_, low_, of_.unit, unit_normal_, off_length_ - of_.unit, of_.reach, [&](const Point& point) {
                return !ways_.hides(point) && is_finite_and_far(point) && ways_.clear(point, true) &&
                       take(point, true, hit) == Found::clear;
            });
    }
    static constexpr int k_most_steps = static_cast<int>(k_reach_units);

    // Tries the nearest point of the half-spaces; if a triangle is in the way, goes on with each way out, the nearest
    // first.
    bool find_clear(const Around& around, HalfSpaces& chosen, Hit<Scalar>& hit) {
        Point x{};
        return tries_ < most_tries_ && chosen.nearest(of_.reach, x) && find_clear_from(around, chosen, x, hit);
    }
    // `x`: their nearest point.
    bool find_clear_from(const Around& around, HalfSpaces& chosen, const Point& x, Hit<Scalar>& hit) {
        Point by{};
        for (std::size_t k = 0; k < 3; ++k) by[k] = of_.unit * x[k];
        if (!try_roundings(by, hit)) return found_;
        if (chosen.full()) return false;
        WaysOut ways(blocker_, blocked_, path_.from, around);
        std::array<double, 4> cost{};
        std::array<Point, 4> there{};
        for (std::size_t i = 0; i < ways.count; ++i) {
            HalfSpace& out = ways.all[i];
            // A point beyond it may be stopped all the same: by the plane's own rounding.
            out.least = std::max(out.least, dot_product(out.normal, x) + around.slack(out.normal) / 2 + 0x1p-4);
            chosen.push(out);
            cost[i] = chosen.nearest(of_.reach, there[i]) ? dot_product(there[i], there[i]) : HUGE_VAL;
            chosen.pop();
        }
        for (std::size_t n = 0; n < ways.count; ++n) {
            const auto* const nearest = std::min_element(cost.begin(), cost.begin() + ways.count);
            const auto least = static_cast<std::size_t>(nearest - cost.begin());
            if (cost[least] == HUGE_VAL) return false;
            cost[least] = HUGE_VAL;
            chosen.push(ways.all[least]);
            if (tries_ < most_tries_ && find_clear_from(around, chosen, there[least], hit)) return true;
            chosen.pop();
        }
        return false;
    }

    // Whether triangles are in the way to all of the roundings that are fit: `blocker_` is the one that stops the
    // first. If not, `found_` says whether a way is clear.
    bool try_roundings(const Point& by, Hit<Scalar>& hit) {
        found_ = false;
        bool stopped = false;
        Corners blocker{};
        Decision blocked;
        const unsigned step = thin_ ? 1 : k_outwards;
        for (unsigned rounding = k_to_nearest; rounding <= k_outwards && (thin_ || !stopped); rounding += step) {
            const Found tried = try_near(by, rounding, hit);
            if (tried == Found::clear) found_ = true;
            if (found_) return false;
            if (stopped || tried == Found::unfit) continue;
            stopped = true;
            blocker = blocker_;
            blocked = blocked_;
        }
        blocker_ = blocker;
        blocked_ = blocked;
        return stopped;
    }

    enum class Found : std::uint8_t { clear, stopped, unfit };

    // The true point, moved by `by`, rounded. Where it is stopped, `blocker_` is what stops it.
    Found try_near(const Point& by, unsigned rounding, Hit<Scalar>& hit) {
        TwoPairs place{};
        const Tried tried = try_place<Scalar>(values_, of_, TwoPairs::load_point(by.data()), rounding, place);
        if (tried == Tried::unfit) return Found::unfit;
        const Point point{place.low[0], place.low[1], place.high[0]};
        return tried == Tried::far || is_exactly_far(point) ? take(point, true, hit) : Found::unfit;
    }

    void find_back(double below, Hit<Scalar>& hit) {
        // Between the start and the first point tried. These are far enough from the plane; what is between them is
        // rounded, and may lie behind it.
        double way = 0;
        for (std::size_t k = 0; k < 3; ++k)
            way = std::max(way, std::abs(high_[k] / 2 + off_[k] / 2 - path_.from[k] / 2));
        double back = 4 * of_.unit / way;
        if (!(back > 0)) back = 1;
        for (; back < 1; back *= 2) {
            const double share = 1 - back;
            Point point{};
            for (std::size_t k = 0; k < 3; ++k) point[k] = path_.from[k] * back + (high_[k] + off_[k]) * share;
            point = rounded_to<Scalar>(point);
            hit.fraction = rounded_down<Scalar>(below * share);
            if (try_back(point, hit)) return;
            for (std::size_t k = 0; k < 3; ++k)
                if (out_[k] != 0) point[k] = next_to<Scalar>(point[k], out_[k]);
            if (try_back(point, hit)) return;
        }
        stay_at_start(path_, hit);
    }

    bool try_back(const Point& point, Hit<Scalar>& hit) {
        return point != path_.from && is_finite_and_far(point) && take(point, false, hit) == Found::clear;
    }

    // Of a point that is known to be far enough from the plane: `ways_` does not ask about the hit's own triangle.
    Found take(const Point& point, bool near, Hit<Scalar>& hit) {
        if (point != path_.from) {
            if (near ? ways_.stops(point, blocker_, blocked_) : !ways_.clear(point, false)) {
                ++tries_;
                return Found::stopped;
            }
        }
        for (int k = 0; k < 3; ++k) hit.point[k] = static_cast<Scalar>(point[static_cast<std::size_t>(k)]);
        return Found::clear;
    }

    bool is_finite_and_far(const Point& point) {
        for (const double x : point)
            if (!std::isfinite(x)) return false;
        const Tried tried = Farness<TwoPairs>(values_, of_, TwoPairs::load_point(point.data())).tried();
        return tried == Tried::far || (tried == Tried::unsure && is_exactly_far(point));
    }

    bool is_exactly_far(const Point& point) {
        if (point == path_.from) return true;
        ++counters_.exact_sides;
        return is_far_enough(corners_, path_.from, point, of_.grain);
    }

    const Path& path_;
    const Corners& corners_;
    PlaceOf of_;
    const Values& values_;
    QueryCounters& counters_;
    const Ways& ways_;
    static constexpr int k_most_tries = 48;
    int most_tries_ = k_most_tries;
    bool thin_ = false;
    bool found_ = false;
    double off_length_ = 0;
    Corners blocker_{};
    Decision blocked_{};  ///< the hit on it
    Point high_{};
    Point low_{};
    Point out_{};          ///< the normal, towards the start
    Point unit_normal_{};  ///< of length 1
    Point off_{};          ///< from the plane to where the point is looked for
    int tries_ = 0;
};

/// A bound below the true fraction, where `exact` is within k_tolerance and one rounding of it; two steps where it is
/// denormal.
template <class Scalar>
[[nodiscard]] inline double fraction_below(double exact) {
    return std::max(0.0, exact * (1 - (sizeof(Scalar) == 4 ? 0x1p-28 : 0x1p-52)) - 0x1p-1073);
}

/// The rest of place(), where the first place is not clear or not certain.
template <class Scalar, class Ways>
[[gnu::noinline]] int search_place(const Path& path, const Measured& measured, const PlaceOf& of, const Values& values,
                                   QueryCounters& counters, const Ways& ways, Hit<Scalar>& hit) {
    const Corners corners = corners_of(measured);
    PlaceSearch<Scalar, Ways> search(path, corners, of, values, counters, ways);
    return search.find(parameter_below(path, fraction_below<Scalar>(values.weights[3])), hit);
}

/// Sets `point` and `fraction` of a hit: the segment from -> point has no hit, none of the hit's own triangle, from
/// whose plane the point keeps off, and none of any other, which `ways` says:
///   bool stops(point, corners, decision)   whether a triangle stops the way to a point within `near_margin(grain)` of
///                                          the true one in each coordinate; if so, the corners of the first, and how
///                                          it is hit
///   bool clear(point, near)                whether none stops the way to a point, near as above or any
///   bool hides(point)                      whether one that stops the way to a near point is known already
///   Nearby                                 is made from `ways`, and lives while many near points are asked about
/// `from` itself needs no proof. `values`: as certify() left them. Returns how many points were not clear.
template <class Scalar, class Ways>
int place(const Path& path, const Measured& measured, const Decision& decision, double grain, const Values& values,
          const Rounded<Scalar>& rounded, QueryCounters& counters, const Ways& ways, Hit<Scalar>& hit) {
    if (decision.at_start) {
        stay_at_start(path, hit);
        return 0;
    }
    const Point point{values.point[0], values.point[1], values.point[2]};
    if (values.tried == Tried::far && point != path.from && ways.clear(point, true)) [[likely]] {
        hit.fraction = rounded_down<Scalar>(parameter_below(path, fraction_below<Scalar>(values.weights[3])));
        std::memcpy(&hit.point, rounded.point, sizeof hit.point);
        return 0;
    }
    return search_place(path, measured, place_of(measured, grain, decision.side), values, counters, ways, hit);
}

}  // namespace pierce::detail
