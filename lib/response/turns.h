// What becomes of a particle's velocity in one move, contact by contact: the planes that hold it where it is, and what
// is said of each contact. Where it goes is the loops' business.
#pragma once

#include <array>
#include <cmath>

#include <pierce/response.h>
#include <response/velocity.h>

namespace pierce::detail {

template <class Scalar>
class Turns {
  public:
    /// `bounces`: all of `Response` counts; else its velocity only.
    Turns(const MoveOptions<Scalar>& options, bool bounces, std::span<MoveContact<Scalar>> contacts)
        : options_(options), bounces_(bounces), contacts_(contacts) {}

    /// Finite.
    void begin(const Vec3<Scalar>& velocity) {
        // By a power of two, so that squares stay in range.
        const double most = static_cast<double>(velocity.cwiseAbs().maxCoeff());
        scale_ = most > 0 ? std::ldexp(1.0, std::clamp(std::ilogb(most), -1000, 1000)) : 1;
        velocity_ = arrived_ = began_ = times(1 / scale_, to_point(velocity));
    }

    [[nodiscard]] bool is_still() const { return velocity_ == Point{}; }
    /// What the velocity leads to in so many seconds.
    [[nodiscard]] Point way(double seconds) const { return times(seconds * scale_, velocity_); }
    [[nodiscard]] Point velocity() const { return times(scale_, velocity_); }
    [[nodiscard]] std::size_t contacts() const { return total_; }
    [[nodiscard]] bool goes_with(const Point& surface) const { return velocity_ == times(1 / scale_, surface); }
    /// By how many planes it is held.
    [[nodiscard]] int held() const { return held_; }

    /// It has come to another place: as fast as it is now.
    void arrive() { arrived_ = velocity_; }
    /// The planes for which `keeps(i)`, in their order; the others hold it no more.
    template <class Keeps>
    void keep(Keeps&& keeps) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < count_; ++i)
            if (keeps(i)) walls_[kept++] = walls_[i];
        count_ = kept;
    }

    /// It meets another plane, which moves at `surface` for the mesh's part. `contact` has all but the speed. False:
    /// there are too many; it stops.
    [[nodiscard]] bool meet(MoveContact<Scalar> contact, const Point& normal, const Point& surface = {}) {
        make_room_for(surface);
        const Wall at_rest{normal, times(1 / scale_, surface), 0};
        contact.speed = static_cast<Scalar>((at_rest.least() - dot_product(velocity_, normal)) * scale_);
        const Response<Scalar> response = options_.response_at ? options_.response_at(contact) : options_.response;
        make_room_for(to_point(response.velocity));
        Wall wall{normal, times(1 / scale_, plus(surface, 1, to_point(response.velocity)))};
        if (bounces_) wall.friction = std::max(static_cast<double>(response.friction), 0.0);
        const double speed = wall.least() - dot_product(velocity_, normal);
        contact.speed = static_cast<Scalar>(speed * scale_);
        if (total_ < contacts_.size()) contacts_[total_] = contact;
        ++total_;
        if (count_ == k_most_planes) {
            velocity_ = {};
            held_ = 3;
            return false;
        }
        walls_[count_++] = wall;
        const bool bounces =
            bounces_ && response.restitution > 0 && speed * scale_ > static_cast<double>(response.rest_speed);
        if (bounces) arrived_ = bounced(velocity_, wall, static_cast<double>(response.restitution));
        velocity_ = resolved({walls_.data(), count_}, arrived_, k_alike<Scalar>, held_);
        turned_on_ = turned_on_ || bounces || !(wall.velocity == Point{});
        if (met_count_ < met_.size()) met_[met_count_++] = wall;
        if (!turned_on_ && dot_product(velocity_, began_) <= 0 && !is_still()) stop_if_caught();
        return true;
    }

  private:
    // A surface that is faster by far, whose square would be out of range.
    void make_room_for(const Point& surface) {
        const double most = std::max({std::abs(surface[0]), std::abs(surface[1]), std::abs(surface[2])});
        if (!(most > scale_ * 0x1p100) || !std::isfinite(most)) return;
        const double scale = std::ldexp(1.0, std::min(std::ilogb(most), 1000));
        const double by = scale_ / scale;
        for (Point* velocity : {&velocity_, &arrived_, &began_}) *velocity = times(by, *velocity);
        for (std::size_t i = 0; i < count_; ++i) walls_[i].velocity = times(by, walls_[i].velocity);
        for (std::size_t i = 0; i < met_count_; ++i) met_[i].velocity = times(by, met_[i].velocity);
        scale_ = scale;
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

    const MoveOptions<Scalar>& options_;
    bool bounces_;
    std::span<MoveContact<Scalar>> contacts_;
    std::size_t total_ = 0;
    double scale_ = 1;  ///< of velocities: those below times this are the caller's
    Point velocity_{};
    Point arrived_{};                        ///< the velocity with which it came to the place, or bounced there
    Point began_{};                          ///< the velocity in the beginning
    bool turned_on_ = false;                 ///< by what may turn it round: a bounce, or a surface that moves
    std::array<Wall, k_most_planes> walls_;  ///< of the place
    std::size_t count_ = 0;
    std::array<Wall, k_most_planes> met_;  ///< in this move, at any place: the first ones
    std::size_t met_count_ = 0;
    int held_ = 0;
};

template <class Scalar>
void set(Vec3<Scalar>& vector, const Point& p) {
    for (int k = 0; k < 3; ++k) vector[k] = static_cast<Scalar>(p[static_cast<std::size_t>(k)]);
}

/// Of a particle that has not moved.
template <class Scalar>
[[nodiscard]] Move<Scalar> begun(const Vec3<Scalar>& position, const Vec3<Scalar>& velocity) {
    Move<Scalar> move;
    move.position = position;
    move.velocity = velocity;
    move.travel.setZero();
    move.remainder.setZero();
    return move;
}

template <class Scalar>
void finish(Move<Scalar>& move, const Vec3<Scalar>& position, const Point& place, const Turns<Scalar>& turns) {
    set(move.position, place);
    move.contacts = turns.contacts();
    if (move.contacts > 0) set(move.velocity, turns.velocity());
    move.travel = move.position - position;
}

}  // namespace pierce::detail
