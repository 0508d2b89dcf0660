// Batches: the queries of engine.cpp, many at once.
#include <query/batch.h>
#include <query/engine.h>

namespace pierce::detail {

namespace {

template <class Scalar>
bool path_of(const Ends<Scalar>& ends, std::size_t i, Path& path, std::size_t& invalid) {
    const auto at = static_cast<std::ptrdiff_t>(i);
    const Scalar* from = ends.from + at * ends.from_stride;
    const Scalar* to = ends.to + at * ends.to_stride;
    bool finite = true;
    for (std::size_t k = 0; k < 3; ++k) {
        finite = finite && std::isfinite(from[k]) && std::isfinite(to[k]);
        path.from[k] = static_cast<double>(from[k]);
        path.to[k] = static_cast<double>(to[k]);
    }
    if (!finite) ++invalid;
    return finite;
}

}  // namespace

template <class Scalar, class Answer>
std::size_t first_hits(const Scene<Scalar>& scene, const Ends<Scalar>& ends, std::size_t first, std::size_t last,
                       std::optional<Answer>* out, const QueryOptions& options, QueryCounters& counters, std::size_t& invalid) {
    std::size_t hits = 0;
    fly<Certified, First<Scalar>>(
        scene, last - first, options, counters,
        [&](std::size_t i, Path& path) { return path_of(ends, first + i, path, invalid); },
        [&](const Path& path) { return First<Scalar>(scene, path, counters); },
        [&](std::size_t i, auto* query) {
            std::optional<Answer>& to = out[first + i];
            to.reset();
            if (query == nullptr || !query->collector.found()) return;
            ++hits;
            Answer& hit = to.emplace();
            answer<Certified, Scalar>(scene, query->path, query->collector.best(), none_passed, options, counters,
                                      &query->shortlist, hit);
            if constexpr (std::is_same_v<Answer, SweepHit<Scalar>>) hit.time_of_impact = hit.fraction;
        });
    return hits;
}

template <class Scalar>
std::size_t any_hits(const Scene<Scalar>& scene, const Ends<Scalar>& ends, std::size_t first, std::size_t last, std::uint8_t* out,
                     const QueryOptions& options, QueryCounters& counters, std::size_t& invalid) {
    std::size_t hits = 0;
    using Collector = decltype(Any(none_passed));
    fly<Certified, Collector>(
        scene, last - first, options, counters,
        [&](std::size_t i, Path& path) { return path_of(ends, first + i, path, invalid); },
        [](const Path&) { return Any(none_passed); },
        [&](std::size_t i, const auto* query) {
            const bool hit = query != nullptr && query->collector.found();
            out[first + i] = hit ? 1 : 0;
            hits += hit ? 1 : 0;
        });
    return hits;
}

template std::size_t first_hits(const Scene<float>&, const Ends<float>&, std::size_t, std::size_t, std::optional<Hit<float>>*,
                                const QueryOptions&, QueryCounters&, std::size_t&);
template std::size_t first_hits(const Scene<float>&, const Ends<float>&, std::size_t, std::size_t, std::optional<SweepHit<float>>*,
                                const QueryOptions&, QueryCounters&, std::size_t&);
template std::size_t any_hits(const Scene<float>&, const Ends<float>&, std::size_t, std::size_t, std::uint8_t*,
                              const QueryOptions&, QueryCounters&, std::size_t&);
template std::size_t first_hits(const Scene<double>&, const Ends<double>&, std::size_t, std::size_t, std::optional<Hit<double>>*,
                                const QueryOptions&, QueryCounters&, std::size_t&);
template std::size_t first_hits(const Scene<double>&, const Ends<double>&, std::size_t, std::size_t,
                                std::optional<SweepHit<double>>*, const QueryOptions&, QueryCounters&, std::size_t&);
template std::size_t any_hits(const Scene<double>&, const Ends<double>&, std::size_t, std::size_t, std::uint8_t*,
                              const QueryOptions&, QueryCounters&, std::size_t&);

}  // namespace pierce::detail
