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
                            const Measured& measured, const QueryOptions& options, QueryCounters& counters) {
    CertifiedFace<double> face(path, measured, candidate.decision, *scene.backend->refine, counters);
    const Measures measures = face.measures();
    const Point& w = measures.barycentric;
    return options.accept({scene.face_of(candidate.triangle),
                           scene.number_of(candidate.triangle),
                           candidate.decision.side,
                           candidate.decision.feature,
                           candidate.decision.feature_index,
                           candidate.decision.at_start,
                           measures.fraction,
                           {w[0], w[1], w[2]}});
}

/// All that is certified about a triangle that the wide kernels leave: whether it is hit, sides of its plane, values.
/// (A policy, so that
/// the benchmark can put another in its place and measure what certainty costs.)
struct Certified {
    /// Whether the path hits, unless the hit lies beyond `limit`. `measured` is set in any case.
    template <class Scalar>
    static bool test(const Corners& corners, TriangleRef triangle, const Path& path, Sides sides, double limit,
                     QueryCounters& counters, Measured& measured, Candidate& candidate) {
        measure_path<Scalar>(corners, path, measured);
        Filtered filtered = filter(measured, sides);
        if (filtered.verdict == Verdict::miss || filtered.earliest > limit) return false;
        if (filtered.verdict == Verdict::doubtful && !decided(corners, path, sides, measured, counters, filtered))
            return false;
        candidate.triangle = triangle;
        candidate.decision = filtered.decision;
        candidate.earliest = filtered.earliest;
        candidate.latest = filtered.latest;
        return true;
    }

    /// Normal, values and place of one that is hit.
    template <class Scalar>
    using Face = CertifiedFace<Scalar>;

  private:
    [[gnu::noinline]] static bool decided(const Corners& corners, const Path& path, Sides sides,
                                          const Measured& measured, QueryCounters& counters, Filtered& filtered) {
        const Filtered finer = finer_filter(measured, sides);
        if (finer.verdict != Verdict::doubtful) {
            filtered = finer;
            return finer.verdict == Verdict::hit;
        }
        ++counters.exact_decisions;
        filtered.decision = decide(path, corners, sides);
        if (!filtered.decision.hit) return false;
        if (filtered.decision.at_start) {
            filtered.earliest = filtered.latest = 0;
        } else if (filtered.latest - filtered.earliest > 0x1p-20) {
            // Nothing useful is known of the fraction. One rounded once is within 1 ulp, or two steps where it is
            // denormal.
            ++counters.exact_values;
            const double fraction = measure(path, corners).fraction;
            const double slack = fraction * 0x1p-52 + 0x1p-1072;
            filtered.earliest = fraction - slack;
            filtered.latest = fraction + slack;
        }
        return true;
    }
};

}  // namespace pierce::detail
