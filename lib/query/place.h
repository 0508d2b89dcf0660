// The place of a hit: its true position, and the verified point.
//
// The verified point keeps to the start's side of the face, a grain off its plane, or as far off as the start was if
// that is less. On the plane itself, or nearer than what rounding does to any point of the mesh, a point would be
// behind it by the next rounding, or could not leave. So the first point to be tried is the true one P, moved off by a
// grain along the normal, its coordinates rounded outwards, so that no term of n . (point - P) lacks of the grain; then
// the same rounded to nearest, which half of the time is too near to the plane (as the first one to be tried it cost a
// tenth of an answer). Near edges and corners of other faces neither may be clear. Then the triangle that stops the way
// says
// where it may be: on the start's side of its plane or past one of its three edges, seen from the start. Each of these
// is a half-space; the nearest point of those chosen so far is tried, and what stops the way to that adds another
// choice. All choices are gone through in the order of their distances, but those that lead further than a grain and
// eight units: first with room for any rounding, then with none but all eight ways to round. (Two planes at less than
// 19.5 degrees leave no place in their corner: 4 / sin 19.5 = 12.) Where that second round tried something and failed,
// each place on a lattice of one unit is tried; and only then points back along the way from the start.
//
// Cost: a half-space takes 64 sweeps of at most 8, a few microseconds in the worst case; a try is a query among the
// triangles of the shortlist. There are 2 * `k_most_tries` + 8 tries at most, and the lattice has 7,152 places, some
// 1,900 of them a grain off the plane: all but a few are known to be hidden without being asked about (nearby.h). That
// happens a few times in 10^5 hits on bumpy meshes, and in the tips of thin spikes seen from inside. What this does not
// find are clear places that hold no point of that lattice and are missed by all eight roundings.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <exact/place.h>
#include <pierce/hit.h>
#include <query/grain.h>
#include <query/half_spaces.h>
#include <query/lattice_places.h>
#include <query/values.h>

namespace pierce::detail {

/// Looks for the verified point of a hit that does not start on its face.
template <class Scalar, class Ways>
class PlaceSearch {
  public:
    /// `spot`: null where nothing but exact arithmetic is certain; `position` is the true point rounded, `normal` the
    /// face's.
    PlaceSearch(const Path& path, const Corners& corners, Sides side, double grain, const Spot* spot,
                const Point& position, const Point& normal, QueryCounters& counters, const Ways& ways)
        : path_(path),
          corners_(corners),
          grain_(grain),
          unit_(grain / k_grain_units),
          per_unit_(1 / (unit_ * k_up)),
          spot_(spot),
          counters_(counters),
          ways_(ways) {
        const Point& n = spot != nullptr ? spot->normal : normal;
        length_ = spot != nullptr ? spot->length : std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        const double inverse = 1 / length_;
        reach_ = k_reach_units - (spot != nullptr ? 0.125 : 1);
        double off = grain;
        const double sign = side == Sides::front ? 1 : -1;
        if (spot != nullptr) {
            high_ = spot->high;
            low_ = spot->low;
            off = std::min(grain, spot->distance * inverse);
        } else {
            high_ = position;
            double distance = 0;
            for (std::size_t k = 0; k < 3; ++k) distance += n[k] / length_ * (path.from[k] - position[k]);
            off = std::min(grain, std::abs(distance));
        }
        off_length_ = off;
        for (std::size_t k = 0; k < 3; ++k) {
            out_[k] = sign * n[k];
            unit_normal_[k] = out_[k] * inverse;
            off_[k] = off * unit_normal_[k];
        }
    }

    /// Sets `fraction` and `point`; `exact` is the true fraction, rounded once. Returns how many points were not clear.
    int find(double exact, Hit<Scalar>& hit) {
        // Below the true fraction, which `exact` is within CertifiedFace::k_tolerance of, and one rounding; two steps
        // where it is denormal.
        const double below = std::max(0.0, exact * (1 - (sizeof(Scalar) == 4 ? 0x1p-28 : 0x1p-52)) - 0x1p-1073);
        if (find_near(hit)) {
            hit.fraction = same_as_start(hit) ? Scalar{0} : rounded_down<Scalar>(below);
            return tries_;
        }
        find_back(below, hit);
        return tries_;
    }

  private:
    bool find_near(Hit<Scalar>& hit) {
        if (try_near(off_, k_outwards, hit) == Tried::clear) return true;
        if (try_near(off_, k_to_nearest, hit) == Tried::clear) return true;
        return find_around(hit);
    }
    // Not inlined: what Nearby takes is on the stack only where it is needed.
    [[gnu::noinline]] bool find_around(Hit<Scalar>& hit) {
        const typename Ways::Nearby nearby(ways_);
        Around around{high_, low_, unit_, {}};
        for (std::size_t k = 0; k < 3; ++k)
            around.rounding[k] = last_place<Scalar>(std::abs(high_[k]) + k_reach_units * unit_) / unit_ / 2;
        HalfSpaces chosen;
        chosen.push({unit_normal_, off_length_ / unit_ + around.slack(unit_normal_)});
        if (find_clear(around, chosen, hit)) return true;
        if (tries_ == 0) return false;
        // Thin corners: room for no rounding, but all eight ways to round.
        thin_ = true;
        most_tries_ += k_most_tries;
        around.rounding = {};
        HalfSpaces again;
        again.push({unit_normal_, off_length_ / unit_});
        const int so_far = tries_;
        if (find_clear(around, again, hit)) return true;
        return tries_ != so_far && find_in_ball(hit);
    }

    // The last resort for corners whose half-spaces have a place that is too thin for any rounding tried: each point of
    // a lattice of one unit.
    bool find_in_ball(Hit<Scalar>& hit) {
        // P was rounded, so that places a unit nearer to the plane may be far enough.
        return each_on_lattice<Scalar, k_most_steps>(
            high_, low_, unit_, unit_normal_, off_length_ - unit_, reach_, [&](const Point& point) {
                return !ways_.hides(point) && is_finite_and_far(point) && ways_.clear(point, true) &&
                       take(point, true, hit) == Tried::clear;
            });
    }
    static constexpr int k_most_steps = static_cast<int>(k_reach_units);

    // Tries the nearest point of the half-spaces; if a triangle is in the way, goes on with each way out, the nearest
    // first.
    bool find_clear(const Around& around, HalfSpaces& chosen, Hit<Scalar>& hit) {
        Point x{};
        return tries_ < most_tries_ && chosen.nearest(reach_, x) && find_clear_from(around, chosen, x, hit);
    }
    // `x`: their nearest point.
    bool find_clear_from(const Around& around, HalfSpaces& chosen, const Point& x, Hit<Scalar>& hit) {
        Point by{};
        for (std::size_t k = 0; k < 3; ++k) by[k] = unit_ * x[k];
        if (!try_roundings(by, hit)) return found_;
        if (chosen.full()) return false;
        WaysOut ways(blocker_, blocked_, path_.from, around);
        std::array<double, 4> cost{};
        std::array<Point, 4> there{};
        for (std::size_t i = 0; i < ways.count; ++i) {
            HalfSpace& out = ways.all[i];
            // A point beyond it and yet stopped: by what the plane's own rounding is.
            out.least = std::max(out.least, dot_product(out.normal, x) + around.slack(out.normal) / 2 + 0x1p-4);
            chosen.push(out);
            cost[i] = chosen.nearest(reach_, there[i]) ? dot_product(there[i], there[i]) : HUGE_VAL;
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

    // Whether a triangle is in the way to all of them that are fit: `blocker_`, which stops the first. If not, `found_`
    // says whether a way is clear.
    bool try_roundings(const Point& by, Hit<Scalar>& hit) {
        found_ = false;
        bool stopped = false;
        Corners blocker{};
        Decision blocked;
        const unsigned step = thin_ ? 1 : k_outwards;
        for (unsigned rounding = k_to_nearest; rounding <= k_outwards && (thin_ || !stopped); rounding += step) {
            const Tried tried = try_near(by, rounding, hit);
            if (tried == Tried::clear) found_ = true;
            if (found_) return false;
            if (stopped || tried == Tried::unfit) continue;
            stopped = true;
            blocker = blocker_;
            blocked = blocked_;
        }
        blocker_ = blocker;
        blocked_ = blocked;
        return stopped;
    }

    enum class Tried : std::uint8_t { clear, stopped, unfit };
    /// Below 8: the coordinates whose bit is set are rounded to the further of their two neighbours.
    static constexpr unsigned k_to_nearest = 0;
    static constexpr unsigned k_outwards = 8;  ///< off the plane

    // The true point, moved by `by`, rounded. Where it is stopped, `blocker_` is what stops it.
    Tried try_near(const Point& by_, unsigned rounding, Hit<Scalar>& hit) {
        double square = 0;  // of the distance from the true point, in units
        Point by{};
        for (std::size_t k = 0; k < 3; ++k) by[k] = low_[k] + by_[k];
        Point point = rounded_to<Scalar>({high_[0] + by[0], high_[1] + by[1], high_[2] + by[2]});
        for (std::size_t k = 0; k < 3; ++k) {
            const double beyond = (point[k] - high_[k]) - by[k];
            const bool inwards = (beyond < 0 && out_[k] > 0) || (beyond > 0 && out_[k] < 0);
            const bool turned = rounding == k_outwards ? inwards : (rounding >> k & 1U) != 0 && beyond != 0;
            const double next = next_to<Scalar>(point[k], -beyond);  // no branch: which way it goes can't be predicted
            point[k] = turned ? next : point[k];
            const double x = ((point[k] - high_[k]) - low_[k]) * k_up * per_unit_;
            square += x * x;
        }
        if (!(square <= reach_ * reach_)) return Tried::unfit;  // or not finite
        return take(point, true, hit);
    }

    void find_back(double below, Hit<Scalar>& hit) {
        // Between the start and the first point tried, both of which are far enough from the plane.
        double way = 0;
        for (std::size_t k = 0; k < 3; ++k)
            way = std::max(way, std::abs(high_[k] / 2 + off_[k] / 2 - path_.from[k] / 2));
        double back = 4 * unit_ / way;
        if (!(back > 0)) back = 1;
        for (; back < 1; back *= 2) {
            const double share = 1 - back;
            Point point{};
            for (std::size_t k = 0; k < 3; ++k) point[k] = path_.from[k] * back + (high_[k] + off_[k]) * share;
            point = rounded_to<Scalar>(point);
            hit.fraction = rounded_down<Scalar>(below * share);
            if (point != path_.from && take(point, false, hit) == Tried::clear) return;
            for (std::size_t k = 0; k < 3; ++k)
                if (out_[k] != 0) point[k] = next_to<Scalar>(point[k], out_[k]);
            if (point != path_.from && take(point, false, hit) == Tried::clear) return;
        }
        hit.fraction = 0;
        for (int k = 0; k < 3; ++k) hit.point[k] = static_cast<Scalar>(path_.from[static_cast<std::size_t>(k)]);
    }

    Tried take(const Point& point, bool near, Hit<Scalar>& hit) {
        if (!is_finite_and_far(point)) return Tried::unfit;
        if (point != path_.from) {
            if (near ? ways_.stops(point, blocker_, blocked_) : !ways_.clear(point, false)) {
                ++tries_;
                return Tried::stopped;
            }
        }
        for (int k = 0; k < 3; ++k) hit.point[k] = static_cast<Scalar>(point[static_cast<std::size_t>(k)]);
        return Tried::clear;
    }

    bool is_finite_and_far(const Point& point) {
        for (const double x : point)
            if (!std::isfinite(x)) return false;
        return point == path_.from || is_far(point);
    }

    // On the start's side, and a grain off the plane or as far as the start. The first by n . (point - P), P being in
    // the plane, the second by n . (point - from): each term is off by what n and P may be off, and 2^-51 of itself for
    // its roundings and the sum's. (Where each term of the second has a factor that is exactly 0, so is it.) Only what
    // neither proves nor refutes is left to exact arithmetic.
    bool is_far(const Point& point) {
        if (spot_ != nullptr) {
            double from_plane = 0;
            double plane_error = k_underflow;
            double from_start = 0;
            double start_error = 0;
            double length_error = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const double n = std::abs(out_[k]);
                const double dn = spot_->normal_error[k] + 0x1p-51 * n;
                const double x = (point[k] - high_[k]) - low_[k];
                from_plane += out_[k] * x;
                plane_error += dn * std::abs(x) + (n + dn) * spot_->error[k];
                const double y = point[k] - path_.from[k];
                from_start += out_[k] * y;
                if (y != 0 && (n != 0 || spot_->normal_error[k] != 0)) start_error += dn * std::abs(y) + k_underflow;
                length_error += spot_->normal_error[k];
            }
            plane_error *= 1.01;
            start_error *= 1.01;
            const double wanted = k_far * grain_ * (length_ + length_error);
            if (from_plane - plane_error >= wanted || from_start >= start_error) return true;
            if (from_plane + plane_error < wanted && from_start < -start_error) return false;
        }
        ++counters_.exact_sides;
        return is_far_enough(corners_, path_.from, point, k_far * grain_);
    }

    bool same_as_start(const Hit<Scalar>& hit) const { return to_point(hit.point) == path_.from; }

    const Path& path_;
    const Corners& corners_;
    double grain_;
    double unit_;
    static constexpr double k_up = 0x1p60;  ///< or the inverse of a subnormal unit would be infinite
    double per_unit_;
    const Spot* spot_;
    QueryCounters& counters_;
    const Ways& ways_;
    /// Of a grain, so that a point that lies exactly a grain off is not refused by the roundings here (2^-47).
    static constexpr double k_far = 1 - 0x1p-40;
    /// More than products lose where they underflow, 2^-1075 each. A normal number: products with one that is not take
    /// 150 cycles.
    static constexpr double k_underflow = 0x1p-1000;
    static constexpr int k_most_tries = 48;
    int most_tries_ = k_most_tries;
    bool thin_ = false;
    bool found_ = false;
    /// Less what the true point may be off: a sixteenth of a unit a coordinate, or half a unit where it was only
    /// rounded.
    double reach_;
    double length_;
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

/// Sets `position`, `point` and `fraction` of a hit: the segment from -> point has no hit, none of the hit's own
/// triangle, from whose plane the point keeps off, and none of any other, which `ways` says:
///   bool stops(point, corners, decision)   whether a triangle stops the way to a point within `near_margin(grain)` of
///                                          the true one in each coordinate; if so, the corners of the first, and how
///                                          it is hit
///   bool clear(point, near)            whether none stops the way to a point, near as above or any
///   bool hides(point)                  whether one that stops the way to a near point is known already
///   Nearby                             is made from `ways`, and lives while many near points are asked about
/// `from` itself needs no proof. `exact`: the true fraction, rounded once. Returns how many points were not clear.
template <class Scalar, class Face, class Ways>
int place(const Path& path, const Corners& corners, const Decision& decision, double grain, double exact, Face& face,
          QueryCounters& counters, const Ways& ways, Hit<Scalar>& hit) {
    Point position = path.from;
    int tries = 0;
    if (decision.at_start) {
        hit.fraction = 0;
        for (int k = 0; k < 3; ++k) hit.point[k] = static_cast<Scalar>(path.from[static_cast<std::size_t>(k)]);
    } else {
        const Located located = face.locate(grain / k_grain_units, position);
        if (!located.rounded) {
            ++counters.exact_values;
            position = exact_position<Scalar>(path, corners);
        }
        PlaceSearch<Scalar, Ways> search(path, corners, decision.side, grain, located.spot, position, face.normal(),
                                         counters, ways);
        tries = search.find(exact, hit);
    }
    for (int k = 0; k < 3; ++k) hit.position[k] = static_cast<Scalar>(position[static_cast<std::size_t>(k)]);
    return tries;
}

}  // namespace pierce::detail
