// The legs of a flight: the first crossings are kept in the caller's own array, as a heap with the last of them on top
// (Williams 1964), so that nothing is allocated and the search ends with the last leg that is asked for. Then come the
// order of faces that coincide, the regions, and the values.
#include <query/region_walk.h>

#include <algorithm>
#include <cmath>

#include <query/parameter.h>
#include <query/region_order.h>
#include <query/values.h>
#include <query/ways.h>

namespace pierce::detail {

namespace {

/// Of each leg it fills what it needs itself: the place of the triangle (cluster in `triangle`, lane in `face`), the
/// side, and the interval of its fraction in `entry` and `exit`.
template <class Scalar>
class FirstCrossings {
  public:
    FirstCrossings(const Scene<Scalar>& scene, const Path& path, std::span<Leg<Scalar>> out, QueryCounters& counters)
        : scene_(scene), path_(path), out_(out), counters_(counters) {}

    /// Crossings beyond this fraction are of no use.
    [[nodiscard]] double limit() const { return full() ? static_cast<double>(out_[0].exit) : 1; }
    void add(const Crossing& crossing) {
        if (!full()) {
            write(crossing, out_[kept_++]);
            std::push_heap(out_.begin(), end(), before());
            return;
        }
        const Crossing top = crossing_of(out_[0]);
        const int order = order_of(scene_, path_, crossing, top, counters_);
        if (order > 0 || (order == 0 && !has_smaller_number(scene_, crossing.triangle, top.triangle))) {
            cut_ = cut_ || order == 0;
            return;
        }
        std::pop_heap(out_.begin(), end(), before());
        write(crossing, out_[kept_ - 1]);
        std::push_heap(out_.begin(), end(), before());
        // What was left out before comes after `top`, or lies in its plane.
        cut_ = order_of(scene_, path_, crossing_of(out_[0]), top, counters_) == 0;
    }
    /// Returns how many there are.
    std::size_t sort() {
        std::sort_heap(out_.begin(), end(), before());
        return kept_;
    }
    /// Whether crossings were left out in the place of the last one that was kept.
    [[nodiscard]] bool cut() const { return cut_; }

    [[nodiscard]] static Crossing crossing_of(const Leg<Scalar>& leg) {
        return {{leg.triangle, leg.face},
                leg.side == Sides::front ? 1 : -1,
                static_cast<double>(leg.entry),
                static_cast<double>(leg.exit)};
    }
    static void write(const Crossing& crossing, Leg<Scalar>& leg) {
        leg.triangle = crossing.triangle.cluster;
        leg.face = crossing.triangle.lane;
        leg.side = crossing.sign > 0 ? Sides::front : Sides::back;
        constexpr Scalar k_infinite = std::numeric_limits<Scalar>::infinity();
        leg.entry = static_cast<Scalar>(crossing.earliest);
        leg.exit = static_cast<Scalar>(crossing.latest);
        if (static_cast<double>(leg.entry) > crossing.earliest) leg.entry = std::nextafter(leg.entry, -k_infinite);
        if (static_cast<double>(leg.exit) < crossing.latest) leg.exit = std::nextafter(leg.exit, k_infinite);
    }

  private:
    [[nodiscard]] bool full() const { return kept_ == out_.size(); }
    [[nodiscard]] auto end() const { return out_.begin() + static_cast<std::ptrdiff_t>(kept_); }
    auto before() {
        return [this](const Leg<Scalar>& x, const Leg<Scalar>& y) {
            const Crossing one = crossing_of(x);
            const Crossing two = crossing_of(y);
            const int order = order_of(scene_, path_, one, two, counters_);
            return order < 0 || (order == 0 && has_smaller_number(scene_, one.triangle, two.triangle));
        };
    }

    const Scene<Scalar>& scene_;
    const Path& path_;
    std::span<Leg<Scalar>> out_;
    QueryCounters& counters_;
    std::size_t kept_ = 0;
    bool cut_ = false;
};

/// Puts crossings of coincident faces, from `first` to `last` of the legs, in the order in which their regions follow.
/// `cut`: there are others in this place.
template <class Scalar>
void chain(const RegionScene<Scalar>& regions, const Path& path, std::span<Leg<Scalar>> legs, std::size_t first,
           std::size_t last, bool cut, QueryCounters& counters) {
    using Kept = FirstCrossings<Scalar>;
    Pile<Scalar> pile(regions);
    if (cut) {
        const Crossing one = Kept::crossing_of(legs[first]);
        each_crossing(
            regions.scene, path, counters, [&] { return one.latest; },
            [&](const Crossing& crossing) {
                if (order_of(regions.scene, path, crossing, one, counters) == 0) pile.add(crossing);
            });
    } else {
        for (std::size_t i = first; i < last; ++i) pile.add(Kept::crossing_of(legs[i]));
    }
    if (!pile.complete()) return;
    std::uint32_t region = 0;
    if (first > 0) {
        const Crossing before = Kept::crossing_of(legs[first - 1]);
        region = regions.far(before.triangle, before.sign);
    }
    pile.chain(first > 0 ? &region : nullptr);
    for (std::size_t i = first; i < last; ++i) Kept::write(pile[i - first], legs[i]);
}

/// The fraction of a crossing, within (1/2 + 1/32) ulp of `Scalar` where it is rounded once.
template <class Scalar>
[[nodiscard]] double fraction_of(const Scene<Scalar>& scene, const Path& path, const Crossing& crossing,
                                 QueryCounters& counters) {
    const Corners corners = scene.corners(crossing.triangle);
    const Sides side = crossing.sign > 0 ? Sides::front : Sides::back;
    Measured measured;
    measure_path<Scalar>(corners, path, measured);
    Values values;
    Rounded<Scalar> unused;
    const auto is_near = [&values] { return values.fraction_error <= k_tolerance<Scalar> * values.weights[3]; };
    scene.narrow().evaluate(measured, side, scene.grain, values, unused);
    if (is_near()) return values.weights[3];
    if (sizeof(Scalar) == sizeof(float)) {
        scene.narrow().evaluate_finely(measured, side, scene.grain, values, unused);
        if (is_near()) return values.weights[3];
    }
    ++counters.exact_values;
    return measure(path, corners).fraction;
}

template <class Scalar>
void set_values(const RegionScene<Scalar>& regions, const Path& path, std::span<Leg<Scalar>> legs, Scalar end,
                QueryCounters& counters) {
    constexpr auto k_largest = static_cast<double>(std::numeric_limits<Scalar>::max());
    Scalar entry = 0;
    double latest = -1;  // of the crossing before
    TriangleRef before{};
    for (Leg<Scalar>& leg : legs) {
        if (leg.triangle == no_face) {
            leg.entry = entry;
            leg.exit = end;
            break;
        }
        const auto earliest = static_cast<double>(leg.entry);
        const auto own_latest = static_cast<double>(leg.exit);
        leg.entry = entry;
        const TriangleRef triangle = regions.where[leg.triangle];
        const Crossing crossing{triangle, leg.side == Sides::front ? 1 : -1, earliest, own_latest};
        const double fraction = fraction_of(regions.scene, path, crossing, counters);
        const double exit = to_parameter(path, fraction, false, [&] { return regions.scene.corners(triangle); });
        leg.exit = static_cast<Scalar>(std::min(exit, k_largest));
        if (leg.exit < entry) leg.exit = entry;
        if (leg.exit > entry && earliest <= latest) {
            ++counters.exact_orders;
            if (compare_fractions(path, regions.scene.corners(before), regions.scene.corners(triangle)) == 0)
                leg.exit = entry;
        }
        entry = leg.exit;
        before = triangle;
        latest = own_latest;
    }
}

/// A leg without a face. Its parameters are set_values()' task.
template <class Scalar>
void end_with(std::uint32_t region, Leg<Scalar>& leg) {
    leg.region = leg.next = region;
    leg.face = leg.triangle = no_face;
    leg.side = Sides::front;
    leg.consistent = true;
}

template <class Scalar>
[[nodiscard]] Scalar end_of(const Segment<Scalar>&) {
    return 1;
}
template <class Scalar>
[[nodiscard]] Scalar end_of(const Ray<Scalar>& ray) {
    return ray.limit;
}

/// Out of the box through the side that is nearest, tilted as in winding numbers (counting.h), by numbers of few bits.
[[nodiscard]] Point direction_out(const Point& point, const Box& box) {
    std::size_t axis = 0;
    bool up = true;
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k)
        for (const bool high : {true, false}) {
            const double distance = high ? box.high[k] / 2 - point[k] / 2 : point[k] / 2 - box.low[k] / 2;
            if (!(distance < shortest)) continue;
            shortest = distance;
            axis = k;
            up = high;
        }
    Point direction{};
    direction[axis] = up ? 1 : -1;
    direction[(axis + 1) % 3] = 0x1.bp-7;
    direction[(axis + 2) % 3] = 0x1.c8p-6;
    return direction;
}

}  // namespace

template <class Scalar>
std::size_t find_legs(const RegionScene<Scalar>& regions, const Path& path, std::span<Leg<Scalar>> out,
                      QueryCounters& counters) {
    const Scene<Scalar>& scene = regions.scene;
    FirstCrossings<Scalar> crossings(scene, path, out, counters);
    each_crossing(
        scene, path, counters, [&] { return crossings.limit(); },
        [&](const Crossing& crossing) { crossings.add(crossing); });
    const std::size_t count = crossings.sort();
    for (std::size_t first = 0; first < count;) {
        const Crossing one = FirstCrossings<Scalar>::crossing_of(out[first]);
        std::size_t last = first + 1;
        while (last < count &&
               order_of(scene, path, one, FirstCrossings<Scalar>::crossing_of(out[last]), counters) == 0)
            ++last;
        const bool cut = last == count && crossings.cut();
        if (cut || last > first + 1) chain(regions, path, out, first, last, cut, counters);
        first = last;
    }
    for (std::size_t i = 0; i < count; ++i) {
        Leg<Scalar>& leg = out[i];
        const Crossing crossing = FirstCrossings<Scalar>::crossing_of(leg);
        const std::uint32_t near = regions.near(crossing.triangle, crossing.sign);
        leg.region = i > 0 ? out[i - 1].next : near;
        leg.next = regions.far(crossing.triangle, crossing.sign);
        leg.consistent = leg.region == near;
        leg.triangle = scene.number_of(crossing.triangle);
        leg.face = scene.face_of_number(leg.triangle);
    }
    if (count == out.size()) return count;
    end_with(count > 0 ? out[count - 1].next : Regions<Scalar>::no_region, out[count]);
    return count + 1;
}

template <class Scalar>
std::uint32_t region_at(const RegionScene<Scalar>& regions, const Point& point, QueryCounters& counters) {
    const Box& box = regions.scene.bounds;
    if (is_clearly_outside(regions.scene, point)) return regions.outside;
    Path path;
    constexpr double k_infinite = std::numeric_limits<double>::infinity();
    if (!set_ray_path(box, point, direction_out(point, box), k_infinite, k_infinite, sizeof(Scalar) == sizeof(float),
                      path))
        return regions.outside;
    std::array<Leg<Scalar>, 1> leg;
    find_legs(regions, path, std::span<Leg<Scalar>>(leg), counters);
    return leg[0].face == no_face ? regions.outside : leg[0].region;
}

template <class Scalar, class Way>
std::size_t walk(const RegionScene<Scalar>& regions, const Way& way, std::span<Leg<Scalar>> out,
                 QueryCounters& counters) {
    if (out.empty()) return 0;
    Path path;
    std::size_t count = 1;
    if (!regions.scene.empty() && set_path(regions.scene, way, std::numeric_limits<double>::infinity(), path)) {
        count = find_legs(regions, path, out, counters);
    } else {
        end_with(Regions<Scalar>::no_region, out[0]);
    }
    if (count == 1 && out[0].face == no_face) out[0].region = out[0].next = region_at(regions, start_of(way), counters);
    set_values(regions, path, out.first(count), end_of(way), counters);
    return count;
}

#define PIERCE_LEGS(Scalar)                                                                                          \
    template std::size_t find_legs(const RegionScene<Scalar>&, const Path&, std::span<Leg<Scalar>>, QueryCounters&); \
    template std::uint32_t region_at(const RegionScene<Scalar>&, const Point&, QueryCounters&);                      \
    template std::size_t walk(const RegionScene<Scalar>&, const Segment<Scalar>&, std::span<Leg<Scalar>>,            \
                              QueryCounters&);                                                                       \
    template std::size_t walk(const RegionScene<Scalar>&, const Ray<Scalar>&, std::span<Leg<Scalar>>, QueryCounters&)
PIERCE_LEGS(float);
PIERCE_LEGS(double);
#undef PIERCE_LEGS

}  // namespace pierce::detail
