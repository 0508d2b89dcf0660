// What the rest of query/ knows of a broadphase, tree or grid: it gives the triangles that a segment may hit, roughly
// nearest first.
#pragma once

#include <algorithm>
#include <limits>

#include <query/scene.h>

namespace pierce::detail {

/// A fraction of the segment as the parameter of a probe, rounded up; negative where nothing of the probe comes before
/// it. The last terms are for the roundings here, and of `begin` where the probe was clipped (set_probe.h: within
/// 2^-52).
template <class Scalar>
[[nodiscard]] inline float parameter(const Probe<Scalar>& probe, double fraction) {
    if (!(fraction >= 0)) return -1;
    const auto up = [](double x) {
        return static_cast<float>(std::min(x, 1.0)) * (1 + 0x1p-22F) + std::numeric_limits<float>::min();
    };
    if (probe.length == 1) return up(fraction);
    const double left = fraction - probe.begin + 0x1p-50;
    return left < 0 ? -1 : up(left / probe.length);
}

/// Makes a segment ready, and of `limit` a parameter of the probe. False: nothing is hit up to there. `frame`: the
/// scene's, or that with more noise.
template <class Scalar>
[[nodiscard]] bool make_probe(const Scene<Scalar>& scene, const Frame& frame, const Path& path, Sides sides,
                              double limit, Probe<Scalar>& probe, float& up_to) {
    const ScalarKernels<Scalar>& kernels = scene.backend->template of<Scalar>();
    const bool front_only = sides == Sides::front;
    const bool back_only = sides == Sides::back;
    if (!kernels.set_probe(frame, path.from.data(), path.to.data(), path.ray, front_only, back_only,
                           scene.tree.short_way, probe))
        return false;
    up_to = parameter(probe, std::min(limit, path.end));
    return up_to >= 0;
}
template <class Scalar>
[[nodiscard]] bool make_probe(const Scene<Scalar>& scene, const Path& path, Sides sides, double limit,
                              Probe<Scalar>& probe, float& up_to) {
    return make_probe(scene, scene.frame, path, sides, limit, probe, up_to);
}

/// Whether many queries can be in flight through a scene: not where there is no tree, or one too deep for that.
template <class Scalar>
[[nodiscard]] bool takes_flights(const Scene<Scalar>& scene) {
    return !scene.empty() && scene.broadphase == Broadphase::tree && scene.tree.depth <= k_flight_depth;
}

/// Calls `use(cluster, lanes)`, as in each_candidate, for a cluster of which `lanes` are left. Returns the parameter up
/// to which hits are of use, `limit` before; negative: none is any more.
template <class Scalar, class Use>
[[nodiscard]] float use_cluster(const Scene<Scalar>& scene, const Probe<Scalar>& probe, ClusterRef cluster,
                                unsigned lanes, float limit, QueryCounters& counters, Use&& use) {
    // An empty place of a node is visited where the noise is larger than the scene.
    if (cluster == scene.clusters.empty) [[unlikely]]
        return limit;
    for (unsigned left = lanes; left != 0; left &= left - 1) ++counters.triangles;
    return parameter(probe, use(cluster, lanes));
}

/// Does with the grid what `kernels.traverse` does with the tree. A limit is a float all the way: what the grid hands
/// on is the last one that it got, or 1.
template <class Scalar>
void traverse_grid(const Scene<Scalar>& scene, const ScalarKernels<Scalar>& kernels, Probe<Scalar>& probe,
                   float first_limit, Visit visit, void* self) {
    const Scalar* records = scene.clusters.records.data();
    std::uint64_t cells = 0;
    // An infinite noise, or NaN in the probe, means all cells. So does one beside which the scene is nothing:
    // differences of what is so far away say nothing any more.
    const double noise = probe.noise[0] < 0x1p30 ? probe.noise[0] : std::numeric_limits<double>::infinity();
    scene.grid.visit(
        probe.origin, probe.direction, noise, first_limit, cells, [&](ClusterRef cluster, double limit) -> double {
            ++probe.clusters;
            const unsigned lanes = kernels.test_cluster(probe, records, cluster, static_cast<float>(limit));
            return lanes != 0 ? visit(self, cluster, lanes) : limit;
        });
    probe.nodes = static_cast<std::uint32_t>(cells);
}

/// Calls `use(cluster, lanes)` for each cluster of which the wide kernels can't refuse all triangles: bits in `lanes`
/// say which are left. No triangle comes twice. `use` returns the fraction from which on hits are of no use; negative:
/// none is any more. Nothing is left out that the segment hits, or that a way hits within the noise of `frame` of it,
/// up to that fraction.
template <class Scalar, class Use>
void each_candidate(const Scene<Scalar>& scene, const Frame& frame, const Path& path, Sides sides, double limit,
                    QueryCounters& counters, Use&& use) {
    if (scene.empty()) return;
    Probe<Scalar> probe;
    float first_limit = 0;
    if (!make_probe(scene, frame, path, sides, limit, probe, first_limit)) return;
    struct Context {
        const Scene<Scalar>& scene;
        const Probe<Scalar>& probe;
        float limit;
        QueryCounters& counters;
        Use& use;
    };
    Context context{scene, probe, first_limit, counters, use};
    const Visit visit = [](void* self, std::uint32_t cluster, unsigned lanes) {
        Context& c = *static_cast<Context*>(self);
        return c.limit = use_cluster(c.scene, c.probe, cluster, lanes, c.limit, c.counters, c.use);
    };
    const ScalarKernels<Scalar>& kernels = scene.backend->template of<Scalar>();
    if (scene.broadphase == Broadphase::grid)
        traverse_grid(scene, kernels, probe, first_limit, visit, &context);
    else
        kernels.traverse(scene.tree.view(), scene.clusters.records.data(), probe, first_limit, visit, &context);
    counters.nodes += probe.nodes;
    counters.clusters += probe.clusters;
}
/// The same with the noise of the scene, which is `Scene::near_bound`.
template <class Scalar, class Use>
void each_candidate(const Scene<Scalar>& scene, const Path& path, Sides sides, double limit, QueryCounters& counters,
                    Use&& use) {
    each_candidate(scene, scene.frame, path, sides, limit, counters, use);
}

}  // namespace pierce::detail
