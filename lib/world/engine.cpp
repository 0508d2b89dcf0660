// The queries: each walks through the boxes of the meshes, and asks each mesh about the image of the way.
#include <world/engine.h>

#include <query/counting.h>
#include <query/traverse.h>
#include <world/answer.h>
#include <world/first_search.h>
#include <world/near.h>
#include <world/way_path.h>

namespace pierce::detail {

template <class Scalar, class Way>
std::optional<WorldHit<Scalar>> first_hit(const WorldScene<Scalar>& world, const Way& way, const WorldOptions& options,
                                          QueryCounters& counters) {
    std::optional<WorldHit<Scalar>> hit;
    Path path;
    if (!set_path(world, way, options.max_fraction, path)) return hit;
    const auto known = [](TriangleRef) { return false; };
    FirstSearch<Scalar, decltype(known)> search;
    const double near = near_of(world, path);
    WorldShortlist list;
    each_image(world, path, 2 * near, options.mask, std::min(1.0, path.most), counters,
               [&](std::uint32_t index, const Instance<Scalar>& instance, const Path& image, double limit) {
                   auto& here = search.next(world, index, image, options, limit, known, counters);
                   traverse_near(*instance.scene, here.local, near, here.options, counters, here.collector, index,
                                 list);
                   return search.take(world, path, limit, counters);
               });
    if (!search.found()) return hit;
    const auto& first = search.first();
    const auto none = [](std::uint32_t, TriangleRef) { return false; };
    answer(world, path, {first.index, first.local, first.collector.best(), &list}, none, options, counters,
           hit.emplace());
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

}  // namespace pierce::detail
