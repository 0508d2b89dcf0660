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
#include <world/collectors.h>

namespace pierce::detail {

/// The options of a query as one mesh understands them; `options` must live as long.
[[nodiscard]] inline QueryOptions options_in(const WorldOptions& options, MeshId mesh) {
    QueryOptions here;
    here.sides = options.sides;
    if (options.accept)
        here.accept = [accept = &options.accept, mesh](const Contact& contact) { return (*accept)(mesh, contact); };
    return here;
}

/// Calls `use(index, instance, limit)` for each mesh that counts and that a way may come to up to `limit`. It returns
/// what each_box asks for.
template <class Scalar, class Use>
void each_instance(const WorldScene<Scalar>& world, const Path& path, std::uint32_t mask, double limit,
                   QueryCounters& counters, Use&& use) {
    const BoxProbe probe(path, world.noise());
    each_box(world.tree, probe, limit, counters, [&](std::uint32_t index, double so_far) {
        const Instance<Scalar>& instance = world.instances[index];
        return (instance.layers & mask) != 0 ? use(index, instance, so_far) : so_far;
    });
}

/// The same with the way's image, for meshes where it is finite: `use(index, instance, local, limit)`.
template <class Scalar, class Use>
void each_image(const WorldScene<Scalar>& world, const Path& path, std::uint32_t mask, double limit,
                QueryCounters& counters, Use&& use) {
    each_instance(world, path, mask, limit, counters,
                  [&](std::uint32_t index, const Instance<Scalar>& instance, double so_far) {
                      Path local;
                      return set_local_path(instance, path, local) ? use(index, instance, local, so_far) : so_far;
                  });
}

/// The hit whose point is looked for.
struct OwnHit {
    std::uint32_t index;  ///< of the instance
    const Path& local;    ///< the path there
    const Candidate& candidate;
    const Shortlist* list;  ///< of that path; null: none was kept
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
        Stop unused;
        return !stopped(point, near, unused);
    }
    [[nodiscard]] bool stops(const Point& point, Corners& corners, Decision& decision) const {
        Stop stop;
        if (!stopped(point, true, stop)) return false;
        corners = stop.corners;
        decision = stop.decision;
        return true;
    }
    /// In the world: the last point that was clear.
    [[nodiscard]] const Point& chosen() const { return chosen_; }

  private:
    /// What is in the way, in the coordinates of the mesh that is hit: rounded where it is another's.
    struct Stop {
        Corners corners;
        Decision decision;
    };

    [[nodiscard]] bool stopped(const Point& point, bool near, Stop& stop) const {
        const Point there = instance_.still() ? point : rounded_image<Scalar>(out_of(instance_.placement, point));
        const Point image = image_of<Scalar>(instance_.placement, there);
        const bool stops =
            !are_finite(there, image) || is_stopped_in_own(image, near, stop) || is_stopped_in_others(there, stop);
        if (!stops) chosen_ = there;
        return stops;
    }

    [[nodiscard]] bool is_stopped_in_own(const Point& image, bool near, Stop& stop) const {
        const Scene<Scalar>& scene = *instance_.scene;
        const TriangleRef own = own_.candidate.triangle;
        if (!instance_.still() && !is_off_own_plane(image)) {
            stop = {scene.corners(own), own_.candidate.decision};
            return true;
        }
        const Path way{own_.local.from, image};
        const QueryOptions options = options_in(options_, world_.id_of(own_.index));
        const auto passed = [&](TriangleRef triangle) { return passed_(own_.index, triangle); };
        AnyHere any(instance_, options_.mask, passed, own);
        // The list holds what is within the mesh's own grain of the path.
        if (near && instance_.still() && own_.list != nullptr && own_.list->complete) {
            for (unsigned i = 0; i < own_.list->count && !any.found(); ++i)
                test_triangle<Certified>(scene, way, own_.list->triangles[i], options, counters_, any);
        } else {
            traverse<Certified>(scene, way, options, counters_, any);
        }
        if (any.found()) stop = {scene.corners(any.candidate().triangle), any.candidate().decision};
        return any.found();
    }

    [[nodiscard]] bool is_off_own_plane(const Point& image) const {
        using Far = Farness<TwoPairs>;
        if (Far(values_, half_grain_, TwoPairs::load_point(image.data())).tried() == Tried::far) return true;
        ++counters_.exact_sides;
        return is_far_enough(instance_.scene->corners(own_.candidate.triangle), own_.local.from, image,
                             instance_.grain / 2);
    }

    [[nodiscard]] bool is_stopped_in_others(const Point& there, Stop& stop) const {
        bool found = false;
        const auto look = [&](std::uint32_t index, const Instance<Scalar>& instance, const Path& local,
                              double) -> double {
            if (index == own_.index) return 1;
            const auto passed = [&](TriangleRef triangle) { return passed_(index, triangle); };
            AnyHere any(instance, options_.mask, passed);
            traverse<Certified>(*instance.scene, local, options_in(options_, world_.id_of(index)), counters_, any);
            if (!any.found()) return 1;
            found = true;
            stop = {instance.scene->corners(any.candidate().triangle), any.candidate().decision};
            for (Point& corner : stop.corners) {
                corner = out_of(instance.placement, corner);
                if (instance_.still()) continue;
                for (std::size_t k = 0; k < 3; ++k) corner[k] -= instance_.placement.translation[k];
                corner = turned_back(instance_.placement, corner);
            }
            return -1;
        };
        each_image(world_, Path{from_, there}, options_.mask, 1, counters_, look);
        return found;
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
