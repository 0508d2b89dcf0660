// One sweep of a sphere: the triangle that it enters first, and where it is stopped.
#pragma once

#include <query/sphere_place.h>

namespace pierce::detail {

template <class Scalar>
class SphereSweep {
  public:
    /// The path has a length, the scene has triangles.
    SphereSweep(const Scene<Scalar>& scene, const Path& path, double radius, double most, const QueryOptions& options,
                QueryCounters& counters)
        : query_{scene, options, counters},
          reach_(sphere_reach(scene, path.from, radius)),
          margin_(std::max(sphere_margin(scene, radius), 0x1p-43 * reach_)),  // place_sphere()'s grain, four times
          sphere_(path, radius, reach_),
          first_(query_, sphere_, most) {
        each_entry(scene, sphere_, margin_, counters, first_, &list_);
    }
    SphereSweep(const SphereSweep&) = delete;
    SphereSweep& operator=(const SphereSweep&) = delete;
    ~SphereSweep() = default;

    [[nodiscard]] bool found() const { return first_.found(); }
    [[nodiscard]] const SphereCandidate& first() const { return first_.best(); }
    [[nodiscard]] const Sphere& sphere() const { return sphere_; }
    [[nodiscard]] Point place() const {
        const SphereWays<Scalar> ways{query_, sphere_, reach_, margin_, list_};
        return place_sphere(ways, first(), query_.counters.retreats);
    }

  private:
    SphereQuery<Scalar> query_;
    double reach_;
    double margin_;
    Sphere sphere_;
    FirstEntry<Scalar> first_;
    Shortlist list_;
};

}  // namespace pierce::detail
