// The queries: each walks through the boxes of the meshes, and asks each mesh about the image of the way.
#include <world/engine.h>

#include <query/counting.h>
#include <query/engine.h>
#include <query/traverse.h>
#include <world/answer.h>
#include <world/way_path.h>

namespace pierce::detail {

namespace {

/// The first hit of one mesh.
template <class Scalar>
struct Searched {
    Searched(const WorldScene<Scalar>& world, std::uint32_t at, const Path& image, const WorldOptions& options,
             double limit, QueryCounters& counters)
        : index(at),
          local(image),
          collector(world.instances[at], options.mask, local, limit, counters),
          here(options_in(options, world.id_of(at))) {}
    Searched(const Searched&) = delete;
    Searched& operator=(const Searched&) = delete;

    [[nodiscard]] Found found() const { return {index, collector.best()}; }

    std::uint32_t index;
    Path local;
    FirstHere<Scalar> collector;
    QueryOptions here;
};

}  // namespace

template <class Scalar, class Way>
std::optional<WorldHit<Scalar>> first_hit(const WorldScene<Scalar>& world, const Way& way, const WorldOptions& options,
                                          QueryCounters& counters) {
    std::optional<WorldHit<Scalar>> hit;
    Path path;
    if (!set_path(world, way, options.max_fraction, path)) return hit;
    std::array<std::optional<Searched<Scalar>>, 2> rooms;
    std::size_t best = 0;
    bool found = false;
    each_image(world, path, options.mask, std::min(1.0, path.most), counters,
               [&](std::uint32_t index, const Instance<Scalar>& instance, const Path& local, double limit) {
                   Searched<Scalar>& search = rooms[1 - best].emplace(world, index, local, options, limit, counters);
                   traverse<Certified>(*instance.scene, search.local, search.here, counters, search.collector);
                   if (!search.collector.found()) return limit;
                   if (found && !comes_before(world, path, search.found(), rooms[best]->found(), counters))
                       return limit;
                   found = true;
                   best = 1 - best;
                   return std::min(limit, search.collector.best().latest);
               });
    if (!found) return hit;
    const Searched<Scalar>& first = *rooms[best];
    const auto none = [](std::uint32_t, TriangleRef) { return false; };
    answer(world, path, {first.index, first.local, first.collector.best(), &first.collector.list()}, none, options,
           counters, hit.emplace());
    return hit;
}

template <class Scalar, class Way>
bool any_hit(const WorldScene<Scalar>& world, const Way& way, const WorldOptions& options, QueryCounters& counters) {
    Path path;
    if (!set_path(world, way, options.max_fraction, path)) return false;
    bool found = false;
    each_image(world, path, options.mask, std::min(1.0, path.most), counters,
               [&](std::uint32_t index, const Instance<Scalar>& instance, const Path& local, double limit) {
                   const auto none = [](TriangleRef) { return false; };
                   AnyHere any(instance, options.mask, none);
                   traverse<Certified>(*instance.scene, local, options_in(options, world.id_of(index)), counters, any);
                   found = any.found();
                   return found ? -1 : limit;
               });
    return found;
}

template <class Scalar, class Way>
std::size_t all_hits(const WorldScene<Scalar>& world, const Way& way, std::span<WorldHit<Scalar>> out,
                     const WorldOptions& options, QueryCounters& counters) {
    Path path;
    if (!set_path(world, way, options.max_fraction, path)) return 0;
    Ranking<Scalar> ranking(world, path, out, counters);
    each_image(world, path, options.mask, std::min(1.0, path.most), counters,
               [&](std::uint32_t index, const Instance<Scalar>& instance, const Path& local, double limit) {
                   const auto add = [&](const Candidate& candidate) { ranking.add(index, local, candidate); };
                   EachHere each(instance, options.mask, add);
                   traverse<Certified>(*instance.scene, local, options_in(options, world.id_of(index)), counters, each);
                   return limit;
               });
    ranking.sort();
    answer_all(world, path, ranking, options, counters);
    return ranking.total();
}

template <class Scalar, class Way>
int crossings(const WorldScene<Scalar>& world, const Way& way, std::uint32_t mask, QueryCounters& counters) {
    Path path;
    if (!set_path(world, way, std::numeric_limits<double>::infinity(), path)) return 0;
    int sum = 0;
    each_image(world, path, mask, 1, counters,
               [&](std::uint32_t, const Instance<Scalar>& instance, const Path& local, double limit) {
                   sum += crossings_of(*instance.scene, local, counters);
                   return limit;
               });
    return sum;
}

template <class Scalar>
int winding_number(const WorldScene<Scalar>& world, const Vec3<Scalar>& at, std::uint32_t mask,
                   QueryCounters& counters) {
    const Point point = to_point(at);
    int sum = 0;
    each_instance(world, Path{point, point}, mask, 1, counters,
                  [&](std::uint32_t, const Instance<Scalar>& instance, double limit) {
                      const Point image = image_of<Scalar>(instance.placement, point);
                      if (are_finite(image)) sum += winding_number(*instance.scene, to_vector<Scalar>(image), counters);
                      return limit;
                  });
    return sum;
}

#define PIERCE_QUERIES(Scalar, Way)                                                                            \
    template std::optional<WorldHit<Scalar>> first_hit(const WorldScene<Scalar>&, const Way<Scalar>&,          \
                                                       const WorldOptions&, QueryCounters&);                   \
    template bool any_hit(const WorldScene<Scalar>&, const Way<Scalar>&, const WorldOptions&, QueryCounters&); \
    template std::size_t all_hits(const WorldScene<Scalar>&, const Way<Scalar>&, std::span<WorldHit<Scalar>>,  \
                                  const WorldOptions&, QueryCounters&);                                        \
    template int crossings(const WorldScene<Scalar>&, const Way<Scalar>&, std::uint32_t, QueryCounters&)
PIERCE_QUERIES(float, Segment);
PIERCE_QUERIES(float, Ray);
PIERCE_QUERIES(double, Segment);
PIERCE_QUERIES(double, Ray);
#undef PIERCE_QUERIES
template int winding_number(const WorldScene<float>&, const Vec3<float>&, std::uint32_t, QueryCounters&);
template int winding_number(const WorldScene<double>&, const Vec3<double>&, std::uint32_t, QueryCounters&);

}  // namespace pierce::detail
