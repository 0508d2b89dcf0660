// Places before a face and beyond it. A place is a number that is tried: what the way to it from the flight's start
// crosses is decided exactly, so whatever is returned, its region is known. The region of the start is the leg's; each
// crossing on the way leads to the next, and in a model whose labels agree the last one to the region of the place.
//
// Tried are the true point off the plane by 1, 2, 4 and 8 grains, rounded outwards; nearly always the first will do. In
// thin corners none may. Then, for a stop, points back along the way from the start, whose region is right as far as
// rounding does not matter; for a crossing, points further along the flight, in the first of its legs behind the face
// that is longer than nothing.
#include <query/region_place.h>

#include <algorithm>
#include <cmath>

#include <query/grain.h>
#include <query/region_order.h>
#include <query/values.h>
#include <query/ways.h>

namespace pierce::detail {

namespace {

template <class Scalar>
[[nodiscard]] RegionPlace<Scalar> place(const Point& point, std::uint32_t region, bool reached) {
    RegionPlace<Scalar> out;
    for (std::size_t k = 0; k < 3; ++k) out.point[static_cast<int>(k)] = static_cast<Scalar>(point[k]);
    out.region = region;
    out.reached = reached;
    return out;
}

template <class Scalar>
class PlaceBy {
  public:
    /// `leg`: the first of the path, with a face.
    PlaceBy(const RegionScene<Scalar>& regions, const Path& path, const Leg<Scalar>& leg, QueryCounters& counters)
        : regions_(regions), path_(path), leg_(leg), counters_(counters) {
        const TriangleRef triangle = regions.where[leg.triangle];
        measure_path<Scalar>(regions.scene.corners(triangle), path, measured_);
        Values values;
        Rounded<Scalar> rounded;
        const Decision decision{.hit = true, .side = leg.side};
        certify(regions.scene.narrow(), measured_, path, decision, regions.scene.grain, counters, values, rounded);
        for (std::size_t k = 0; k < 3; ++k) {
            true_point_[k] = values.high[k] + values.low[k];
            near_[k] = (leg.side == Sides::front ? 1 : -1) * values.normal[k] / values.length;
        }
    }

    [[nodiscard]] RegionPlace<Scalar> before() {
        const auto is_clear = [this](const Point& point) { return look(point).count == 1; };
        for (const double grains : {1.0, 2.0, 4.0, 8.0})
            if (const Point point = off(grains); is_clear(point)) return place<Scalar>(point, leg_.region, true);
        for (double back = 0x1p-50; back < 1; back *= 2) {
            Point point{};
            for (std::size_t k = 0; k < 3; ++k) point[k] = path_.from[k] * back + true_point_[k] * (1 - back);
            point = rounded_to<Scalar>(point);
            if (is_clear(point)) return place<Scalar>(point, leg_.region, true);
        }
        return place<Scalar>(path_.from, leg_.region, true);
    }

    [[nodiscard]] RegionPlace<Scalar> beyond() {
        for (const double grains : {-1.0, -2.0, -4.0, -8.0}) {
            const Point point = off(grains);
            if (is_next(look(point))) return place<Scalar>(point, leg_.next, true);
        }
        RegionPlace<Scalar> found;
        if (find_along(found)) return found;
        for (const Point& point : {off(-1), rounded_to<Scalar>(true_point_)})
            if (const Look seen = look(point); seen.known) return place<Scalar>(point, seen.region, false);
        return place<Scalar>(path_.from, leg_.region, false);
    }

  private:
    static constexpr std::size_t k_most_legs = 16;

    struct Look {
        std::size_t count;  ///< legs on the way
        std::uint32_t region;
        bool known;  ///< whether it is certain what lies on the way
    };

    /// Whether a point is beyond this one surface.
    [[nodiscard]] bool is_next(const Look& seen) const { return seen.count == 2 && seen.region == leg_.next; }

    /// What lies on the way to a point.
    [[nodiscard]] Look look(const Point& point) const {
        if (!std::isfinite(point[0] + point[1] + point[2])) return {0, 0, false};
        if (point == path_.from) return {1, leg_.region, true};
        std::array<Leg<Scalar>, k_most_legs> legs;
        const std::size_t count = find_legs(regions_, Path{path_.from, point}, std::span<Leg<Scalar>>(legs), counters_);
        if (count == 1 && legs[0].face == no_face) return {1, leg_.region, true};
        if (legs[count - 1].face != no_face) return {count, region_at(regions_, point, counters_), true};
        const bool consistent = std::all_of(legs.begin(), legs.begin() + static_cast<std::ptrdiff_t>(count),
                                            [](const Leg<Scalar>& leg) { return leg.consistent; });
        return {count, legs[count - 1].region, consistent};
    }

    /// The true point off the plane to the near side, rounded away from the plane.
    [[nodiscard]] Point off(double grains) const {
        Point point{};
        for (std::size_t k = 0; k < 3; ++k) {
            const double by = grains * regions_.scene.grain * near_[k];
            const double wanted = true_point_[k] + by;
            auto rounded = static_cast<Scalar>(wanted);
            const bool short_of =
                by > 0 ? static_cast<double>(rounded) < wanted : static_cast<double>(rounded) > wanted;
            constexpr Scalar k_infinite = std::numeric_limits<Scalar>::infinity();
            if (by != 0 && short_of) rounded = std::nextafter(rounded, by > 0 ? k_infinite : -k_infinite);
            point[k] = static_cast<double>(rounded);
        }
        return point;
    }

    // A place further along the flight: in steps from sixteen grains on, each twice as long as the one before, up to
    // the middle of the leg.
    bool find_along(RegionPlace<Scalar>& found) {
        std::array<Leg<Scalar>, k_most_legs> legs;
        const std::size_t count = find_legs(regions_, path_, std::span<Leg<Scalar>>(legs), counters_);
        Point way{};
        double length = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            way[k] = path_.ray ? path_.to[k] : path_.to[k] - path_.from[k];
            length = std::max(length, std::abs(way[k]));
        }
        for (std::size_t i = 1; i < count; ++i) {
            const double first = fraction_at(legs[i - 1]);
            const double last = legs[i].face == no_face ? 2 : fraction_at(legs[i]);
            if (!(last > first)) continue;
            for (double step = std::max(16 * regions_.scene.grain / length, 0x1p-1000); step < 2; step *= 2) {
                const double by = std::min(step, (last - first) / 2);
                Point point{};
                for (std::size_t k = 0; k < 3; ++k) point[k] = path_.from[k] + (first + by) * way[k];
                point = rounded_to<Scalar>(point);
                const Look seen = look(point);
                if (i == 1 ? is_next(seen) : seen.known && seen.region == legs[i].region) {
                    found = place<Scalar>(point, seen.region, i == 1);
                    return true;
                }
                if (by < step) break;
            }
        }
        return false;
    }
    [[nodiscard]] double fraction_at(const Leg<Scalar>& leg) const {
        return measure(path_, regions_.scene.corners(regions_.where[leg.triangle])).fraction;
    }

    const RegionScene<Scalar>& regions_;
    const Path& path_;
    const Leg<Scalar>& leg_;
    QueryCounters& counters_;
    Measured measured_;
    Point true_point_{};
    Point near_{};  ///< the normal of length 1, towards where the path comes from
};

/// The end of a way, rounded.
template <class Scalar>
[[nodiscard]] Point end_point(const Segment<Scalar>& way) {
    return to_point(way.to);
}
template <class Scalar>
[[nodiscard]] Point end_point(const Ray<Scalar>& way) {
    Point end{};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto i = static_cast<int>(k);
        end[k] =
            static_cast<double>(way.origin[i]) + static_cast<double>(way.limit) * static_cast<double>(way.direction[i]);
    }
    return rounded_to<Scalar>(end);
}

/// Of a flight without a face: its end, or where rounding that crosses one, a place on the way back to the start.
template <class Scalar, class Way>
[[nodiscard]] RegionPlace<Scalar> stop_at_end(const RegionScene<Scalar>& regions, const Way& way,
                                              const Leg<Scalar>& leg, QueryCounters& counters) {
    const Point from = start_of(way);
    const Point end = end_point(way);
    for (double back = 0; back < 1; back = back == 0 ? 0x1p-50 : 2 * back) {
        Point point = end;
        for (std::size_t k = 0; k < 3; ++k)
            if (back > 0) point[k] = from[k] * back + end[k] * (1 - back);
        point = rounded_to<Scalar>(point);
        if (!std::isfinite(point[0] + point[1] + point[2])) continue;
        std::array<Leg<Scalar>, 1> legs;
        find_legs(regions, Path{from, point}, std::span<Leg<Scalar>>(legs), counters);
        if (legs[0].face == no_face) return place<Scalar>(point, leg.region, true);
    }
    return place<Scalar>(from, leg.region, true);
}

/// Sets the path of a flight, and says whether it crosses the face at the end of a leg: not if the leg has none, or is
/// of another flight or another mesh.
template <class Scalar, class Way>
[[nodiscard]] bool leads_to_face(const RegionScene<Scalar>& regions, const Way& way, const Leg<Scalar>& leg,
                                 QueryCounters& counters, Path& path) {
    constexpr double k_infinite = std::numeric_limits<double>::infinity();
    if (leg.face == no_face || leg.triangle >= regions.where.size()) return false;
    const TriangleRef triangle = regions.where[leg.triangle];
    Crossing unused;
    return triangle != k_nowhere && set_path(regions.scene, way, k_infinite, path) &&
           find_crossing(regions.scene, path, triangle, k_infinite, counters, unused);
}

}  // namespace

template <class Scalar, class Way>
RegionPlace<Scalar> stop(const RegionScene<Scalar>& regions, const Way& way, const Leg<Scalar>& leg,
                         QueryCounters& counters) {
    Path path;
    if (!leads_to_face(regions, way, leg, counters, path)) return stop_at_end(regions, way, leg, counters);
    return PlaceBy<Scalar>(regions, path, leg, counters).before();
}

template <class Scalar, class Way>
RegionPlace<Scalar> cross(const RegionScene<Scalar>& regions, const Way& way, const Leg<Scalar>& leg,
                          QueryCounters& counters) {
    Path path;
    if (!leads_to_face(regions, way, leg, counters, path)) return stop_at_end(regions, way, leg, counters);
    return PlaceBy<Scalar>(regions, path, leg, counters).beyond();
}

#define PIERCE_PLACES(Scalar, Way)                                                                         \
    template RegionPlace<Scalar> stop(const RegionScene<Scalar>&, const Way<Scalar>&, const Leg<Scalar>&,  \
                                      QueryCounters&);                                                     \
    template RegionPlace<Scalar> cross(const RegionScene<Scalar>&, const Way<Scalar>&, const Leg<Scalar>&, \
                                       QueryCounters&)
PIERCE_PLACES(float, Segment);
PIERCE_PLACES(float, Ray);
PIERCE_PLACES(double, Segment);
PIERCE_PLACES(double, Ray);
#undef PIERCE_PLACES

}  // namespace pierce::detail
