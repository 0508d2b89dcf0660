// What a façade asks along a segment or a ray: in standard arithmetic, of what has a meaning, and counted.
#pragma once

#include <optional>
#include <span>

#include <environment.h>
#include <pierce/options.h>

namespace pierce::detail {

/// The caller's counters, or some that nobody looks at. Counts a query.
class Counters {
  public:
    explicit Counters(QueryCounters* given) : counters_(given != nullptr ? *given : spare_) { ++counters_.queries; }
    operator QueryCounters&() { return counters_; }

  private:
    QueryCounters spare_;
    QueryCounters& counters_;
};

// `impl` is that of a mesh or a world: its `scene`, and `valid(way)`, which counts what has no meaning. `Options` and
// `Answer` (Hit or WorldHit) are those of the queries about its scene, which are found there by their arguments.

template <class Answer, class Impl, class Way, class Options>
std::optional<Answer> first_along(const Impl& impl, const Way& way, const Options& options) {
    const StandardArithmetic standard;
    Counters counters(options.counters);
    if (!impl.valid(way) || !(options.max_fraction >= 0)) return std::nullopt;
    return first_hit(impl.scene, way, options, counters);
}

template <class Impl, class Way, class Options>
bool any_along(const Impl& impl, const Way& way, const Options& options) {
    const StandardArithmetic standard;
    Counters counters(options.counters);
    if (!impl.valid(way) || !(options.max_fraction >= 0)) return false;
    return any_hit(impl.scene, way, options, counters);
}

template <class Answer, class Impl, class Way, class Options>
std::size_t all_along(const Impl& impl, const Way& way, std::span<Answer> out, const Options& options) {
    const StandardArithmetic standard;
    Counters counters(options.counters);
    if (!impl.valid(way) || !(options.max_fraction >= 0)) return 0;
    return all_hits(impl.scene, way, out, options, counters);
}

}  // namespace pierce::detail
