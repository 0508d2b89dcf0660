// What is certified about a triangle that the wide kernels leave, and what the caller's own options say of it.
#pragma once

#include <kernel/finer_filter.h>
#include <query/candidate.h>
#include <query/parameter.h>
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
[[nodiscard]] bool accepted(const Scene<Scalar>& scene, const Path& path, TriangleRef triangle,
                            const Decision& decision, const Measured& measured, const QueryOptions& options,
                            QueryCounters& counters) {
    const Measures measures = fine_measures(scene.narrow(), measured, path, decision, counters);
    const Point& w = measures.barycentric;
    return options.accept(
        {scene.face_of(triangle),
         scene.number_of(triangle),
         decision.side,
         decision.feature,
         decision.feature_index,
         decision.at_start,
         to_parameter(path, measures.fraction, decision.at_start, [&] { return corners_of(measured); }),
         {w[0], w[1], w[2]}});
}

/// Sets the interval of what exact arithmetic found to be hit or touched, where the filter left one that says little.
inline void set_exact_interval(const Path& path, const Corners& corners, QueryCounters& counters, Filtered& filtered) {
    if (filtered.decision.at_start) {
        filtered.earliest = filtered.latest = 0;
    } else if (filtered.latest - filtered.earliest > 0x1p-20) {
        // Nothing useful is known of the fraction. One rounded once is within 1 ulp, or two steps where it is denormal.
        ++counters.exact_values;
        const double fraction = measure(path, corners).fraction;
        const double slack = fraction * 0x1p-52 + 0x1p-1072;
        filtered.earliest = fraction - slack;
        filtered.latest = fraction + slack;
    }
}

/// All that is certified about a triangle that the wide kernels leave: whether it is hit, and its values. (A policy, so
/// that the benchmark can put another in its place and measure what certainty costs.)
struct Certified {
    /// Whether the path hits, unless the hit lies beyond `limit`.
    template <class Scalar>
    static bool test(const Scene<Scalar>& scene, TriangleRef triangle, const Path& path, Sides sides, double limit,
                     QueryCounters& counters, Candidate& candidate) {
        candidate.triangle = triangle;
        scene.narrow().filter(scene.row(triangle), path.from.data(), path.to.data(), path.ray, sides, candidate,
                              candidate.measured);
        if (path.wild) [[unlikely]] {
            candidate.measured.tame = false;
            static_cast<Filtered&>(candidate) = {Verdict::doubtful, {}, 0, 1};
        }
        if (candidate.verdict == Verdict::miss || candidate.earliest > limit) return false;
        return candidate.verdict == Verdict::hit || decided(path, sides, candidate.measured, counters, candidate);
    }

    /// Values of one that is hit, and the first place to be tried for its point.
    template <class Scalar>
    static void certify(const Scene<Scalar>& scene, const Candidate& candidate, const Path& path,
                        QueryCounters& counters, Values& values, Rounded<Scalar>& rounded) {
        detail::certify(scene.narrow(), candidate.measured, path, candidate.decision, scene.grain, counters, values,
                        rounded);
    }

  private:
    [[gnu::noinline]] static bool decided(const Path& path, Sides sides, const Measured& measured,
                                          QueryCounters& counters, Filtered& filtered) {
        const Filtered finer = finer_filter(measured, sides);
        if (finer.verdict != Verdict::doubtful) {
            filtered = finer;
            return finer.verdict == Verdict::hit;
        }
        const Corners corners = corners_of(measured);
        ++counters.exact_decisions;
        filtered.decision = decide(path, corners, sides);
        if (!filtered.decision.hit) return false;
        set_exact_interval(path, corners, counters, filtered);
        return true;
    }
};

}  // namespace pierce::detail
