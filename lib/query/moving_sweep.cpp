// The first contact among those of all triangles that the tree leaves.
//
// A triangle is left out before it is decided where all of its corners are on one side of the point along an axis, at
// both ends of the step: the difference of two coordinates is linear in time, so it keeps its sign in between, and the
// point is never in the triangle's box. That takes comparisons only, which are exact.
#include <query/moving_sweep.h>

#include <algorithm>
#include <cmath>

#include <query/broadphase.h>
#include <query/grain.h>
#include <query/ways.h>

namespace pierce::detail {

namespace {

/// Bits of the triangles of a cluster that are not on one side of the point.
template <class Scalar>
unsigned lanes_around(const Scalar* before, const Scalar* after, unsigned count, const Scalar* from, const Scalar* to) {
    unsigned aside = 0;
    for (unsigned k = 0; k < 3; ++k)
        for (unsigned i = 0; i < count; ++i) {
            unsigned below = 1;
            unsigned above = 1;
            for (unsigned corner = 0; corner < 3; ++corner) {
                const Scalar x = before[(3 * corner + k) * count + i];
                const Scalar y = after[(3 * corner + k) * count + i];
                below &= static_cast<unsigned>(x < from[k]) & static_cast<unsigned>(y < to[k]);
                above &= static_cast<unsigned>(x > from[k]) & static_cast<unsigned>(y > to[k]);
            }
            aside |= (below | above) << i;
        }
    return ~aside & ((1U << count) - 1);
}

/// One query under way.
template <class Scalar>
class FirstContact {
  public:
    FirstContact(const MovingScene<Scalar>& scene, const MovingPoint& point, const QueryOptions& options, bool any,
                 QueryCounters& counters, MovingCandidate& best)
        : scene_(scene), point_(point), options_(options), any_(any), counters_(counters), best_(best) {
        for (std::size_t k = 0; k < 3; ++k) {
            from_[k] = static_cast<Scalar>(point.at[0][k]);
            to_[k] = static_cast<Scalar>(point.at[1][k]);
        }
    }

    bool run() {
        if (scene_.empty()) return false;
        if (scene_.without_tree) {
            for (const ClusterHome& home : scene_.layout->shape.clusters)
                if (test(home.ref) < 0) break;
            return found_;
        }
        const ScalarKernels<Scalar>& kernels = scene_.scene->backend->template of<Scalar>();
        if (!kernels.set_probe(scene_.frame, point_.at[0].data(), point_.at[1].data(), false, false, false,
                               scene_.tree.short_way, probe_))
            return false;
        // Nothing is refused by what the triangles are at one end (cluster_test.h: each bound is infinite).
        probe_.floor = std::numeric_limits<float>::infinity();
        const float limit = parameter(probe_, std::min(1.0, options_.max_fraction));
        if (limit < 0) return false;
        const Visit visit = [](void* self, std::uint32_t cluster, unsigned) {
            auto& query = *static_cast<FirstContact*>(self);
            return parameter(query.probe_, query.test(cluster));
        };
        kernels.traverse(scene_.tree.view(), scene_.ends[0]->clusters.records.data(), probe_, limit, visit, this);
        counters_.nodes += probe_.nodes;
        counters_.clusters += probe_.clusters;
        return found_;
    }

  private:
    /// Returns the time up to which contacts are of use.
    double test(ClusterRef cluster) {
        if (cluster != scene_.layout->empty) {
            unsigned lanes =
                lanes_around(scene_.record(0, cluster), scene_.record(1, cluster), count_of(cluster), from_, to_);
            for (unsigned lane = 0; lanes >> lane != 0 && !(any_ && found_); ++lane)
                if ((lanes >> lane & 1) != 0) test(cluster, lane);
        }
        if (!found_) return std::min(1.0, options_.max_fraction);
        return any_ ? -1 : std::min(best_.impact.latest, options_.max_fraction);
    }

    void test(ClusterRef cluster, unsigned lane) {
        MovingCandidate candidate;
        candidate.number = scene_.ends[0]->clusters.triangle(cluster, lane);
        candidate.face = scene_.scene->face_of_number(candidate.number);
        const auto& mask = options_.face_mask;
        if (!mask.empty() && (candidate.face >= mask.size() || mask[candidate.face] == 0)) return;
        ++counters_.triangles;
        for (std::size_t end = 0; end < 2; ++end)
            candidate.triangle.at[end] = scene_.ends[end]->clusters.corners(cluster, lane);
        candidate.impact = strikes(point_, candidate.triangle, options_.sides);
        const Impact& impact = candidate.impact;
        if (!impact.hit || impact.earliest > options_.max_fraction) return;
        if (found_ && !any_ && !comes_first(candidate)) return;
        if (impact.latest > options_.max_fraction &&
            compare_time(point_, rule_of(options_.sides), candidate.triangle, impact, options_.max_fraction) > 0)
            return;
        if (options_.accept && !is_accepted(candidate)) return;
        best_ = candidate;
        found_ = true;
    }

    /// Before the best one so far, in the order of (time, face, triangle).
    [[nodiscard]] bool comes_first(const MovingCandidate& candidate) {
        if (candidate.impact.earliest > best_.impact.latest) return false;
        if (candidate.impact.latest < best_.impact.earliest) return true;
        ++counters_.exact_orders;
        const int order = compare_impacts(point_, rule_of(options_.sides), candidate.triangle, candidate.impact,
                                          best_.triangle, best_.impact);
        if (order != 0) return order < 0;
        return candidate.face != best_.face ? candidate.face < best_.face : candidate.number < best_.number;
    }

    [[nodiscard]] bool is_accepted(const MovingCandidate& candidate) const {
        const MovingValues values = values_of(point_, options_.sides, candidate);
        const Impact& impact = candidate.impact;
        const Point& w = values.weights;
        return options_.accept(Contact{candidate.face,
                                       candidate.number,
                                       impact.side,
                                       impact.feature,
                                       impact.feature_index,
                                       impact.at_start,
                                       values.time,
                                       {w[0], w[1], w[2]}});
    }

    const MovingScene<Scalar>& scene_;
    const MovingPoint& point_;
    const QueryOptions& options_;
    bool any_;
    QueryCounters& counters_;
    MovingCandidate& best_;
    bool found_ = false;
    Scalar from_[3];
    Scalar to_[3];
    Probe<Scalar> probe_;
};

template <class Scalar>
Coordinates<Scalar> to_coordinates(const Point& x) {
    return {static_cast<Scalar>(x[0]), static_cast<Scalar>(x[1]), static_cast<Scalar>(x[2])};
}

}  // namespace

MovingPoint to_moving(const Point& from, const Point& to) { return {{from, to}}; }

template <class Scalar>
bool first_contact(const MovingScene<Scalar>& scene, const MovingPoint& point, const QueryOptions& options, bool any,
                   QueryCounters& counters, MovingCandidate& best) {
    return FirstContact<Scalar>(scene, point, options, any, counters, best).run();
}

template <class Scalar>
std::optional<SweepHit<Scalar>> sweep(const MovingScene<Scalar>& scene, const Segment<Scalar>& way,
                                      const QueryOptions& options, QueryCounters& counters) {
    const MovingPoint point = to_moving(to_point(way.from), to_point(way.to));
    MovingCandidate first;
    if (!first_contact(scene, point, options, false, counters, first)) return std::nullopt;
    const MovingValues values = values_of(point, options.sides, first);
    SweepHit<Scalar> hit{};
    Point place;
    hit.place_verified = find_place(scene, point, first, values, options, counters, place);
    hit.place = to_coordinates<Scalar>(place);
    hit.time = rounded_down<Scalar>(values.time);
    hit.position = to_coordinates<Scalar>(values.position);
    hit.normal = to_coordinates<Scalar>(values.normal);
    hit.barycentric = to_coordinates<Scalar>(values.weights);
    hit.surface_motion = to_coordinates<Scalar>(values.motion);
    hit.face = first.face;
    hit.triangle = first.number;
    hit.side = first.impact.side;
    hit.feature = first.impact.feature;
    hit.feature_index = first.impact.feature_index;
    hit.at_start = first.impact.at_start;
    return hit;
}

template <class Scalar>
bool any_sweep(const MovingScene<Scalar>& scene, const Segment<Scalar>& way, const QueryOptions& options,
               QueryCounters& counters) {
    const MovingPoint point = to_moving(to_point(way.from), to_point(way.to));
    MovingCandidate first;
    return first_contact(scene, point, options, true, counters, first);
}

#define PIERCE_SWEEPS(Scalar)                                                                              \
    template bool first_contact(const MovingScene<Scalar>&, const MovingPoint&, const QueryOptions&, bool, \
                                QueryCounters&, MovingCandidate&);                                         \
    template std::optional<SweepHit<Scalar>> sweep(const MovingScene<Scalar>&, const Segment<Scalar>&,     \
                                                   const QueryOptions&, QueryCounters&);                   \
    template bool any_sweep(const MovingScene<Scalar>&, const Segment<Scalar>&, const QueryOptions&, QueryCounters&)
PIERCE_SWEEPS(float);
PIERCE_SWEEPS(double);
#undef PIERCE_SWEEPS

}  // namespace pierce::detail
