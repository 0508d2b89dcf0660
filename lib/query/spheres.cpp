// Queries about spheres: the first triangle that a swept one enters, all of them, and those that touch one at rest.
#include <query/spheres.h>

#include <algorithm>

#include <query/sphere_sweep.h>

namespace pierce::detail {

namespace {

template <class Scalar>
void report(const Sphere& sphere, const Corners& corners, const SphereCandidate& candidate, const Point& center,
            SphereHit<Scalar>& hit) {
    const auto rounded = [](const Point& p) {
        return Coordinates<Scalar>(static_cast<Scalar>(p[0]), static_cast<Scalar>(p[1]), static_cast<Scalar>(p[2]));
    };
    hit = {};
    hit.fraction = rounded_down<Scalar>(candidate.time);
    hit.center = rounded(center);
    hit.contact = rounded(plus(sphere.path.from, times(1 / sphere.unit, candidate.nearest.point)));
    hit.normal = rounded(candidate.normal);
    if (candidate.overlaps) {
        const double depth = sphere.radius - candidate.distance / sphere.unit;
        hit.overlap = std::max(static_cast<Scalar>(depth), std::numeric_limits<Scalar>::denorm_min());
    }
    hit.face = candidate.face;
    hit.triangle = candidate.number;
    hit.side = side_of(corners, candidate);
    hit.feature = candidate.nearest.feature;
    hit.feature_index = static_cast<std::uint8_t>(candidate.nearest.index);
    hit.at_start = candidate.at_start;
}

/// Whether another triangle is met before this one that has what is touched of it: then both are one contact, the other
/// one's. Faces come before edges and corners, so that those are left out that lie on faces which are hit already; then
/// the earlier one. As that is an order, one of those that are taken together is always left.
template <class Scalar, class Test>
[[nodiscard]] bool is_anothers(const SphereQuery<Scalar>& query, const SphereCandidate& candidate, Test&& test) {
    const auto& scene = query.scene;
    const Corners corners = scene.corners(candidate.triangle);
    const Feature feature = candidate.nearest.feature;
    const std::size_t first = candidate.nearest.index;
    const std::size_t count = feature == Feature::face ? 3 : feature == Feature::edge ? 2 : 1;
    bool found = false;
    const Path path{corners[first], corners[first]};
    each_near(scene, path, 0, 1, query.counters, [&](TriangleRef triangle) {
        if (found || triangle == candidate.triangle) return found ? -1.0 : 1.0;
        const Corners others = scene.corners(triangle);
        for (std::size_t k = 0; k < count; ++k)
            if (std::find(others.begin(), others.end(), corners[(first + k) % 3]) == others.end()) return 1.0;
        SphereCandidate other;
        if (!test(triangle, other)) return 1.0;
        const bool is_face = other.nearest.feature == Feature::face;
        found = is_face != (feature == Feature::face) ? is_face : comes_before(other, candidate);
        return found ? -1.0 : 1.0;
    });
    return found;
}

/// The first hits of `out.size()` in an order, of all that come; as a heap, the last of them on top.
template <class Scalar, class Before>
class Kept {
  public:
    Kept(std::span<SphereHit<Scalar>> out, Before before) : out_(out), before_(before) {}
    void add(const SphereHit<Scalar>& hit) {
        ++total_;
        if (out_.empty()) return;
        if (kept_ == out_.size()) {
            if (!before_(hit, out_[0])) return;
            std::pop_heap(out_.begin(), out_.end(), before_);
            --kept_;
        }
        out_[kept_++] = hit;
        std::push_heap(out_.begin(), end(), before_);
    }
    std::size_t sort() {
        std::sort_heap(out_.begin(), end(), before_);
        return total_;
    }

  private:
    auto end() const { return out_.begin() + static_cast<std::ptrdiff_t>(kept_); }

    std::span<SphereHit<Scalar>> out_;
    Before before_;
    std::size_t kept_ = 0;
    std::size_t total_ = 0;
};

template <class Scalar>
[[nodiscard]] bool number_before(const SphereHit<Scalar>& x, const SphereHit<Scalar>& y) {
    return x.face != y.face ? x.face < y.face : x.triangle < y.triangle;
}

}  // namespace

template <class Scalar>
std::optional<SphereHit<Scalar>> sweep_sphere(const Scene<Scalar>& scene, const Segment<Scalar>& step, Scalar radius,
                                              const QueryOptions& options, QueryCounters& counters) {
    std::optional<SphereHit<Scalar>> hit;
    const Path path = to_path(step);
    if (scene.empty() || path.from == path.to) return hit;
    const SphereSweep<Scalar> sweep(scene, path, static_cast<double>(radius), std::min(options.max_fraction, 1.0),
                                    options, counters);
    if (!sweep.found()) return hit;
    const SphereCandidate& first = sweep.first();
    report(sweep.sphere(), scene.corners(first.triangle), first, sweep.place(), hit.emplace());
    return hit;
}

template <class Scalar>
std::size_t sphere_hits(const Scene<Scalar>& scene, const Segment<Scalar>& step, Scalar radius,
                        std::span<SphereHit<Scalar>> out, const QueryOptions& options, QueryCounters& counters) {
    const Path path = to_path(step);
    if (scene.empty() || path.from == path.to) return 0;
    const auto r = static_cast<double>(radius);
    const Sphere sphere(path, r, sphere_reach(scene, path.from, r));
    const SphereQuery<Scalar> query{scene, options, counters};
    const double most = std::min(options.max_fraction, 1.0);
    Kept kept(out, [](const SphereHit<Scalar>& x, const SphereHit<Scalar>& y) {
        return x.fraction != y.fraction ? x.fraction < y.fraction : number_before(x, y);
    });
    const auto test = [&](TriangleRef triangle, SphereCandidate& candidate) {
        return query.enters(sphere, triangle, most, candidate);
    };
    const double limit = most + sphere.width;
    each_near(scene, path, r, limit, counters, [&](TriangleRef triangle) {
        SphereCandidate candidate;
        if (!test(triangle, candidate) || is_anothers(query, candidate, test)) return limit;
        SphereHit<Scalar> hit;
        const Point center = plus(path.from, times(1 / sphere.unit, candidate.center));
        report(sphere, scene.corners(triangle), candidate, center, hit);
        kept.add(hit);
        return limit;
    });
    return kept.sort();
}

template <class Scalar>
std::size_t sphere_contacts(const Scene<Scalar>& scene, const Vec3<Scalar>& center, Scalar radius,
                            std::span<SphereHit<Scalar>> out, const QueryOptions& options, QueryCounters& counters) {
    if (scene.empty()) return 0;
    const Point at = to_point(center);
    const Path path{at, at};
    const auto r = static_cast<double>(radius);
    const Sphere sphere(path, r, sphere_reach(scene, at, r));
    const SphereQuery<Scalar> query{scene, options, counters};
    Kept kept(out, [](const SphereHit<Scalar>& x, const SphereHit<Scalar>& y) {
        return x.overlap != y.overlap ? x.overlap > y.overlap : number_before(x, y);
    });
    // The nearest first, of those that share what is touched.
    const auto test = [&](TriangleRef triangle, SphereCandidate& candidate) {
        if (!query.touches(sphere, triangle, candidate)) return false;
        candidate.at_start = true;
        return true;
    };
    each_near(scene, path, r, 1, counters, [&](TriangleRef triangle) {
        SphereCandidate candidate;
        if (!test(triangle, candidate) || is_anothers(query, candidate, test)) return 1.0;
        SphereHit<Scalar> hit;
        report(sphere, scene.corners(triangle), candidate, at, hit);
        kept.add(hit);
        return 1.0;
    });
    return kept.sort();
}

#define PIERCE_SPHERES(Scalar)                                                                                   \
    template std::optional<SphereHit<Scalar>> sweep_sphere(const Scene<Scalar>&, const Segment<Scalar>&, Scalar, \
                                                           const QueryOptions&, QueryCounters&);                 \
    template std::size_t sphere_hits(const Scene<Scalar>&, const Segment<Scalar>&, Scalar,                       \
                                     std::span<SphereHit<Scalar>>, const QueryOptions&, QueryCounters&);         \
    template std::size_t sphere_contacts(const Scene<Scalar>&, const Vec3<Scalar>&, Scalar,                      \
                                         std::span<SphereHit<Scalar>>, const QueryOptions&, QueryCounters&)
PIERCE_SPHERES(float);
PIERCE_SPHERES(double);
#undef PIERCE_SPHERES

}  // namespace pierce::detail
