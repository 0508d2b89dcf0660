// The loop of a move over one step of a mesh that moves: what the particle meets, what that makes of its velocity, and
// one straight way from where it is to where that leads, over the whole step, that meets nothing.
//
// A sweep of a step covers all of its time: where a vertex is at a time in between is no representable point, so what
// goes on from a contact can't be asked about by itself. So its way is followed without proof, from contact to contact:
// place and velocity at each, in double, up to the end of the step. What is proved is the short cut from the start to
// that end, as the rest of the step would see it: by a sweep. Whatever the short cut meets is another contact, or a
// reason to go further off a plane; where the bent way does not meet it, or nothing helps, the particle stays with
// what it met first, at the verified place of that. So the end of a move is always that of a way that has no contact,
// and a chain of them does not leak; what lies inside of the bend is not met.
//
// Contacts on a plane that comes, goes and turns: heights are those above it at the time, targets are in front of where
// it is in the end.
#pragma once

#include <array>
#include <cmath>

#include <query/grain.h>
#include <query/moving_sweep.h>
#include <query/ways.h>
#include <response/aim.h>
#include <response/mesh_cast.h>
#include <response/turns.h>

namespace pierce::detail {

/// What targets are asked about: planes as they are at the end of the step.
struct StepsEnd {
    struct Surface {
        Corners corners;
        int side = 1;
    };
    double last_grain;

    [[nodiscard]] double grain() const { return last_grain; }
    [[nodiscard]] static bool in_front(const Surface& surface, const Point& /*from*/, const Point& point) {
        return side_of(surface.corners, point) * surface.side > 0;
    }
};

template <class Scalar>
class MovingLoop {
  public:
    /// `bounces`: all of `Response` counts; else its velocity only.
    MovingLoop(const MovingScene<Scalar>& scene, const MoveOptions<Scalar>& options, bool bounces,
               std::span<MoveContact<Scalar>> contacts, QueryCounters& counters)
        : scene_(scene),
          options_(options),
          query_(options.query),
          turns_(options, bounces, contacts),
          counters_(counters) {
        query_.max_fraction = std::numeric_limits<double>::infinity();
    }

    [[nodiscard]] Move<Scalar> run(const Vec3<Scalar>& position, const Vec3<Scalar>& velocity, Scalar seconds) {
        move_ = begun(position, velocity);
        if (!are_finite(position, velocity) || !(seconds > 0) || !std::isfinite(seconds)) return invalid();
        start_ = place_ = to_point(position);
        seconds_ = static_cast<double>(seconds);
        turns_.begin(velocity);
        MovingCandidate met;
        feel(met);
        Point target = aimed();
        if (!are_finite(target)) return invalid();
        if (!is_met(target, met)) return finished(position, target);
        const MovingPoint first_way = to_moving(start_, target);
        const MovingCandidate first = met;
        do {
            const bool follows = meet(target, met);
            if (!are_finite(rounded_to<Scalar>(turns_.velocity()))) return invalid();  // so short a step
            if (follows) target = aimed();
            if (!follows || !are_finite(target) || move_.casts >= options_.max_casts)
                return stays(position, first_way, first);
        } while (is_met(target, met));
        return finished(position, target);
    }

  private:
    /// A plane that holds it.
    struct Held {
        MovingCandidate met;
        int side;       ///< that the particle is on
        Point motion;   ///< of the mesh where it is held, over the whole step
        Point last;     ///< the normal in the end, towards the particle; 0 if there is none
        double grains;  ///< how far off it is to be in the end
    };

    /// Whether the straight way over the whole step meets something.
    [[nodiscard]] bool is_met(const Point& target, MovingCandidate& met) {
        ++move_.casts;
        ++counters_.queries;
        met = {};
        return first_contact(scene_, to_moving(start_, target), query_, false, counters_, met);
    }

    /// As MoveLoop::feels(): what it is in contact with is looked for beyond a way that is shorter than that.
    void feel(MovingCandidate& met) {
        const Point way = turns_.way(seconds_);
        const double furthest = 2 * k_contact_grains * scene_.grain;
        const double length = length_of(way);
        if (!(length > 0 && length < furthest)) return;
        const Point target = rounded_to<Scalar>(plus(start_, furthest / length, way));
        if (!are_finite(target) || target == start_ || !is_met(target, met)) return;
        const Held held{met, met.impact.side == Sides::back ? -1 : 1, {}, {}, 1};
        const double height = height_at(held, values_near(held, place_, 0).normal, place_, 0);
        if (std::abs(height) <= k_contact_grains * scene_.grain) (void)meet(target, met);
    }

    /// At a time of the step: the normal and the mesh's motion next to a place; heights above the plane.
    [[nodiscard]] static MovingValues values_near(const Held& held, const Point& place, double time) {
        MovingCandidate face = held.met;
        face.impact.feature = Feature::face;
        MovingValues values = values_at(to_moving(place, place), face, time);
        values.normal = times(held.side, values.normal);
        return values;
    }
    [[nodiscard]] static double height_at(const Held& held, const Point& normal, const Point& place, double time) {
        const Point& before = held.met.triangle.at[0][0];
        const Point& after = held.met.triangle.at[1][0];
        return dot_product(normal, difference_of(place, plus(times(1 - time, before), time, after)));
    }

    /// Follows the bent way to what the short cut to `target` has met, and turns there. False: it can't be followed.
    [[nodiscard]] bool meet(const Point& target, const MovingCandidate& met) {
        for (std::size_t i = 0; i < count_; ++i)
            if (held_[i].met.number == met.number) return (held_[i].grains *= 16) <= k_most_grains;
        Held held{met, met.impact.side == Sides::back ? -1 : 1, {}, {}, 1};
        Point normal = values_near(held, place_, time_).normal;
        double height = height_at(held, normal, place_, time_);
        const double contact = k_contact_grains * scene_.grain;
        if (normal == Point{} || !(height >= -contact)) return false;
        if (height > contact) {
            double time = 0;
            if (turns_.contacts() == 0) {
                time = values_of(to_moving(start_, target), options_.query.sides, met).time;
            } else {
                const double last = height_at(held, values_near(held, target, 1).normal, target, 1);
                if (!(last < 0)) return false;
                time = time_ + (1 - time_) * height / (height - last);
            }
            go_to(target, time);
            normal = values_near(held, place_, time_).normal;
            height = height_at(held, normal, place_, time_);
            // It is where the two meet, but for rounding.
            place_ = plus(place_, scene_.grain - height, normal);
        }
        const MovingValues values = values_near(held, place_, time_);
        if (values.normal == Point{}) return false;
        held.motion = values.motion;
        held.last = values_near(held, target, 1).normal;
        if (!turns_.meet(contact_of(held, values.normal), values.normal, times(1 / seconds_, held.motion)))
            return false;
        held_[count_++] = held;
        return true;
    }

    void go_to(const Point& target, double time) {
        const double part = std::clamp((time - time_) / (1 - time_), 0.0, 1.0);
        place_ = plus(place_, part, difference_of(target, place_));
        time_ = std::clamp(time, time_, 1.0);
        turns_.arrive();
        const double contact = k_contact_grains * scene_.grain;
        std::size_t kept = 0;
        turns_.keep([&](std::size_t i) {
            const Held held = held_[i];
            const Point normal = values_near(held, place_, time_).normal;
            Corners corners;
            for (std::size_t c = 0; c < 3; ++c)
                corners[c] = plus(times(1 - time_, held.met.triangle.at[0][c]), time_, held.met.triangle.at[1][c]);
            if (!(height_at(held, normal, place_, time_) <= contact) ||
                !is_above(corners, held.side, place_, normal, contact))
                return false;
            held_[kept++] = held;
            return true;
        });
        count_ = kept;
    }

    /// Where it comes to in the rest of the step, in front of all that holds it.
    [[nodiscard]] Point aimed() const {
        const double rest = 1 - time_;
        Point end = plus(place_, 1, turns_.way(rest * seconds_));
        std::array<Plane<StepsEnd::Surface>, k_most_planes> planes;
        std::array<double, HalfSpaces::k_most> least{};
        std::size_t count = 0;
        const double unit = scene_.grain / k_grain_units;
        double furthest = 64;
        for (std::size_t i = 0; i < count_; ++i) {
            const Held& held = held_[i];
            if (held.last == Point{}) continue;
            const Point off = plus(turns_.way(rest * seconds_), -rest, held.motion);
            const double height = height_at(held, held.last, end, 1);
            // What goes with the plane stays as near to it as that: as in aim().
            if (height > 2 * scene_.grain && height <= 2 * k_contact_grains * scene_.grain &&
                dot_product(held.last, off) < scene_.grain)
                end = plus(end, scene_.grain - height, held.last);
            planes[count++] = {held.last, 0, {held.met.triangle.at[1], held.side}, held.met.number};
            furthest = std::max(furthest, 4 * held.grains * k_grain_units);
        }
        Point target = rounded_to<Scalar>(end);
        if (count == 0) return target;
        for (std::size_t i = 0, k = 0; i < count_; ++i) {
            const Held& held = held_[i];
            if (held.last == Point{}) continue;
            const double height = height_at(held, held.last, end, 1) / unit;
            const double wanted = held.grains * k_grain_units;
            least[k++] = (height < wanted / 2 ? wanted : wanted / 2) - height;
            furthest = std::max(furthest, 2 * std::abs(least[k - 1]));
        }
        (void)lift_over<Scalar>(StepsEnd{scene_.grain}, place_, end, {planes.data(), count}, least, furthest, target);
        return target;
    }

    [[nodiscard]] MoveContact<Scalar> contact_of(const Held& held, const Point& normal) const {
        MoveContact<Scalar> contact{};
        for (std::size_t k = 0; k < 3; ++k) {
            contact.point[k] = static_cast<Scalar>(place_[k]);
            contact.normal[k] = static_cast<Scalar>(normal[k]);
        }
        contact.seconds = static_cast<Scalar>((1 - time_) * seconds_);
        contact.face = held.met.face;
        contact.triangle = held.met.number;
        contact.side = held.met.impact.side;
        return contact;
    }

    /// The end of the step with what it met first: as verified as that is.
    [[nodiscard]] Move<Scalar> stays(const Vec3<Scalar>& position, const MovingPoint& way,
                                     const MovingCandidate& first) {
        Point place = start_;
        const MovingValues values = values_of(way, options_.query.sides, first);
        const bool is_verified = find_place(scene_, way, first, values, query_, counters_, place);
        if (!are_finite(place)) place = start_;
        Move<Scalar> move = finished(position, place);
        set(move.remainder, turns_.way((1 - values.time) * seconds_));
        if (!is_verified) move.state = MoveState::crushed;
        return move;
    }
    [[nodiscard]] Move<Scalar> invalid() {
        move_.state = MoveState::invalid;
        return move_;
    }
    [[nodiscard]] Move<Scalar> finished(const Vec3<Scalar>& position, const Point& place) {
        finish(move_, position, place, turns_);
        if (move_.contacts == 0) return move_;
        move_.state = MoveState::slid;
        const auto goes_with = [&](const Held& held) { return turns_.goes_with(times(1 / seconds_, held.motion)); };
        if (turns_.held() >= 3)
            move_.state = MoveState::wedged;
        else if (std::any_of(held_.begin(), held_.begin() + static_cast<std::ptrdiff_t>(count_), goes_with))
            move_.state = MoveState::resting;
        return move_;
    }

    static constexpr double k_most_grains = 4096;

    const MovingScene<Scalar>& scene_;
    const MoveOptions<Scalar>& options_;
    QueryOptions query_;
    Turns<Scalar> turns_;
    QueryCounters& counters_;
    Move<Scalar> move_;
    Point start_{};
    Point place_{};    ///< on the bent way, at `time_`
    double time_ = 0;  ///< part of the step
    double seconds_ = 0;
    std::array<Held, k_most_planes> held_;  ///< the planes of `turns_`
    std::size_t count_ = 0;
};

}  // namespace pierce::detail
