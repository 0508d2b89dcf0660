// The loop of a move: step until something is met, turn the velocity, aim along it, go on with the time that is left.
//
// Why it ends, and keeps its way: at one place each query either ends the move or meets a plane that was not met there
// before, since the target is certainly in front of those that were; where no target is certain, the next hit on a
// plane that was met already ends the move. And from place to place time goes on. (`max_casts` is for ways that cross
// many folds.) A particle that is in contact already does not go to the hit's point first: that would take it along the
// plane by roundings that all have the direction of the normal, and would move what rests.
#pragma once

#include <array>
#include <cmath>

#include <pierce/response.h>
#include <query/ways.h>
#include <response/aim.h>
#include <response/turns.h>

namespace pierce::detail {

template <class Scalar, class Cast>
class MoveLoop {
  public:
    /// `bounces`: all of `Response` counts; else its velocity only.
    MoveLoop(const Cast& cast, const MoveOptions<Scalar>& options, bool bounces,
             std::span<MoveContact<Scalar>> contacts)
        : cast_(cast), options_(options), turns_(options, bounces, contacts) {}

    [[nodiscard]] Move<Scalar> run(const Vec3<Scalar>& position, const Vec3<Scalar>& velocity, Scalar seconds) {
        move_ = begun(position, velocity);
        if (!are_finite(position, velocity) || !(seconds >= 0) || !std::isfinite(seconds)) return invalid();
        start_ = place_ = to_point(position);
        turns_.begin(velocity);
        left_ = static_cast<double>(seconds);
        while (!turns_.is_still() && !blocked_) {
            const Point way = turns_.way(left_);
            if (!are_finite(plus(place_, 1, way))) return invalid();
            if (feels(way)) continue;
            const Point target = aimed(way);
            if (!are_finite(target)) return invalid();
            typename Cast::Stop stop;
            if (blocked_ || target == place_) break;
            if (!cast(target, stop)) {
                if (!blocked_) place_ = target;
                break;
            }
            meet(stop);
        }
        return finished(position);
    }

  private:
    using Surface = typename Cast::Surface;
    [[nodiscard]] std::span<const Plane<Surface>> planes() const { return {planes_.data(), count_}; }

    [[nodiscard]] bool is_met(std::uint32_t triangle) const {
        return std::any_of(planes().begin(), planes().end(),
                           [triangle](const Plane<Surface>& plane) { return plane.triangle == triangle; });
    }

    [[nodiscard]] Point aimed(const Point& way) const {
        Point target{};
        aim<Scalar>(cast_, place_, way, planes(), target);
        return target;
    }
    // False: it meets nothing, or `blocked_`: its queries are used up.
    [[nodiscard]] bool cast(const Point& target, typename Cast::Stop& stop) {
        blocked_ = move_.casts >= options_.max_casts;
        if (blocked_) return false;
        ++move_.casts;
        return cast_.meet(place_, target, stop);
    }
    // A way that is shorter than the distance of contacts may end before what the particle rests on: it would be free
    // until it has fallen as far, and rest again. So what it is in contact with is looked for further on.
    [[nodiscard]] bool feels(const Point& way) {
        const double furthest = 2 * k_contact_grains * cast_.grain();
        const double length = length_of(way);
        if (!(length < furthest)) return false;
        // (A length that underflows is of no way at all, as a rule.)
        const Point target = length > 0 ? aimed(times(furthest / length, way)) : place_;
        typename Cast::Stop stop;
        if (!are_finite(target) || target == place_ || !cast(target, stop)) return false;
        if (!stop.in_contact || is_met(stop.triangle)) return false;
        meet(stop);
        return true;
    }

    void meet(const typename Cast::Stop& stop) {
        if (!stop.in_contact) go_to(stop);
        blocked_ = is_met(stop.triangle);
        if (blocked_ || !turns_.meet(contact_of(stop), stop.normal)) return;
        planes_[count_++] = {stop.normal, stop.height, stop.surface, stop.triangle};
    }

    void go_to(const typename Cast::Stop& stop) {
        left_ *= 1 - stop.fraction;
        const Point way = difference_of(stop.point, place_);
        if (way == Point{}) return;
        place_ = stop.point;
        turns_.arrive();
        // Planes that it left behind hold it no more.
        std::size_t kept = 0;
        turns_.keep([&](std::size_t i) {
            Plane<Surface> plane = planes_[i];
            plane.height += dot_product(plane.normal, way);
            if (!(plane.height <= k_contact_grains * cast_.grain()) ||
                !cast_.is_near(plane.surface, place_, plane.normal))
                return false;
            planes_[kept++] = plane;
            return true;
        });
        count_ = kept;
    }

    [[nodiscard]] MoveContact<Scalar> contact_of(const typename Cast::Stop& stop) const {
        MoveContact<Scalar> contact{};
        for (std::size_t k = 0; k < 3; ++k) {
            contact.point[k] = static_cast<Scalar>(place_[k]);
            contact.normal[k] = static_cast<Scalar>(stop.normal[k]);
        }
        contact.seconds = static_cast<Scalar>(left_);
        contact.face = stop.face;
        contact.triangle = stop.triangle;
        contact.side = stop.surface.side > 0 ? Sides::front : Sides::back;
        return contact;
    }

    [[nodiscard]] Move<Scalar> invalid() {
        move_.state = MoveState::invalid;
        return move_;
    }
    [[nodiscard]] Move<Scalar> finished(const Vec3<Scalar>& position) {
        finish(move_, position, place_, turns_);
        if (blocked_) set(move_.remainder, turns_.way(left_));
        if (move_.contacts > 0 && turns_.is_still())
            move_.state = turns_.held() >= 3 ? MoveState::wedged : MoveState::resting;
        else if (blocked_ && place_ == start_)
            move_.state = MoveState::wedged;
        else if (move_.contacts > 0)
            move_.state = MoveState::slid;
        return move_;
    }

    const Cast& cast_;
    const MoveOptions<Scalar>& options_;
    Turns<Scalar> turns_;
    Move<Scalar> move_;
    Point start_{};
    Point place_{};
    double left_ = 0;                                   ///< seconds
    std::array<Plane<Surface>, k_most_planes> planes_;  ///< of the place: those of `turns_`
    std::size_t count_ = 0;
    bool blocked_ = false;
};

}  // namespace pierce::detail
