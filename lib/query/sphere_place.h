// Where a sphere that enters a triangle is stopped: a place of Scalars the way to which is clear, by the rule that
// decided the hit.
#pragma once

#include <query/sphere_walk.h>

namespace pierce::detail {

/// How far from the true place another may be that the shortlist is good for, in each coordinate, in last places of the
/// largest coordinate there.
constexpr double k_sphere_margin_units = 64;

template <class Scalar>
[[nodiscard]] double sphere_margin(const Scene<Scalar>& scene, double radius) {
    double largest = radius;
    for (std::size_t k = 0; k < 3; ++k)
        largest = std::max({largest, radius + std::abs(scene.bounds.low[k]), radius + std::abs(scene.bounds.high[k])});
    return k_sphere_margin_units * last_place<Scalar>(std::min(largest, std::numeric_limits<double>::max()));
}

/// What place_sphere() asks about other ways from the start.
template <class Scalar>
struct SphereWays {
    using Number = Scalar;
    const SphereQuery<Scalar>& query;
    const Sphere& sphere;
    double reach;
    double margin;
    const Shortlist& list;
    double least_grain = 0;  ///< of the place

    /// Where on the way from the start to `to` the sphere enters a triangle. `near`: within `margin` of a point of the
    /// path up to the hit.
    [[nodiscard]] bool stops(const Point& to, bool near, SphereCandidate& candidate) const {
        const Sphere way({.from = sphere.path.from, .to = to}, sphere.radius, reach);
        FirstEntry<Scalar> first(query, way, 1);
        if (near && list.complete)
            for (unsigned i = 0; i < list.count; ++i) first.test(list.triangles[i]);
        else
            each_entry<Scalar>(query.scene, way, 0, query.counters, first, nullptr);
        candidate = first.best();
        return first.found();
    }
};

/// The place where `entry` leaves the center. A place at a grain from the surface, away from all that is found in the
/// way to it; else one further back, and at last the start.
///
/// The grain is four units in the last place, as for points (kernel/first_place.h): a center that is moved along a
/// plane and rounded comes nearer to it by less. It is no less than four times what the doubles of sphere/enter.cpp are
/// in doubt about, so that at rest a center is certainly off the surface by them. `ways` is a SphereWays, or has its
/// `Number`, `sphere`, `margin`, `least_grain` and `stops`.
template <class Ways>
[[nodiscard]] Point place_sphere(const Ways& ways, const Entry& entry, std::uint64_t& retreats) {
    using Scalar = typename Ways::Number;  // to which places are rounded
    constexpr int k_pushes = 6;
    constexpr int k_steps_back = 26;
    const Sphere& sphere = ways.sphere;
    const Point& from = sphere.path.from;
    if (entry.at_start) return from;
    const auto true_place = [&](double time) { return plus(from, times(1 / sphere.unit, times(time, sphere.way))); };
    const Point there = true_place(entry.time);
    // What was lost of the true place: roundings of what is far away.
    const double lost = 0x1p-50 * std::max(size_of(from), size_of(minus(there, from)));
    const double grain = std::max({k_grain_units * last_place<Scalar>(size_of(there)), lost,
                                   0x1p-45 * entry.reach / sphere.unit, ways.least_grain});
    const double gone = entry.time * sphere.way_size / sphere.unit;
    // At rest: nothing is gained by moving, and a ball that is pushed into the floor for ever does not shake.
    if (gone <= 2 * grain && entry.distance - sphere.scaled_radius >= grain * sphere.unit / 2) return from;
    const auto rounded = [&](const Point& point) {
        constexpr double k_most = static_cast<double>(std::numeric_limits<Scalar>::max());
        Point out;
        for (std::size_t k = 0; k < 3; ++k) out[k] = std::clamp(point[k], -k_most, k_most);
        return rounded_to<Scalar>(out);
    };
    SphereCandidate stop;
    const auto is_clear = [&](const Point& place, const Point& of) {
        const bool near = lost <= ways.margin / 4 && size_of(minus(place, of)) <= ways.margin / 2;
        const bool clear = place == from || !ways.stops(place, near, stop);
        retreats += clear ? 0 : 1;
        return clear;
    };
    Point push = times(grain, entry.normal);
    for (int i = 0; i < k_pushes; ++i) {
        const Point place = rounded(plus(there, push));
        if (is_clear(place, there)) return place;
        push = plus(push, times(grain, stop.normal));
    }
    // Backwards along the way, by 1, 4, 16, ... grains.
    double back = grain * sphere.unit / sphere.way_size;
    for (int i = 0; i < k_steps_back && back < entry.time; ++i, back *= 4) {
        const Point of = true_place(entry.time - back);
        const Point place = rounded(plus(of, times(grain, entry.normal)));
        if (is_clear(place, of)) return place;
    }
    return from;
}

}  // namespace pierce::detail
