// One segment and one triangle, made so that their relation is generic or as delicate as coordinates allow.
#pragma once

#include <array>
#include <cmath>
#include <sstream>
#include <string_view>

#include <point.h>
#include <support/random.h>

namespace pierce::test {

struct Pair {
    detail::Path path;
    detail::Corners corners;
};

inline std::string describe(const Pair& pair) {
    std::ostringstream out;
    out << std::hexfloat;
    for (const detail::Point& p : {pair.path.from, pair.path.to, pair.corners[0], pair.corners[1], pair.corners[2]})
        out << p[0] << ' ' << p[1] << ' ' << p[2] << "  ";
    return out.str();
}

enum class Family { random, at_edge, at_vertex, coplanar, touching, sliver, lattice, degenerate, near_parallel, count };

constexpr std::array<std::string_view, static_cast<std::size_t>(Family::count)> k_family_names = {
    "random", "at_edge", "at_vertex", "coplanar", "touching", "sliver", "lattice", "degenerate", "near_parallel"};

/// The same shape everywhere: made around the origin at size 1, scaled, shifted by `offset` along a random direction,
/// then every coordinate is rounded to `Scalar`.
template <class Scalar>
Pair make_pair_of(Family family, double scale, double offset, Random& random) {
    using V = Vec3<double>;
    std::array<V, 3> t = {random.in_cube(), random.in_cube(), random.in_cube()};
    V from = V::Zero();
    V to = V::Zero();
    const auto through = [&](const V& target) {
        const V d = random.direction() * std::exp(random.between(-5, 3));
        const double before = random.unit();
        from = target - before * d;
        to = target + (1 - before) * d;
    };
    const auto on = [&](const V& w) -> V { return w[0] * t[0] + w[1] * t[1] + w[2] * t[2]; };
    const auto shuffled = [&](V w) {
        for (int turns = static_cast<int>(random.below(3)); turns > 0; --turns) w = V(w[1], w[2], w[0]);
        return w;
    };
    const double s = random.unit();
    switch (family) {
        case Family::random:
            from = 2 * random.in_cube();
            to = 2 * random.in_cube();
            break;
        case Family::at_edge: through(on(shuffled({s, 1 - s, 0}))); break;
        case Family::at_vertex: through(t[random.below(3)]); break;
        case Family::coplanar: {
            // Coordinates with few digits on a plane that such coordinates can lie on: coplanar also after rounding.
            const int axis = random.between_ints(0, 2);
            const double level = random.between_ints(-8, 8) / 8.0;
            const auto put = [&] {
                V p(random.between_ints(-16, 16), random.between_ints(-16, 16), random.between_ints(-16, 16));
                p /= 8;
                p[axis] = level;
                return p;
            };
            t = {put(), put(), put()};
            from = put();
            to = put();
            if (random.chance(0.3)) to[axis] += random.between_ints(-1, 1);
            break;
        }
        case Family::touching: {
            through(on(random.weights()));
            if (random.chance(0.5)) to = on(random.chance(0.5) ? random.weights() : shuffled({s, 1 - s, 0}));
            else from = on(random.chance(0.5) ? random.weights() : shuffled({0, 0, 1}));
            break;
        }
        case Family::sliver: {
            const double thin = std::exp(random.between(-30, -3));
            t[2] = t[0] + random.between(-0.5, 1.5) * (t[1] - t[0]) + thin * random.direction();
            through(on(random.chance(0.5) ? random.weights() : shuffled({s, 1 - s, 0})));
            break;
        }
        case Family::lattice: {
            const auto put = [&] {
                return V(random.between_ints(-3, 3), random.between_ints(-3, 3), random.between_ints(-3, 3));
            };
            t = {put(), put(), put()};
            from = put();
            to = put();
            break;
        }
        case Family::degenerate: {
            const V e = t[1] - t[0];
            switch (random.below(4)) {
                case 0: t[2] = t[random.below(2)]; break;
                case 1: t[1] = t[2] = t[0]; break;
                case 2: t[2] = t[0] + 2 * e; break;  // collinear before rounding, and often after
                default: break;
            }
            through(on(random.weights()));
            if (random.chance(0.3)) to = from;
            break;
        }
        case Family::near_parallel: {
            const V inside = on(random.weights());
            V d = random.between(-1, 1) * (t[1] - t[0]) + random.between(-1, 1) * (t[2] - t[0]);
            d += std::exp(random.between(-40, -5)) * random.direction();
            from = inside - random.unit() * d;
            to = inside + random.unit() * d;
            break;
        }
        case Family::count: break;
    }
    const V shift = offset * random.direction();
    const auto placed = [&](const V& p) -> detail::Point {
        return detail::to_point(Vec3<Scalar>((scale * p + shift).template cast<Scalar>()));
    };
    return {{placed(from), placed(to)}, {placed(t[0]), placed(t[1]), placed(t[2])}};
}

}  // namespace pierce::test
