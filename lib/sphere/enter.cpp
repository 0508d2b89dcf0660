// When a sphere comes nearer to a triangle than its radius.
//
// The distance d(t) of the center from the triangle is convex in the time t: each plane that separates the two gives a
// line below it, and where that is above the radius the way is clear. So from the direction n of the nearest point at
// one time comes a time up to which the way is clear, the direction there gives the next, and so on: Newton's method
// for d(t) = r, which from the left never passes the first root of a convex function, and where there is none goes on
// to where the distance grows. Each step is a proof by itself, whatever n is: what is computed roughly (nearest.h)
// makes steps shorter, not wrong. (Mirtich 1996, "Impulse-based dynamic simulation", 2.3.2, calls steps of this kind
// conservative advancement; his take the greatest speed for the slope.)
//
// The proof of a step. x, the a_i and the way w are relative to the start; e = 2^-52 is twice the half unit of a
// rounding, M the largest |component| of the a_i and of x = t w, W that of w, and |n_k| <= 2 (n as it is stored has no
// error). The way is clear up to s if s (n . w) >= max n . a_i + r |n| at 0 and at s.
//   n . a_i      a_i is rounded once (e/2), each product and sum once: within 2 e of the sum of |n_k| |a_ik| <= 6 M:
//                12 e M
//   r |n|        the square of |n| within 3 e/2, its root and the product: within 2 e of itself
//   the sum D    one rounding more, of what is at most 6 M + r |n|: 3 e M + e r |n|
//                so D = max n . a_i + r |n| (1 + 8 e) + 32 e M is above the true sum
//   m = n . w    within 2 e 6 W = 12 e W; 16 e W are allowed
// For D < 0 the way is clear from 0 up to -D / (max(-m, 0) + 16 e W) (1 - 4 e): a sum, a quotient and a product.
// For m > 16 e W it is from t on for ever if t (m - 16 e W) (1 - 4 e) >= D.
//
// A place is certainly nearer than r if |x - y| (1 + 16 e) + 64 e M < r. x = t w is within e of itself; y = a_0 + u
// (a_1 - a_0) + v (a_2 - a_0) with rounded u, v >= 0 is a point of the triangle but for a sum u + v that is rounded: a
// component of it is within e/2 M for a_0 and, for each of the others, e (an end each) + e (difference, product) of 2
// M, e/2 of 2 M for either sum, e/2 2 M for u + v: in all within 9 e M, of x - y within 11 e M, times sqrt(3) < 20 e M.
//
// Underflow loses 2^-1074 an operation: nothing beside e M, as M is at least r / 4 where a step is taken, and r at
// least 2^-900 (Sphere::tame).
#include <sphere/enter.h>

#include <limits>

#include <exact/sphere.h>

namespace pierce::detail {

namespace {

constexpr double e = 0x1p-52;
/// From about here on lower bounds that come close to a time where the sphere only just touches get no better.
constexpr int k_most_steps = 64;

double scale_for(double reach) {
    if (!(reach > 0x1p-1000)) return 0x1p1000;
    if (!(reach < 0x1p1000)) return 0x1p-1000;
    return std::ldexp(1.0, -std::ilogb(reach) - 1);
}

Corners relative(const Sphere& sphere, const Corners& corners) {
    Corners out;
    for (std::size_t k = 0; k < 3; ++k) out[k] = minus(times(sphere.unit, corners[k]), sphere.scaled_from);
    return out;
}

double reach_of(const Corners& corners) {
    return std::max({size_of(corners[0]), size_of(corners[1]), size_of(corners[2])});
}

/// A triangle in a sphere's units, and what has been found out about the way.
class Advance {
  public:
    Advance(const Sphere& sphere, const Corners& corners)
        : sphere_(sphere), corners_(relative(sphere, corners)), reach_(reach_of(corners_)) {}

    [[nodiscard]] const Corners& corners() const { return corners_; }

    /// A plane that may separate the triangle from the sphere at t.
    struct Plane {
        double offset = 0;  ///< D
        double slope = 0;   ///< m
    };
    [[nodiscard]] Plane plane_at(double t) const {
        const Point x = times(t, sphere_.way);
        const Point n = direction_from(corners_, nearest_of(corners_, x), x);
        const double most = std::max({dot(n, corners_[0]), dot(n, corners_[1]), dot(n, corners_[2])});
        const double bound = 32 * e * std::max(reach_, size_of(x));
        return {most + sphere_.scaled_radius * std::sqrt(dot(n, n)) * (1 + 8 * e) + bound, dot(n, sphere_.way)};
    }
    /// Up to when a plane shows that the way is clear, if it is at the start.
    [[nodiscard]] double clear_until(const Plane& plane) const {
        const double speed = std::max(-plane.slope, 0.0) + 16 * e * sphere_.way_size;
        return plane.offset < 0 ? -plane.offset / speed * (1 - 4 * e) : 0;
    }
    [[nodiscard]] bool clear_from(double t, const Plane& plane) const {
        const double slope = plane.slope - 16 * e * sphere_.way_size;
        return slope > 0 && t * slope * (1 - 4 * e) >= plane.offset;
    }
    /// Whether the center is certainly nearer than the radius at t.
    [[nodiscard]] bool is_near(double t) const {
        const Point x = times(t, sphere_.way);
        const Point away = minus(x, nearest_of(corners_, x).point);
        const double size = size_of(away);
        const double r = sphere_.scaled_radius;
        if (!(size < r)) return false;
        const double part = size > 0 ? 1 / size : 0;  // against underflow of squares
        const Point unit = times(part, away);
        const double distance = size * std::sqrt(dot(unit, unit));
        return distance * (1 + 16 * e) + 64 * e * std::max(reach_, size_of(x)) < r;
    }

  private:
    const Sphere& sphere_;
    Corners corners_;
    double reach_;
};

double distance_at_start(const Corners& corners) {
    const Point y = nearest_of(corners, {}).point;
    const double size = size_of(y);
    if (!(size > 0)) return 0;
    const Point unit = times(1 / size, y);
    return size * std::sqrt(dot(unit, unit));
}

Point unit_of(const Point& n) { return times(1 / std::sqrt(dot(n, n)), n); }

/// Where the two touch at a time that is known.
void describe(const Sphere& sphere, const Corners& corners, Entry& entry) {
    entry.distance = distance_at_start(corners);
    entry.reach = reach_of(corners);
    entry.center = times(entry.time, sphere.way);
    entry.nearest = nearest_of(corners, entry.center);
    Point n = direction_from(corners, entry.nearest, entry.center);
    // A center on the triangle: its front is as good as its back.
    if (!(dot(n, n) > 0)) n = direction_from(corners, Nearest{.point = entry.center}, entry.center);
    entry.normal = dot(n, n) > 0 ? unit_of(n) : Point{0, 0, 1};
}

/// Brings the time at which the sphere enters to within `width` after `entry.time`, up to which the way is clear;
/// false: it does not enter. In exact arithmetic.
bool bracket(const Sphere& sphere, const Corners& corners, SphereCounts& counts, Entry& entry) {
    const auto entered = [&](double t) {
        ++counts.exact;
        return sphere_enters(sphere.path, t, sphere.radius, corners);
    };
    if (!entered(1)) return false;
    if (!sphere.moves) return true;
    double clear = entry.time;
    double near = 1;
    for (double step = sphere.width; clear + step < near; step *= 4) {
        const double t = clear + step;
        if (entered(t)) {
            near = t;
            break;
        }
        clear = t;
    }
    while (near - clear > sphere.width) {
        const double middle = clear + (near - clear) / 2;
        if (!(middle > clear && middle < near)) break;
        (entered(middle) ? near : clear) = middle;
    }
    entry.time = clear;
    return true;
}

}  // namespace

Sphere::Sphere(const Path& path_, double radius_, double reach) : path(path_), radius(radius_) {
    unit = scale_for(reach);
    const double furthest = std::max(size_of(path.from), size_of(path.to));
    while (!(furthest * unit < 0x1p1000)) unit *= 0x1p-100;
    scaled_radius = radius * unit;
    scaled_from = times(unit, path.from);
    way = minus(times(unit, path.to), scaled_from);
    way_size = size_of(way);
    const double scaled_reach = reach * unit;
    tame = scaled_radius >= 0x1p-900 && scaled_reach <= 1;
    moves = tame && way_size >= 0x1p-900;
    // Doubles nearly always tell times apart in which the sphere goes 2^-36 of the reach, whatever the angle.
    if (moves) width = std::min(0x1p-36 * scaled_reach / way_size, 0x1p-21);
}

namespace {

/// What is known of a way that is clear at its start.
enum class Found { missed, near, unknown };

/// Takes `time` as far as planes show the way to be clear, unless that is beyond `limit`.
Found advance_to(const Advance& advance, const Sphere& sphere, double limit, Advance::Plane plane, double& time) {
    for (int i = 0; i < k_most_steps; ++i) {
        if (advance.clear_from(time, plane)) return Found::missed;
        const double next = advance.clear_until(plane);
        if (!(next > time)) break;
        const bool settled = next - time <= sphere.width * 0x1p-6;
        time = next;
        if (time >= 1 || time > limit) return Found::missed;
        if (settled) break;
        plane = advance.plane_at(time);
    }
    for (const double part : {0x1p-4, 1.0})
        if (advance.is_near(std::min(time + part * sphere.width, 1.0))) return Found::near;
    return Found::unknown;
}

/// Whether it enters, and if so the time.
bool decide_entry(const Sphere& sphere, const Advance& advance, const Corners& corners, double limit,
                  SphereCounts& counts, Entry& entry) {
    if (sphere.moves) {
        if (const Advance::Plane plane = advance.plane_at(0); plane.offset < 0) {
            const Found found = advance_to(advance, sphere, limit, plane, entry.time);
            if (found != Found::unknown) return found == Found::near;
            return bracket(sphere, corners, counts, entry) && entry.time <= limit;
        }
    }
    ++counts.exact;
    const SphereStart start = sphere_start(sphere.path, sphere.radius, corners);
    if (start.gap > 0) return bracket(sphere, corners, counts, entry) && entry.time <= limit;
    entry.at_start = true;
    entry.overlaps = start.gap < 0;
    return start.approach < 0;
}

}  // namespace

bool enters(const Sphere& sphere, const Corners& corners, double limit, SphereCounts& counts, Entry& entry) {
    entry = {};
    const Advance advance(sphere, corners);
    if (!decide_entry(sphere, advance, corners, limit, counts, entry)) return false;
    describe(sphere, advance.corners(), entry);
    return true;
}

bool touches(const Sphere& sphere, const Corners& corners, SphereCounts& counts, Entry& entry) {
    entry = {};
    const Advance advance(sphere, corners);
    if (sphere.tame && advance.plane_at(0).offset < 0) return false;
    entry.overlaps = sphere.tame && advance.is_near(0);
    if (!entry.overlaps) {
        ++counts.exact;
        const int gap = sphere_start(sphere.path, sphere.radius, corners).gap;
        if (gap > 0) return false;
        entry.overlaps = gap < 0;
    }
    describe(sphere, advance.corners(), entry);
    return true;
}

}  // namespace pierce::detail
