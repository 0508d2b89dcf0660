// What is certified about a triangle that the wide kernels leave, and what the caller's own options say of it.
#pragma once

#include <kernel/finer_filter.h>
#include <query/candidate.h>
#include <query/values.h>

namespace pierce::detail {

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
        Filtered filtered = filter(corners, path, sides);
        if (filtered.verdict == Verdict::doubtful) filtered = finer_filter(corners, path, sides);
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

}  // namespace pierce::detail
