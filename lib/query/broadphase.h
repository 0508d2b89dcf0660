// What the rest of query/ knows of a broadphase: it gives the triangles that a segment may hit, roughly nearest first.
#pragma once

#include <limits>

#include <query/scene.h>

namespace pierce::detail {

/// A fraction of the segment as the parameter of a probe, rounded up; negative where nothing of the probe comes before it. The last terms are for
/// the roundings here, and of `begin` where the probe was clipped (set_probe.h: within 2^-52).
template <class Scalar>
[[nodiscard]] inline float parameter(const Probe<Scalar>& probe, double fraction) {
    if (!(fraction >= 0)) return -1;
    if (probe.length == 1) return static_cast<float>(std::min(fraction, 1.0)) * (1 + 0x1p-22F) + std::numeric_limits<float>::min();
    const double left = fraction - probe.begin + 0x1p-50;
    if (left < 0) return -1;
    return static_cast<float>(std::min(left / probe.length, 1.0)) * (1 + 0x1p-22F) + std::numeric_limits<float>::min();
}

/// Makes a segment ready, and `limit` a parameter of the probe. False: nothing is hit up to there.
template <class Scalar>
[[nodiscard]] [[gnu::always_inline]] inline bool make_probe(const Scene<Scalar>& scene, const Path& path, Sides sides, double limit, Probe<Scalar>& probe,
                                                           float& parameter_limit) {
    if (!scene.backend->template of<Scalar>().set_probe(scene.frame, path.from.data(), path.to.data(), sides == Sides::front, sides == Sides::back, probe))
        return false;
    parameter_limit = parameter(probe, limit);
    return parameter_limit >= 0;
}

/// What becomes of a cluster of which `lanes` are left: `use(cluster, lanes)` as in each_candidate. Returns the parameter of the probe up to
/// which hits are of use; negative: none is any more.
template <class Scalar, class Use>
[[gnu::always_inline]] inline float use_cluster(const Scene<Scalar>& scene, const Probe<Scalar>& probe, ClusterRef cluster, unsigned lanes, float limit,
                                                QueryCounters& counters, Use&& use) {
    // An empty place of a node is visited where the noise is larger than the scene.
    if (cluster == scene.clusters.empty) [[unlikely]] return limit;
    for (unsigned left = lanes; left != 0; left &= left - 1) ++counters.triangles;
    return parameter(probe, use(cluster, lanes));
}

/// Calls `use(cluster, lanes)` for each cluster of which the wide kernels can't refuse all triangles: bits in `lanes` say which are left.
/// No triangle comes twice. `use` returns the fraction from which on hits are of no use; negative: none is any more. Nothing is left out that the
/// segment hits, or that a way within `Scene::near_bound` of it hits, up to that fraction.
template <class Scalar, class Use>
void each_candidate(const Scene<Scalar>& scene, const Path& path, Sides sides, double limit, QueryCounters& counters, Use&& use) {
    if (scene.empty()) return;
    Probe<Scalar> probe;
    float first_limit;
    if (!make_probe(scene, path, sides, limit, probe, first_limit)) return;
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
    scene.backend->template of<Scalar>().traverse(scene.tree.view(), scene.clusters.records.data(), probe, first_limit, visit, &context);
    counters.nodes += probe.nodes;
    counters.clusters += probe.clusters;
}

}  // namespace pierce::detail
