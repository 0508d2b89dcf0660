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

namespace pierce::detail {

template <class Scalar, class Cast>
class MoveLoop {
  public:
    /// `bounces`: all of `Response` counts; else its velocity only.
    MoveLoop(const Cast& cast, const MoveOptions<Scalar>& options, bool bounces,
             std::span<MoveContact<Scalar>> contacts)
        : cast_(cast), options_(options), bounces_(bounces), contacts_(contacts) {}

    [[nodiscard]] Move<Scalar> run(const Vec3<Scalar>& position, const Vec3<Scalar>& velocity, Scalar seconds) {
        move_.position = position;
        move_.velocity = velocity;
        move_.travel.setZero();
        move_.remainder.setZero();
        if (!are_finite(position, velocity) || !(seconds >= 0) || !std::isfinite(seconds)) return invalid();
        start_ = place_ = to_point(position);
        // Velocities by a power of two, so that squares stay in range.
        const double most = static_cast<double>(velocity.cwiseAbs().maxCoeff());
        scale_ = most > 0 ? std::ldexp(1.0, std::clamp(std::ilogb(most), -1000, 1000)) : 1;
        velocity_ = arrived_ = began_ = times(1 / scale_, to_point(velocity));
        left_ = static_cast<double>(seconds);
        total_ = left_;
        while (!(velocity_ == Point{}) && !blocked_) {
            const Point way = times(left_ * scale_, velocity_);
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
        return cast_.meet(place_, target, 1 - left_ / total_, stop);
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
        if (blocked_) return;
        MoveContact<Scalar> contact = contact_of(stop);
        contact.speed = static_cast<Scalar>(-dot_product(velocity_, stop.normal) * scale_);
        const Response<Scalar> response = options_.response_at ? options_.response_at(contact) : options_.response;
        Wall wall{stop.normal, times(1 / scale_, to_point(response.velocity))};
        if (bounces_) wall.friction = std::max(static_cast<double>(response.friction), 0.0);
        const double speed = wall.least() - dot_product(velocity_, stop.normal);
        contact.speed = static_cast<Scalar>(speed * scale_);
        if (move_.contacts < contacts_.size()) contacts_[move_.contacts] = contact;
        ++move_.contacts;
        if (count_ == k_most_planes) {
            velocity_ = {};
            held_ = 3;
            return;
        }
        planes_[count_] = {stop.normal, stop.height, stop.surface, stop.triangle};
        walls_[count_++] = wall;
        const bool bounces =
            bounces_ && response.restitution > 0 && speed * scale_ > static_cast<double>(response.rest_speed);
        if (bounces) arrived_ = bounced(velocity_, wall, static_cast<double>(response.restitution));
        velocity_ = resolved({walls_.data(), count_}, arrived_, k_alike<Scalar>, held_);
        turned_on_ = turned_on_ || bounces || !(wall.velocity == Point{});
        if (met_count_ < met_.size()) met_[met_count_++] = wall;
        if (!turned_on_ && dot_product(velocity_, began_) <= 0 && !(velocity_ == Point{})) stop_if_caught();
    }

    // It was turned round, by planes that it met one after the other. If all of them together stop what it began with,
    // they do so here: in the corner of planes at wide angles it would go from side to side for ever, a step each way.
    // (Quake, 1996, stops all that is turned round.)
    void stop_if_caught() {
        const Resolver::Held all = Resolver({met_.data(), met_count_}, began_, k_alike<Scalar>).nearest();
        if (!(all.velocity == Point{})) return;
        velocity_ = {};
        held_ = std::max(held_, all.count);
    }

    void go_to(const typename Cast::Stop& stop) {
        left_ *= 1 - stop.fraction;
        const Point way = difference_of(stop.point, place_);
        if (way == Point{}) return;
        place_ = stop.point;
        arrived_ = velocity_;
        // Planes that it left behind hold it no more.
        std::size_t kept = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            Plane<Surface> plane = planes_[i];
            plane.height += dot_product(plane.normal, way);
            if (!(plane.height <= k_contact_grains * cast_.grain()) ||
                !cast_.is_near(plane.surface, place_, plane.normal))
                continue;
            planes_[kept] = plane;
            walls_[kept++] = walls_[i];
        }
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
        move_.contacts = 0;
        return move_;
    }
    [[nodiscard]] Move<Scalar> finished(const Vec3<Scalar>& position) {
        for (int k = 0; k < 3; ++k) {
            const auto i = static_cast<std::size_t>(k);
            move_.position[k] = static_cast<Scalar>(place_[i]);
            move_.velocity[k] = move_.contacts > 0 ? static_cast<Scalar>(scale_ * velocity_[i]) : move_.velocity[k];
            move_.travel[k] = move_.position[k] - position[k];
            if (blocked_) move_.remainder[k] = static_cast<Scalar>(left_ * scale_ * velocity_[i]);
        }
        if (move_.contacts == 0) return move_;
        move_.state = MoveState::slid;
        if (velocity_ == Point{})
            move_.state = held_ >= 3 ? MoveState::wedged : MoveState::resting;
        else if (blocked_ && place_ == start_)
            move_.state = MoveState::wedged;
        return move_;
    }

    const Cast& cast_;
    const MoveOptions<Scalar>& options_;
    bool bounces_;
    std::span<MoveContact<Scalar>> contacts_;
    Move<Scalar> move_;
    Point start_{};
    Point place_{};
    double scale_ = 1;  ///< of velocities: those below times this are the caller's
    Point velocity_{};
    Point arrived_{};         ///< the velocity with which it came to the place, or bounced there
    Point began_{};           ///< the velocity in the beginning
    bool turned_on_ = false;  ///< by what may turn it round: a bounce, or a surface that moves
    double left_ = 0;         ///< seconds
    double total_ = 0;        ///< of the move
    std::array<Plane<Surface>, k_most_planes> planes_;  ///< of the place
    std::array<Wall, k_most_planes> walls_;             ///< the same
    std::size_t count_ = 0;
    std::array<Wall, k_most_planes> met_;  ///< in this move, at any place: the first ones
    std::size_t met_count_ = 0;
    int held_ = 0;  ///< by how many of them
    bool blocked_ = false;
};

}  // namespace pierce::detail
