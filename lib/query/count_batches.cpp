// Batches of crossings.
#include <query/count_batches.h>

#include <query/counting_flight.h>

namespace pierce::detail {

namespace {

/// Segments, whose sums are the answers.
template <class Scalar>
struct SegmentWays {
    struct Query {
        Path path;
        std::size_t i;
        int sum;
    };

    const Scene<Scalar>& scene;
    const Ends<Scalar>& ends;
    std::size_t at;
    std::size_t last;
    int* out;
    std::size_t& invalid;
    QueryCounters& counters;
    std::size_t count = 0;

    bool next(Query& query) {
        for (; at < last; ++at) {
            out[at] = 0;
            if (!is_finite(ends, at)) {
                ++invalid;
                continue;
            }
            const auto row = static_cast<std::ptrdiff_t>(at);
            for (std::size_t k = 0; k < 3; ++k) {
                query.path.from[k] = static_cast<double>((ends.from + row * ends.from_stride)[k]);
                query.path.to[k] = static_cast<double>((ends.to + row * ends.to_stride)[k]);
            }
            query.sum = 0;
            query.i = at++;
            return true;
        }
        return false;
    }
    void visit(Query& query, ClusterRef cluster, unsigned lanes) {
        query.sum += crossings_in(scene, query.path, cluster, lanes, counters);
    }
    void finish(Query& query) {
        out[query.i] = query.sum;
        count += query.sum != 0 ? 1 : 0;
    }
};

}  // namespace

template <class Scalar>
std::size_t crossings(const Scene<Scalar>& scene, const Ends<Scalar>& ends, std::size_t first, std::size_t last,
                      int* out, QueryCounters& counters, std::size_t& invalid) {
    SegmentWays<Scalar> ways{scene, ends, first, last, out, invalid, counters};
    fly_and_count(scene, ways, counters);
    return ways.count;
}

template std::size_t crossings(const Scene<float>&, const Ends<float>&, std::size_t, std::size_t, int*, QueryCounters&,
                               std::size_t&);
template std::size_t crossings(const Scene<double>&, const Ends<double>&, std::size_t, std::size_t, int*,
                               QueryCounters&, std::size_t&);

}  // namespace pierce::detail
