// Batches: the queries of engine.cpp, many at once.
#include <query/batch.h>

namespace pierce::detail {

namespace {

template <class Collector, class Scalar, class Make, class Hit>
void each_group(const Scene<Scalar>& scene, const Ends<Scalar>& ends, std::size_t first, std::size_t last, const QueryOptions& options,
                QueryCounters& counters, std::size_t& invalid, Make&& make, Hit&& hit) {
    Group<Certified, Collector, Scalar> group(scene, ends, options, counters);
    for (; first < last; first += k_group) group.take(first, static_cast<unsigned>(std::min<std::size_t>(last - first, k_group)), invalid, make, hit);
    group.finish(make, hit);
}

}  // namespace

template <class Scalar, class Answer>
std::size_t first_hits(const Scene<Scalar>& scene, const Ends<Scalar>& ends, std::size_t first, std::size_t last,
                       std::optional<Answer>* out, const QueryOptions& options, QueryCounters& counters, std::size_t& invalid) {
    std::size_t hits = 0;
    for (std::size_t i = first; i < last; ++i) out[i].reset();
    each_group<First<Scalar>>(
        scene, ends, first, last, options, counters, invalid, [&](const Path& path) { return First<Scalar>(scene, path, counters); },
        [&](std::size_t i, const auto& query, const Shortlist& list) {
            ++hits;
            Answer& hit = out[i].emplace();
            answer<Certified, Scalar>(scene, query.path, query.collector.best(), none_passed, options, counters, &list, hit);
            if constexpr (std::is_same_v<Answer, SweepHit<Scalar>>) hit.time_of_impact = hit.fraction;
        });
    return hits;
}

template <class Scalar>
std::size_t any_hits(const Scene<Scalar>& scene, const Ends<Scalar>& ends, std::size_t first, std::size_t last, std::uint8_t* out,
                     const QueryOptions& options, QueryCounters& counters, std::size_t& invalid) {
    std::size_t hits = 0;
    std::fill(out + first, out + last, std::uint8_t{0});
    each_group<decltype(Any(none_passed))>(
        scene, ends, first, last, options, counters, invalid, [](const Path&) { return Any(none_passed); },
        [&](std::size_t i, const auto&, const Shortlist&) {
            ++hits;
            out[i] = 1;
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
