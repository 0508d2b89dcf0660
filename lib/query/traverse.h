// How hits are found: broadphase, wide kernels, filter, exact arithmetic where that is in doubt, collector.
#pragma once

#include <bit>

#include <query/broadphase.h>
#include <query/certified.h>

namespace pierce::detail {

/// Whether a hit counts whose fraction may be beyond what the path allows.
template <class Scalar>
[[nodiscard]] [[gnu::noinline]] bool is_within(const Scene<Scalar>& scene, const Path& path, const Candidate& candidate,
                                               Sides sides) {
    const Corners corners = scene.corners(candidate.triangle);
    if (candidate.latest > path.most && !fraction_at_most(path, corners, path.most)) return false;
    if (candidate.latest < path.end) return true;
    const int order = compare_fraction(path, corners, path.end);
    return order < 0 || (order == 0 && counts_at_end(candidate.decision.side, sides));
}

/// Gives the collector a triangle that the wide kernels leave, if the path hits it under `options`.
template <class Kernel, class Scalar, class Collector>
void test_triangle(const Scene<Scalar>& scene, const Path& path, TriangleRef triangle, const QueryOptions& options,
                   QueryCounters& counters, Collector& collector) {
    if (!collector.wants(triangle) || masked(scene, triangle, options)) return;
    Candidate& candidate = collector.room();
    const double reach = std::min(path.most, path.end);
    const double limit = std::min(collector.limit(), reach);
    if (!Kernel::test(scene, triangle, path, options.sides, limit, counters, candidate)) return;
    if (candidate.latest >= reach && !is_within(scene, path, candidate, options.sides)) [[unlikely]]
        return;
    if (options.accept && !accepted(scene, path, triangle, candidate.decision, candidate.measured, options, counters))
        return;
    collector.add();
}

/// Gives the collector those of a cluster's triangles that are in `lanes`. Returns the fraction from which on hits are
/// of no use.
template <class Kernel, class Scalar, class Collector>
double test_cluster(const Scene<Scalar>& scene, const Path& path, ClusterRef cluster, unsigned lanes,
                    const QueryOptions& options, QueryCounters& counters, Collector& collector) {
    for (; lanes != 0; lanes &= lanes - 1) {
        const TriangleRef triangle{cluster, static_cast<std::uint32_t>(std::countr_zero(lanes))};
        test_triangle<Kernel>(scene, path, triangle, options, counters, collector);
        collector.seen(triangle);
    }
    return std::min(collector.limit(), path.most);
}

/// Gives the collector of a query each triangle that the path hits under `options`. A collector has
///   double limit()                hits beyond this fraction are of no use; negative: none is any more
///   bool wants(triangle)          whether to look at it at all
///   Candidate& room()             where the next hit is to be written (a copy of it would wait for memory)
///   void add()                    the hit that was written there counts
///   void seen(triangle)           this was one that the wide kernels left
/// `path.most` must not be NaN.
template <class Kernel, class Scalar, class Collector>
void traverse(const Scene<Scalar>& scene, const Path& path, const QueryOptions& options, QueryCounters& counters,
              Collector& collector) {
    each_candidate(scene, path, options.sides, std::min(collector.limit(), path.most), counters,
                   [&](ClusterRef cluster, unsigned lanes) {
                       return test_cluster<Kernel>(scene, path, cluster, lanes, options, counters, collector);
                   });
}

}  // namespace pierce::detail
