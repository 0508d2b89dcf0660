// The one way through the rooms: broadphase, wide kernels, filter, exact arithmetic where that is in doubt, collector.
#pragma once

#include <kernel/filter.h>
#include <query/broadphase.h>
#include <query/candidate.h>
#include <query/values.h>

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

template <class Scalar>
[[nodiscard]] bool masked(const Scene<Scalar>& scene, TriangleRef triangle, const QueryOptions& options) {
    if (options.face_mask.empty()) return false;
    const std::uint32_t face = scene.face_of(triangle);
    return face >= options.face_mask.size() || options.face_mask[face] == 0;
}

/// Whether the caller's own test takes a hit; `accept` must be given.
template <class Scalar>
[[nodiscard]] bool accepted(const Scene<Scalar>& scene, const Path& path, const Candidate& candidate,
                            const QueryOptions& options, QueryCounters& counters) {
    const Measures measures = CertifiedFace<double>(scene.corners(candidate.triangle), counters).measures(path, candidate.decision);
    const Point& w = measures.barycentric;
    return options.accept({scene.face_of(candidate.triangle), scene.number_of(candidate.triangle), candidate.decision.side,
                           candidate.decision.feature, candidate.decision.feature_index, candidate.decision.at_start,
                           measures.fraction, {w[0], w[1], w[2]}});
}

/// All that is certified about a triangle that the wide kernels leave: whether it is hit, sides of its plane, values. (A policy, so that
/// the benchmark can put another in its place and measure what certainty costs.)
struct Certified {
    /// Whether the path hits, unless the hit lies beyond `limit`.
    static bool test(const Corners& corners, TriangleRef triangle, const Path& path, Sides sides, double limit,
                     QueryCounters& counters, Candidate& candidate) {
        const Filtered filtered = filter(corners, path, sides);
        if (filtered.verdict == Verdict::miss || filtered.earliest > limit) return false;
        if (filtered.verdict == Verdict::hit) {
            // Certain of a hit, the filter is certain that it is on neither edge nor corner, and that it is not at the start.
            candidate = {triangle,
                         {.hit = true, .side = filtered.side, .feature = Feature::face, .feature_index = 0, .at_start = false},
                         filtered.earliest,
                         filtered.latest};
            return true;
        }
        ++counters.exact_decisions;
        const Decision decision = decide(path, corners, sides);
        if (!decision.hit) return false;
        candidate = exact_candidate(triangle, decision, CertifiedFace<double>(corners, counters).measures(path, decision).fraction);
        return true;
    }

    /// Normal, values and sides of one that is hit.
    template <class Scalar>
    using Face = CertifiedFace<Scalar>;
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

/// Gives the collector of a query each triangle that the path hits under `options`. A collector has
///   double limit()                hits beyond this fraction are of no use; negative: none is any more
///   bool wants(triangle)          whether to look at it at all
///   Candidate& room()             where the next hit is to be written (a copy of what was just written would wait for memory)
///   void add()                    the hit that was written there counts
/// `options.max_fraction` must not be NaN.
template <class Kernel, class Scalar, class Collector>
void traverse(const Scene<Scalar>& scene, const Path& path, const QueryOptions& options, QueryCounters& counters, Collector& collector,
              Shortlist* list = nullptr) {
    const auto limit = [&] { return std::min(collector.limit(), options.max_fraction); };
    each_candidate(scene, path, options.sides, limit(), counters, [&](ClusterRef cluster, unsigned lanes) {
        for (; lanes != 0; lanes &= lanes - 1) {
            const TriangleRef triangle{cluster, static_cast<std::uint32_t>(std::countr_zero(lanes))};
            if (list != nullptr) list->add(triangle);
            test_triangle<Kernel>(scene, path, triangle, options, counters, collector);
        }
        return limit();
    });
}

}  // namespace pierce::detail
