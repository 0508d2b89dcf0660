// Velocities after contacts, in double: one impact (bounce), and several planes that hold a particle at once (resolve).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include <query/half_spaces.h>

namespace pierce::detail {

[[nodiscard]] inline Point plus(const Point& p, double s, const Point& q) {
    return {p[0] + s * q[0], p[1] + s * q[1], p[2] + s * q[2]};
}
[[nodiscard]] inline Point times(double s, const Point& p) { return {s * p[0], s * p[1], s * p[2]}; }
[[nodiscard]] inline double length_of(const Point& p) { return std::sqrt(dot_product(p, p)); }

/// A surface that a particle runs into: only w with w . normal >= velocity . normal do not go into it.
struct Wall {
    Point normal;  ///< unit, towards the particle
    Point velocity;
    double friction = 0;

    [[nodiscard]] double least() const { return dot_product(normal, velocity); }
};

/// `along` (the part of a velocity along a surface, seen from it) after friction that takes `most` from it.
[[nodiscard]] inline Point taken_off(const Point& velocity, const Point& along, double most) {
    const double length = length_of(along);
    // Not "length <= most": where nothing is taken NaN stays NaN.
    if (length > most) return most > 0 ? plus(velocity, -most / length, along) : velocity;
    return plus(velocity, -1, along);
}

/// pierce::bounce. An approach that is NaN is one: what comes out is not finite either.
[[nodiscard]] inline Point bounced(const Point& velocity, const Wall& wall, double restitution) {
    const Point seen = difference_of(velocity, wall.velocity);
    const double into = dot_product(seen, wall.normal);
    if (into >= 0) return velocity;
    const Point along = plus(seen, -into, wall.normal);
    const Point out = plus(wall.velocity, -restitution * into, wall.normal);
    const Point all{out[0] + along[0], out[1] + along[1], out[2] + along[2]};
    if (!(wall.friction > 0)) return all;
    return taken_off(all, along, wall.friction * (1 + restitution) * -into);
}

/// What is equal but for rounding: velocities are rounded to `Scalar` from step to step, which turns them by less than
/// an epsilon, and so are normals that callers give, within 4. Sixteen of them leave room for sums. It is a share of
/// what is compared, so it has no dimension: planes at a smaller angle than that are one plane, and what is left of a
/// velocity after more than all but that was taken off is 0.
template <class Scalar>
inline constexpr double k_alike = 16 * static_cast<double>(std::numeric_limits<Scalar>::epsilon());

/// The velocity nearest to `velocity` that goes into none of the walls, and how many of them hold it: none, one along
/// whose plane it is, two along whose crease it is, or three or more that stop it.
///
/// It is the projection on a polyhedron, the intersection of half-spaces; so it is unique, and does not depend on the
/// order of walls (by Gauss's principle of least constraint it is what inelastic contacts without friction do). It lies
/// on a face of the polyhedron: on none, one, two or three of the planes, and there it is the projection on these. So
/// it is the nearest of all such projections that go into no wall: 92 at most for eight walls.
class Resolver {
  public:
    struct Held {
        Point velocity;
        int count = 0;
        std::array<std::size_t, 3> by{};  ///< the first `count`
        std::array<double, 3> push{};     ///< by how much each changed the velocity, along its normal
    };

    Resolver(std::span<const Wall> walls, const Point& velocity, double alike)
        : walls_(walls), velocity_(velocity), alike_(alike) {
        double fastest = length_of(velocity);
        for (const Wall& wall : walls) {
            fastest = std::max(fastest, length_of(wall.velocity));
            still_ = still_ && wall.least() <= 0;
        }
        slack_ = alike * fastest;
    }

    [[nodiscard]] Held nearest() {
        if (is_free(velocity_)) return {velocity_, 0, {}, {}};
        if (walls_.size() == 1) {  // nearly all there are
            const double push = lack(0);
            return {settled(plus(velocity_, push, walls_[0].normal)), 1, {0}, {push}};
        }
        for (std::size_t i = 0; i < walls_.size(); ++i) try_one(i);
        for (std::size_t i = 0; i < walls_.size(); ++i)
            for (std::size_t j = i + 1; j < walls_.size(); ++j) try_two(i, j);
        if (still_) {
            try_one_of({Point{}, 3, {}, {}});
        } else {
            for (std::size_t i = 0; i < walls_.size(); ++i)
                for (std::size_t j = i + 1; j < walls_.size(); ++j)
                    for (std::size_t k = j + 1; k < walls_.size(); ++k) try_three(i, j, k);
        }
        // Walls that close in on it from all sides: it goes with the last one.
        if (!found_) held_ = {walls_.back().velocity, 3, {}, {}};
        held_.velocity = settled(held_.velocity);
        return held_;
    }
    [[nodiscard]] bool is_free(const Point& velocity) const {
        return std::all_of(walls_.begin(), walls_.end(), [&](const Wall& wall) {
            return dot_product(wall.normal, velocity) - wall.least() >= -slack_;
        });
    }

    /// What goes with a wall, but for rounding, goes with it: what rests is at rest.
    [[nodiscard]] Point settled(const Point& velocity) const {
        for (const Wall& wall : walls_)
            if (length_of(difference_of(velocity, wall.velocity)) <= slack_) return wall.velocity;
        return velocity;
    }

  private:
    [[nodiscard]] double lack(std::size_t i) const {
        return walls_[i].least() - dot_product(walls_[i].normal, velocity_);
    }
    void try_one(std::size_t i) {
        const double push = lack(i);
        try_one_of({plus(velocity_, push, walls_[i].normal), 1, {i}, {push}});
    }
    // Planes at less than `alike_` have no crease: either one will do for both.
    void try_two(std::size_t i, std::size_t j) {
        const Point& n = walls_[i].normal;
        const Point& m = walls_[j].normal;
        const Point crease = cross_product(n, m);
        const double sine2 = dot_product(crease, crease);
        if (!(sine2 > alike_ * alike_)) return;
        const double c = dot_product(n, m);
        const double a = walls_[i].least();
        const double b = walls_[j].least();
        // Along the crease as it was, across it as the walls do.
        Point velocity = times(dot_product(velocity_, crease) / sine2, crease);
        velocity = plus(velocity, (a - c * b) / sine2, n);
        velocity = plus(velocity, (b - c * a) / sine2, m);
        const double push_i = (lack(i) - c * lack(j)) / sine2;
        const double push_j = (lack(j) - c * lack(i)) / sine2;
        try_one_of({velocity, 2, {i, j}, {push_i, push_j}});
    }
    void try_three(std::size_t i, std::size_t j, std::size_t k) {
        const Point jk = cross_product(walls_[j].normal, walls_[k].normal);
        const Point ki = cross_product(walls_[k].normal, walls_[i].normal);
        const Point ij = cross_product(walls_[i].normal, walls_[j].normal);
        const double volume = dot_product(walls_[i].normal, jk);
        if (!(std::abs(volume) > alike_)) return;
        Point velocity = times(walls_[i].least() / volume, jk);
        velocity = plus(velocity, walls_[j].least() / volume, ki);
        velocity = plus(velocity, walls_[k].least() / volume, ij);
        try_one_of({velocity, 3, {i, j, k}, {}});
    }
    void try_one_of(const Held& held) {
        if (!is_free(held.velocity)) return;
        const Point change = difference_of(held.velocity, velocity_);
        const double square = dot_product(change, change);
        if (found_ && !(square < least_)) return;
        found_ = true;
        least_ = square;
        held_ = held;
    }

    std::span<const Wall> walls_;
    Point velocity_;
    double alike_;
    double slack_ = 0;   ///< how far into a wall a velocity may go by rounding
    bool still_ = true;  ///< 0 goes into no wall
    bool found_ = false;
    double least_ = 0;
    Held held_;
};

/// The nearest velocity, less what friction takes: of its part along what holds it, seen from there, up to the sum of
/// each wall's friction times its push. `held`: by how many walls it is.
[[nodiscard]] inline Point resolved(std::span<const Wall> walls, const Point& velocity, double alike, int& held) {
    Resolver resolver(walls, velocity, alike);
    const Resolver::Held nearest = resolver.nearest();
    held = nearest.count;
    if (held == 0 || held >= 3) return nearest.velocity;
    double most = 0;
    Point with{};
    for (std::size_t i = 0; i < static_cast<std::size_t>(held); ++i) {
        const Wall& wall = walls[nearest.by[i]];
        const double share = wall.friction * std::max(nearest.push[i], 0.0);
        most += share;
        with = plus(with, share, wall.velocity);
    }
    if (!(most > 0)) return nearest.velocity;
    const Point seen = plus(nearest.velocity, -1 / most, with);
    Point along;
    if (held == 1) {
        const Point& normal = walls[nearest.by[0]].normal;
        along = plus(seen, -dot_product(seen, normal), normal);
    } else {
        const Point crease = cross_product(walls[nearest.by[0]].normal, walls[nearest.by[1]].normal);
        along = times(dot_product(seen, crease) / dot_product(crease, crease), crease);
    }
    const Point slowed = resolver.settled(taken_off(nearest.velocity, along, most));
    if (resolver.is_free(slowed)) return slowed;
    // A conveyor has pushed it into another wall.
    Resolver again(walls, slowed, alike);
    const Resolver::Held last = again.nearest();
    held = last.count;
    return last.velocity;
}

}  // namespace pierce::detail
