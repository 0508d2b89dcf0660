// Sweeps against a mesh that moves without a turn: candidates from the broadphase for the way rounded to `Scalar`, with
// what that is off as more noise (query/sphere_near.h); filter; exact room; the first of them; and a place.
#include <rigid/glide.h>

#include <algorithm>
#include <cmath>

#include <query/candidate.h>
#include <query/certified.h>
#include <query/end_place.h>
#include <query/grain.h>
#include <query/moving_sweep.h>
#include <query/sphere_near.h>
#include <query/ways.h>

namespace pierce::detail {

namespace {

SplitPoint difference(const Point& x, const Point& y) {
    SplitPoint d{};
    for (std::size_t k = 0; k < 3; ++k) {
        // x - y = high + low, exactly, unless `high` overflows.
        const double high = x[k] - y[k];
        const double back = high - x[k];
        d.high[k] = high;
        d.low[k] = (x[k] - (high - back)) - (y[k] + back);
    }
    return d;
}

/// The end rounded to `Scalar`, and from above how far that is off in a coordinate.
template <class Scalar>
Point near(const SplitPoint& end, double& margin) {
    const Point out = rounded_to<Scalar>(end.high);
    for (std::size_t k = 0; k < 3; ++k)
        margin = std::max(margin, (std::abs(end.high[k] - out[k]) + std::abs(end.low[k])) * (1 + 0x1p-50));
    return out;
}

struct GlideCandidate : Filtered {
    TriangleRef triangle;
    Corners corners;
    std::uint32_t number = 0;
    std::uint32_t face = 0;
};

/// The candidate as lib/query/moving_values.cpp takes one: at rest, with the point seen from the mesh.
MovingCandidate at_rest(const GlideCandidate& candidate) {
    MovingCandidate out;
    out.triangle = {{candidate.corners, candidate.corners}};
    out.impact = {.hit = true,
                  .side = candidate.decision.side,
                  .feature = candidate.decision.feature,
                  .feature_index = candidate.decision.feature_index,
                  .at_start = candidate.decision.at_start,
                  .earliest = candidate.earliest,
                  .latest = candidate.latest};
    out.number = candidate.number;
    out.face = candidate.face;
    return out;
}
MovingPoint seen_from_mesh(const Glide& glide) { return to_moving(glide.from.high, glide.to.high); }

/// One query under way.
template <class Scalar>
class FirstGlide {
  public:
    FirstGlide(const Scene<Scalar>& scene, const Glide& glide, double most, bool any, const QueryOptions& options,
               QueryCounters& counters)
        : scene_(scene), glide_(glide), most_(most), any_(any), options_(options), counters_(counters) {}

    bool run() {
        if (scene_.empty()) return false;
        double margin = 0;
        Path path;
        path.from = near<Scalar>(glide_.from, margin);
        path.to = near<Scalar>(glide_.to, margin);
        each_near(scene_, path, margin, limit(), counters_, [&](TriangleRef triangle) {
            if (!(any_ && found_)) test(triangle);
            return limit();
        });
        return found_;
    }
    [[nodiscard]] const GlideCandidate& best() const { return best_; }

  private:
    [[nodiscard]] double limit() const {
        if (!found_) return most_;
        return any_ ? -1 : std::min(best_.latest, most_);
    }

    void test(TriangleRef triangle) {
        if (masked(scene_, triangle, options_)) return;
        GlideCandidate candidate;
        candidate.triangle = triangle;
        candidate.corners = scene_.corners(triangle);
        static_cast<Filtered&>(candidate) = filter(glide_, candidate.corners, options_.sides);
        if (candidate.verdict == Verdict::miss || candidate.earliest > limit()) return;
        if (candidate.verdict == Verdict::doubtful && !is_hit_exactly(candidate)) return;
        candidate.number = scene_.number_of(triangle);
        candidate.face = scene_.face_of_number(candidate.number);
        if (found_ && !any_ && !comes_first(candidate)) return;
        if (candidate.latest > most_ && compare_fraction(glide_.path, candidate.corners, most_) > 0) return;
        if (options_.accept && !is_accepted(candidate)) return;
        best_ = candidate;
        found_ = true;
    }

    bool is_hit_exactly(GlideCandidate& candidate) {
        ++counters_.exact_decisions;
        candidate.decision = decide(glide_.path, candidate.corners, options_.sides);
        if (!candidate.decision.hit) return false;
        if (candidate.decision.at_start) {
            candidate.earliest = candidate.latest = 0;
        } else if (candidate.latest - candidate.earliest > 0x1p-20) {
            ++counters_.exact_values;
            const double fraction = measure_fraction(glide_.path, candidate.corners);
            const double slack = fraction * 0x1p-52 + 0x1p-1072;
            candidate.earliest = fraction - slack;
            candidate.latest = fraction + slack;
        }
        return true;
    }

    /// Before the best one so far, in the order of (fraction, face, triangle).
    [[nodiscard]] bool comes_first(const GlideCandidate& candidate) {
        if (candidate.earliest > best_.latest) return false;
        if (candidate.latest < best_.earliest) return true;
        int order = 0;
        if (candidate.corners != best_.corners &&
            !same_place(candidate.corners, candidate.decision, best_.corners, best_.decision) &&
            !in_one_axis_plane(candidate.corners, best_.corners)) {
            ++counters_.exact_orders;
            order = compare_fractions(glide_.path, candidate.corners, best_.corners);
        }
        if (order != 0) return order < 0;
        return candidate.face != best_.face ? candidate.face < best_.face : candidate.number < best_.number;
    }

    [[nodiscard]] bool is_accepted(const GlideCandidate& candidate) {
        const double fraction =
            candidate.decision.at_start ? 0 : std::min(measure_fraction(glide_.path, candidate.corners), 1.0);
        const MovingCandidate resting = at_rest(candidate);
        const Point w = values_at(seen_from_mesh(glide_), resting, fraction).weights;
        return options_.accept(Contact{candidate.face,
                                       candidate.number,
                                       candidate.decision.side,
                                       candidate.decision.feature,
                                       candidate.decision.feature_index,
                                       candidate.decision.at_start,
                                       fraction,
                                       {w[0], w[1], w[2]}});
    }

    const Scene<Scalar>& scene_;
    const Glide& glide_;
    double most_;
    bool any_;
    const QueryOptions& options_;
    QueryCounters& counters_;
    bool found_ = false;
    GlideCandidate best_;
};

/// The largest number that is not above the exact fraction. `fraction`: to the nearest double.
template <class Scalar>
Scalar time_of(const Glide& glide, const GlideCandidate& candidate, double& fraction, QueryCounters& counters) {
    fraction = candidate.earliest + (candidate.latest - candidate.earliest) / 2;
    if (candidate.decision.at_start) return 0;
    const Scalar early = rounded_down<Scalar>(candidate.earliest);
    if (early == rounded_down<Scalar>(candidate.latest)) return early;
    ++counters.exact_values;
    fraction = std::min(measure_fraction(glide.path, candidate.corners), 1.0);
    Scalar time = rounded_down<Scalar>(fraction);
    if (time > 0 && compare_fraction(glide.path, candidate.corners, static_cast<double>(time)) < 0)
        time = std::nextafter(time, Scalar{0});
    return time;
}

template <class Scalar>
Coordinates<Scalar> to_coordinates(const Point& x) {
    return {static_cast<Scalar>(x[0]), static_cast<Scalar>(x[1]), static_cast<Scalar>(x[2])};
}

/// The face's plane as it stands in the mesh, on the side that the point comes from.
Guard guard_of(const Glide& glide, const GlideCandidate& candidate) {
    Guard guard{candidate.corners[0], values_at(seen_from_mesh(glide), at_rest(candidate), 1).normal, candidate.number};
    if (candidate.decision.side == Sides::back)
        for (double& x : guard.normal) x = -x;
    return guard;
}

/// Looked for in the mesh's coordinates, and asked about as a place in the world at the end of the step.
template <class Scalar>
bool find_glide_place(const Scene<Scalar>& scene, const Glide& glide, const GlideCandidate& first,
                      const Point& position, const QueryOptions& options, QueryCounters& counters, Point& place) {
    const Point& off = glide.path.to_off;
    const auto ask = [&](const Point& to, Guard* stop) {
        place = rounded_to<Scalar>(moved_by(to, off, 1));
        if (!are_finite(place)) return false;
        Glide way = glide;
        way.path.to = place;
        way.to = difference(place, off);
        if (!are_finite(rounded_to<Scalar>(way.to.high))) return false;
        FirstGlide<Scalar> query(scene, way, std::numeric_limits<double>::infinity(), stop == nullptr, options,
                                 counters);
        if (!query.run()) return true;
        if (stop != nullptr) *stop = guard_of(way, query.best());
        return false;
    };
    double largest = 0;
    for (const double x : moved_by(position, off, 1)) largest = std::max(largest, std::abs(x));
    const double grain = std::max(scene.grain, grain_of<Scalar>(largest));
    return find_end_place(position, glide.from.high, guard_of(glide, first), grain, counters, ask);
}

}  // namespace

template <class Scalar>
bool set_glide(const Segment<Scalar>& way, const Translation<Scalar>& motion, Glide& glide) {
    glide.path = {to_point(way.from), to_point(motion.from), to_point(way.to), to_point(motion.to)};
    glide.from = difference(glide.path.from, glide.path.from_off);
    glide.to = difference(glide.path.to, glide.path.to_off);
    return are_finite(rounded_to<Scalar>(glide.from.high), rounded_to<Scalar>(glide.to.high));
}

template <class Scalar>
std::optional<SweepHit<Scalar>> sweep_glide(const Scene<Scalar>& scene, const Segment<Scalar>& way,
                                            const Translation<Scalar>& motion, const QueryOptions& options,
                                            QueryCounters& counters, bool& valid) {
    Glide glide;
    valid = set_glide(way, motion, glide);
    if (!valid) return std::nullopt;
    FirstGlide<Scalar> query(scene, glide, options.max_fraction, false, options, counters);
    if (!query.run()) return std::nullopt;
    const GlideCandidate& first = query.best();
    SweepHit<Scalar> hit{};
    double fraction = 0;
    hit.time = time_of<Scalar>(glide, first, fraction, counters);
    const MovingValues values = values_at(seen_from_mesh(glide), at_rest(first), fraction);
    Point motion_of_mesh{};
    Point position{};
    for (std::size_t k = 0; k < 3; ++k) {
        motion_of_mesh[k] = glide.path.to_off[k] - glide.path.from_off[k];
        position[k] = values.position[k] + (glide.path.from_off[k] + fraction * motion_of_mesh[k]);
    }
    hit.normal = to_coordinates<Scalar>(values.normal);
    hit.barycentric = to_coordinates<Scalar>(values.weights);
    hit.position = to_coordinates<Scalar>(position);
    hit.surface_motion = to_coordinates<Scalar>(motion_of_mesh);
    hit.face = first.face;
    hit.triangle = first.number;
    hit.side = first.decision.side;
    hit.feature = first.decision.feature;
    hit.feature_index = first.decision.feature_index;
    hit.at_start = first.decision.at_start;
    Point place{};
    hit.place_verified = find_glide_place(scene, glide, first, values.position, options, counters, place);
    hit.place = to_coordinates<Scalar>(place);
    return hit;
}

#define PIERCE_GLIDES(Scalar)                                                                             \
    template bool set_glide(const Segment<Scalar>&, const Translation<Scalar>&, Glide&);                  \
    template std::optional<SweepHit<Scalar>> sweep_glide(const Scene<Scalar>&, const Segment<Scalar>&,    \
                                                         const Translation<Scalar>&, const QueryOptions&, \
                                                         QueryCounters&, bool&)
PIERCE_GLIDES(float);
PIERCE_GLIDES(double);
#undef PIERCE_GLIDES

}  // namespace pierce::detail
