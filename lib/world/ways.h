// What place() asks about the ways from a hit's start to other points, in a world: of all its meshes, by the rule for
// images.
//
// place() looks for a point in the coordinates of the mesh that is hit. The point that is answered is that one's place
// in the world, rounded, and what is asked about is the way to that: in each mesh the way between the images of start
// and point. Of a mesh that stands still all three are the same point; otherwise the image of what was rounded lies
// some rounding off the point that was looked for, so its side of the hit's own plane is asked about as well.
#pragma once

#include <query/place.h>
#include <query/traverse.h>
#include <world/first_search.h>

namespace pierce::detail {

/// Calls `use(index, instance, limit)` for each mesh that counts and that a way, or a ball on it, may come to up to
/// `limit`. It returns what each_box asks for.
template <class Scalar, class Use>
void each_instance(const WorldScene<Scalar>& world, const Path& path, double radius, std::uint32_t mask, double limit,
                   QueryCounters& counters, Use&& use) {
    const BoxProbe probe(path, world.noise(), radius);
    each_box(world.tree, probe, limit, counters, [&](std::uint32_t index, double so_far) {
        const Instance<Scalar>& instance = world.instances[index];
        return (instance.layers & mask) != 0 ? use(index, instance, so_far) : so_far;
    });
}

/// The same with the way's image, for meshes where it is finite: `use(index, instance, local, limit)`.
template <class Scalar, class Use>
void each_image(const WorldScene<Scalar>& world, const Path& path, double radius, std::uint32_t mask, double limit,
                QueryCounters& counters, Use&& use) {
    each_instance(world, path, radius, mask, limit, counters,
                  [&](std::uint32_t index, const Instance<Scalar>& instance, double so_far) {
                      Path local;
                      return set_local_path(instance, path, local) ? use(index, instance, local, so_far) : so_far;
                  });
}
template <class Scalar, class Use>
void each_image(const WorldScene<Scalar>& world, const Path& path, std::uint32_t mask, double limit,
                QueryCounters& counters, Use&& use) {
    each_image(world, path, 0, mask, limit, counters, std::forward<Use>(use));
}

/// The hit whose point is looked for.
struct OwnHit {
    std::uint32_t index;  ///< of the instance
    const Path& local;    ///< the path there
    const Candidate& candidate;
    const WorldShortlist* list;  ///< of the world's path; null: none was kept
};

/// `passed(index, triangle)` says which triangles are hit strictly before the hit, and so don't count.
template <class Scalar, class Passed>
class WorldWays {
  public:
    // Nothing is kept for many near places: a world asks about each of them anew (nearby.h says what that costs).
    struct Nearby {
        explicit Nearby(const WorldWays&) {}
    };

    /// `values`: of the hit, as certify() left them.
    WorldWays(const WorldScene<Scalar>& world, const Path& path, const OwnHit& own, const Values& values,
              const Passed& passed, const WorldOptions& options, QueryCounters& counters)
        : world_(world),
          instance_(world.instances[own.index]),
          from_(path.from),
          own_(own),
          values_(values),
          half_grain_(place_of(own.candidate.measured, instance_.grain / 2, own.candidate.decision.side)),
          passed_(passed),
          options_(options),
          counters_(counters) {}

    [[nodiscard]] bool hides(const Point&) const { return false; }
    [[nodiscard]] bool clear(const Point& point, bool near) const {
        Point there;
        if (!leads_to(point, there)) return false;
        bool found = false;
        each_way(Path{from_, there}, near, [&](std::uint32_t index, const Path& way, List few, double) {
            const auto passed = [&](TriangleRef triangle) { return is_known(index, triangle); };
            AnyHere any(world_.instances[index], options_.mask, passed);
            test(index, way, options_in(options_, world_.id_of(index)), few, any);
            found = any.found();
            return found ? -1.0 : 1.0;
        });
        if (!found) chosen_ = there;
        return !found;
    }
    /// In the coordinates of the mesh that is hit: rounded where what stops is another's. The first that stops, which
    /// does not depend on the order of the boxes.
    [[nodiscard]] bool stops(const Point& point, Corners& corners, Decision& decision) const {
        Point there;
        corners = instance_.scene->corners(own_.candidate.triangle);
        decision = own_.candidate.decision;
        if (!leads_to(point, there)) return true;
        const Path path{from_, there};
        std::uint32_t now = 0;
        const auto known = [&](TriangleRef triangle) { return is_known(now, triangle); };
        FirstSearch<Scalar, decltype(known)> search;
        each_way(path, true, [&](std::uint32_t index, const Path& way, List few, double limit) {
            now = index;
            auto& here = search.next(world_, index, way, options_, limit, known, counters_);
            test(index, here.local, here.options, few, here.collector);
            return search.take(world_, path, limit, counters_);
        });
        if (!search.found()) {
            chosen_ = there;
            return false;
        }
        const Found first = search.first().found();
        corners = in_own(first.index, world_.instances[first.index].scene->corners(first.triangle));
        decision = first.filtered.decision;
        return true;
    }
    /// In the world: the last point that was clear.
    [[nodiscard]] const Point& chosen() const { return chosen_; }

  private:
    /// The world's point for one that is looked for. False: it is none, or its image is not off the hit's own plane.
    [[nodiscard]] bool leads_to(const Point& point, Point& there) const {
        there = instance_.still() ? point : rounded_image<Scalar>(out_of(instance_.placement, point));
        const Point image = image_of<Scalar>(instance_.placement, there);
        return are_finite(there, image) && (instance_.still() || is_off_own_plane(image));
    }
    [[nodiscard]] bool is_known(std::uint32_t index, TriangleRef triangle) const {
        return (index == own_.index && triangle == own_.candidate.triangle) || passed_(index, triangle);
    }
    /// Those of one mesh; empty: all of its triangles are asked about.
    using List = std::span<const WorldShortlist::Entry>;

    /// Calls `use(index, image, few, limit)` for the meshes that a way may come to; it returns the limit.
    template <class Use>
    void each_way(const Path& path, bool near, Use&& use) const {
        if (!near || own_.list == nullptr || !own_.list->complete)
            return each_image(world_, path, options_.mask, 1, counters_,
                              [&](std::uint32_t index, const Instance<Scalar>&, const Path& way, double limit) {
                                  return use(index, way, List{}, limit);
                              });
        const List all = List(own_.list->entries).first(own_.list->count);
        double limit = 1;
        for (std::size_t i = 0, end = 0; i < all.size() && limit >= 0; i = end) {
            const std::uint32_t index = all[i].index;
            while (end < all.size() && all[end].index == index) ++end;
            Path way;
            if (set_local_path(world_.instances[index], path, way))
                limit = use(index, way, all.subspan(i, end - i), limit);
        }
    }
    template <class Collector>
    void test(std::uint32_t index, const Path& way, const QueryOptions& options, List few, Collector& collector) const {
        const Scene<Scalar>& scene = *world_.instances[index].scene;
        if (few.empty()) return traverse<Certified>(scene, way, options, counters_, collector);
        for (const auto& [mesh, triangle] : few)
            test_triangle<Certified>(scene, way, triangle, options, counters_, collector);
    }
    [[nodiscard]] Corners in_own(std::uint32_t index, Corners corners) const {
        if (index == own_.index) return corners;
        for (Point& corner : corners) {
            corner = out_of(world_.instances[index].placement, corner);
            if (instance_.still()) continue;
            for (std::size_t k = 0; k < 3; ++k) corner[k] -= instance_.placement.translation[k];
            corner = turned_back(instance_.placement, corner);
        }
        return corners;
    }

    [[nodiscard]] bool is_off_own_plane(const Point& image) const {
        using Far = Farness<TwoPairs>;
        if (Far(values_, half_grain_, TwoPairs::load_point(image.data())).tried() == Tried::far) return true;
        ++counters_.exact_sides;
        return is_far_enough(instance_.scene->corners(own_.candidate.triangle), own_.local.from, image,
                             instance_.grain / 2);
    }

    const WorldScene<Scalar>& world_;
    const Instance<Scalar>& instance_;
    const Point from_;
    const OwnHit& own_;
    const Values& values_;
    PlaceOf half_grain_;
    const Passed& passed_;
    const WorldOptions& options_;
    QueryCounters& counters_;
    mutable Point chosen_{};
};

}  // namespace pierce::detail
