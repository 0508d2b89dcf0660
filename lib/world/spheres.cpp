// Balls in a world: each mesh is asked about the image of the center's way, with the radius as it is.
//
// Which boxes a ball may come to. Where the center's image is within the radius of a point x of the mesh, the center is
// within the radius, and what images may be off (placement.h), of Q x + t, a point of the mesh's box in the world: Q
// keeps lengths, and images are bounded by what Q would give, so nothing is asked of the radius but that boxes are
// taken for larger by it (box_walk.h).
//
// Which come first. An entry's time is a lower bound, that of one mesh earlier than it is reached by `Sphere::width`,
// 2^-21 at most for a sphere that moves. So boxes are of use up to that much after the earliest time so far.
#include <world/spheres.h>

#include <query/sphere_hits.h>
#include <query/sphere_place.h>
#include <world/ways.h>

namespace pierce::detail {

namespace {

constexpr double k_most_width = 0x1p-21 * (1 + 0x1p-50);

/// A ball as one mesh has it.
template <class Scalar>
struct BallInMesh {
    BallInMesh(const WorldScene<Scalar>& world, std::uint32_t at, const Path& local, double radius,
               const WorldOptions& options, QueryCounters& counters)
        : index(at),
          scene(*world.instances[at].scene),
          filter(world.instances[at], options.mask),
          here(options_in(options, world.id_of(at))),
          sphere(local, radius, sphere_reach(scene, local.from, radius)),
          query{scene, here, counters} {}
    BallInMesh(const BallInMesh&) = delete;
    BallInMesh& operator=(const BallInMesh&) = delete;

    /// Calls `use(triangle)`, as in each_near, for the triangles near the ball whose layers count.
    template <class Use>
    void each(double limit, Use&& use) const {
        each_near(scene, sphere.path, sphere.radius, limit, query.counters,
                  [&](TriangleRef triangle) { return filter.counts(triangle) ? use(triangle) : limit; });
    }

    std::uint32_t index;
    const Scene<Scalar>& scene;
    FaceFilter<Scalar> filter;
    QueryOptions here;
    Sphere sphere;
    SphereQuery<Scalar> query;
};

/// An entry, and the ball in that mesh.
struct EntryThere {
    std::uint32_t index = 0;
    SphereCandidate candidate;
    Sides side = Sides::front;
    double unit = 1;  ///< of `candidate`
    double reach = 0;
};

[[nodiscard]] bool comes_before(const EntryThere& x, const EntryThere& y) {
    const SphereCandidate& one = x.candidate;
    const SphereCandidate& other = y.candidate;
    if (x.index == y.index) return comes_before(one, other);
    if (one.time != other.time) return one.time < other.time;
    if (one.at_start != other.at_start) return one.at_start;
    // Units are powers of two.
    const double near = one.distance / x.unit;
    const double far = other.distance / y.unit;
    if (one.at_start && near != far) return near < far;
    return x.index < y.index;
}

/// The first entry of a ball on a way in all meshes, no later than `most`.
template <class Scalar>
bool first_entry(const WorldScene<Scalar>& world, const Path& path, double radius, double most,
                 const WorldOptions& options, QueryCounters& counters, EntryThere& best) {
    bool found = false;
    each_image(world, path, radius, options.mask, most + k_most_width, counters,
               [&](std::uint32_t index, const Instance<Scalar>&, const Path& local, double limit) {
                   if (local.from == local.to) return limit;
                   const BallInMesh<Scalar> ball(world, index, local, radius, options, counters);
                   FirstEntry<Scalar> first(ball.query, ball.sphere, most);
                   each_near(ball.scene, local, radius, first.limit(), counters, [&](TriangleRef triangle) {
                       if (ball.filter.counts(triangle)) first.test(triangle);
                       return first.limit();
                   });
                   if (!first.found()) return limit;
                   const Sides side = side_of(ball.scene.corners(first.best().triangle), first.best());
                   const EntryThere entry{index, first.best(), side, ball.sphere.unit,
                                          sphere_reach(ball.scene, local.from, radius)};
                   if (found && !comes_before(entry, best)) return limit;
                   found = true;
                   best = entry;
                   most = entry.candidate.time;
                   return std::min(limit, most + k_most_width);
               });
    return found;
}

/// An entry of a mesh as the world has it, in the units of `sphere`.
template <class Scalar>
[[nodiscard]] SphereCandidate in_world(const Instance<Scalar>& instance, const Sphere& sphere, double unit,
                                       const SphereCandidate& local) {
    SphereCandidate out = local;
    const double scale = sphere.unit / unit;
    out.distance *= scale;
    out.reach *= scale;
    out.center = times(out.time, sphere.way);
    out.nearest.point = times(scale, out.nearest.point);
    if (instance.placement.stand != Stand::turned) return out;
    out.nearest.point = turned(instance.placement, out.nearest.point);
    out.normal = turned(instance.placement, out.normal);
    return out;
}

/// What place_sphere() asks about other ways from the start.
template <class Scalar>
struct WorldSphereWays {
    using Number = Scalar;

    const WorldScene<Scalar>& world;
    const WorldOptions& options;
    QueryCounters& counters;
    const Sphere& sphere;
    double least_grain;
    double margin = 0;  ///< no list is kept

    [[nodiscard]] bool stops(const Point& to, bool, SphereCandidate& stop) const {
        EntryThere entry;
        if (!first_entry(world, Path{sphere.path.from, to}, sphere.radius, 1, options, counters, entry)) return false;
        stop = in_world(world.instances[entry.index], sphere, entry.unit, entry.candidate);
        return true;
    }
};

template <class Scalar>
[[nodiscard]] bool is_earlier(const WorldSphereHit<Scalar>& x, const WorldSphereHit<Scalar>& y) {
    if (x.hit.fraction != y.hit.fraction) return x.hit.fraction < y.hit.fraction;
    return x.mesh.index != y.mesh.index ? x.mesh.index < y.mesh.index : number_before(x.hit, y.hit);
}
template <class Scalar>
[[nodiscard]] bool is_deeper(const WorldSphereHit<Scalar>& x, const WorldSphereHit<Scalar>& y) {
    if (x.hit.overlap != y.hit.overlap) return x.hit.overlap > y.hit.overlap;
    return x.mesh.index != y.mesh.index ? x.mesh.index < y.mesh.index : number_before(x.hit, y.hit);
}

/// Keeps those contacts of a ball in one mesh that `test(triangle, candidate)` finds, up to `limit`.
template <class Scalar, class Test, class Hits>
void keep_contacts(const WorldScene<Scalar>& world, const BallInMesh<Scalar>& ball, const Path& path, double limit,
                   Test&& test, Hits& kept) {
    const Sphere sphere(path, ball.sphere.radius, sphere_reach(ball.scene, ball.sphere.path.from, ball.sphere.radius));
    ball.each(limit, [&](TriangleRef triangle) {
        SphereCandidate local;
        if (!test(triangle, local) || is_anothers(ball.query, local, test)) return limit;
        const SphereCandidate candidate = in_world(world.instances[ball.index], sphere, ball.sphere.unit, local);
        const Point center = plus(path.from, times(1 / sphere.unit, candidate.center));
        WorldSphereHit<Scalar> hit;
        report(sphere, candidate, side_of(ball.scene.corners(triangle), local), center, hit.hit);
        hit.mesh = world.id_of(ball.index);
        kept.add(hit);
        return limit;
    });
}

}  // namespace

template <class Scalar>
std::optional<WorldSphereHit<Scalar>> sweep_sphere(const WorldScene<Scalar>& world, const Segment<Scalar>& step,
                                                   Scalar radius, const WorldOptions& options,
                                                   QueryCounters& counters) {
    std::optional<WorldSphereHit<Scalar>> hit;
    const Path path = to_path(step);
    const auto r = static_cast<double>(radius);
    EntryThere first;
    if (!first_entry(world, path, r, std::min(options.max_fraction, 1.0), options, counters, first)) return hit;
    const Instance<Scalar>& instance = world.instances[first.index];
    const Sphere sphere(path, r, first.reach);
    const SphereCandidate entry = in_world(instance, sphere, first.unit, first.candidate);
    const double grain = instance.still() ? 0 : instance.grain;
    const WorldSphereWays<Scalar> ways{world, options, counters, sphere, grain};
    const Point center = place_sphere(ways, entry, counters.retreats);
    hit.emplace();
    report(sphere, entry, first.side, center, hit->hit);
    hit->mesh = world.id_of(first.index);
    return hit;
}

template <class Scalar>
std::size_t sphere_hits(const WorldScene<Scalar>& world, const Segment<Scalar>& step, Scalar radius,
                        std::span<WorldSphereHit<Scalar>> out, const WorldOptions& options, QueryCounters& counters) {
    const Path path = to_path(step);
    const double most = std::min(options.max_fraction, 1.0);
    Kept kept(out, is_earlier<Scalar>);
    each_image(world, path, static_cast<double>(radius), options.mask, most + k_most_width, counters,
               [&](std::uint32_t index, const Instance<Scalar>&, const Path& local, double limit) {
                   if (local.from == local.to) return limit;
                   const BallInMesh<Scalar> ball(world, index, local, static_cast<double>(radius), options, counters);
                   const auto test = [&](TriangleRef triangle, SphereCandidate& candidate) {
                       return ball.filter.counts(triangle) && ball.query.enters(ball.sphere, triangle, most, candidate);
                   };
                   keep_contacts(world, ball, path, most + ball.sphere.width, test, kept);
                   return limit;
               });
    return kept.sort();
}

template <class Scalar>
std::size_t sphere_contacts(const WorldScene<Scalar>& world, const Vec3<Scalar>& center, Scalar radius,
                            std::span<WorldSphereHit<Scalar>> out, const WorldOptions& options,
                            QueryCounters& counters) {
    const Path path{to_point(center), to_point(center)};
    Kept kept(out, is_deeper<Scalar>);
    each_image(world, path, static_cast<double>(radius), options.mask, 1, counters,
               [&](std::uint32_t index, const Instance<Scalar>&, const Path& local, double limit) {
                   const BallInMesh<Scalar> ball(world, index, local, static_cast<double>(radius), options, counters);
                   const auto test = [&](TriangleRef triangle, SphereCandidate& candidate) {
                       if (!ball.filter.counts(triangle) || !ball.query.touches(ball.sphere, triangle, candidate))
                           return false;
                       candidate.at_start = true;
                       return true;
                   };
                   keep_contacts(world, ball, path, 1, test, kept);
                   return limit;
               });
    return kept.sort();
}

#define PIERCE_SPHERES(Scalar)                                                                                     \
    template std::optional<WorldSphereHit<Scalar>> sweep_sphere(const WorldScene<Scalar>&, const Segment<Scalar>&, \
                                                                Scalar, const WorldOptions&, QueryCounters&);      \
    template std::size_t sphere_hits(const WorldScene<Scalar>&, const Segment<Scalar>&, Scalar,                    \
                                     std::span<WorldSphereHit<Scalar>>, const WorldOptions&, QueryCounters&);      \
    template std::size_t sphere_contacts(const WorldScene<Scalar>&, const Vec3<Scalar>&, Scalar,                   \
                                         std::span<WorldSphereHit<Scalar>>, const WorldOptions&, QueryCounters&)
PIERCE_SPHERES(float);
PIERCE_SPHERES(double);
#undef PIERCE_SPHERES

}  // namespace pierce::detail
