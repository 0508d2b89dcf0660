// The one way through the rooms: broadphase, wide kernels, filter, exact arithmetic where that is in doubt, collector.
#pragma once

#include <bit>

#include <query/broadphase.h>
#include <query/certified.h>

namespace pierce::detail {

/// The triangles that the wide kernels left; if `complete`, all that could stop a point on a way within `Scene::near_bound` of the path, so that
/// the verified point needs no second traversal.
struct Shortlist {
    void add(TriangleRef triangle) {
        if (count == triangles.size()) complete = false;
        else triangles[count++] = triangle;
    }

    std::array<TriangleRef, 64> triangles;
    unsigned count = 0;
    bool complete = true;
};

/// Gives the collector a triangle that the wide kernels leave, if the path hits it under `options`.
template <class Kernel, class Scalar, class Collector>
void test_triangle(const Scene<Scalar>& scene, const Path& path, TriangleRef triangle, const QueryOptions& options,
                   QueryCounters& counters, Collector& collector) {
    if (!collector.wants(triangle) || masked(scene, triangle, options)) return;
    Candidate& candidate = collector.room();
    const double limit = std::min(collector.limit(), options.max_fraction);
    const Corners corners = scene.corners(triangle);
    if (!Kernel::test(corners, triangle, path, options.sides, limit, counters, candidate)) return;
    if (candidate.latest > options.max_fraction) {
        if (candidate.earliest > options.max_fraction) return;
        if (!fraction_at_most(path, corners, options.max_fraction)) return;
    }
    if (options.accept && !accepted(scene, path, candidate, options, counters)) return;
    collector.add();
}

/// Gives the collector those of a cluster's triangles that are in `lanes`. Returns the fraction from which on hits are of no use.
template <class Kernel, class Scalar, class Collector>
double test_cluster(const Scene<Scalar>& scene, const Path& path, ClusterRef cluster, unsigned lanes, const QueryOptions& options,
                    QueryCounters& counters, Collector& collector, Shortlist* list) {
    for (; lanes != 0; lanes &= lanes - 1) {
        const TriangleRef triangle{cluster, static_cast<std::uint32_t>(std::countr_zero(lanes))};
        if (list != nullptr) list->add(triangle);
        test_triangle<Kernel>(scene, path, triangle, options, counters, collector);
    }
    return std::min(collector.limit(), options.max_fraction);
}

/// Gives the collector of a query each triangle that the path hits under `options`. A collector has
///   double limit()                hits beyond this fraction are of no use; negative: none is any more
///   bool wants(triangle)          whether to look at it at all
///   Candidate& room()             where the next hit is to be written (a copy of what was just written would wait for memory)
///   void add()                    the hit that was written there counts
/// `options.max_fraction` must not be NaN.
template <class Kernel, class Scalar, class Collector>
void traverse(const Scene<Scalar>& scene, const Path& path, const QueryOptions& options, QueryCounters& counters, Collector& collector,
              Shortlist* list = nullptr) {
    each_candidate(scene, path, options.sides, std::min(collector.limit(), options.max_fraction), counters,
                   [&](ClusterRef cluster, unsigned lanes) {
                       return test_cluster<Kernel>(scene, path, cluster, lanes, options, counters, collector, list);
                   });
}

}  // namespace pierce::detail
