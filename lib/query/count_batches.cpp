// Batches of crossings.
#include <query/count_batches.h>

#include <query/counting_flight.h>

namespace pierce::detail {

namespace {

/// Segments or rays, whose sums are the answers.
template <class Scalar>
struct Sums {
    const Scene<Scalar>& scene;
    const Ways<Scalar>& ways;
    std::size_t at;
    std::size_t last;
    int* out;
    std::size_t& invalid;
    std::size_t count = 0;

    bool next(CountedQuery& query) {
        for (; at < last; ++at) {
            out[at] = 0;
            if (!ways.is_valid(at)) {
                ++invalid;
                continue;
            }
            if (!ways.set_path(scene, at, std::numeric_limits<double>::infinity(), query.path)) continue;
            query.sum = 0;
            query.i = at++;
            return true;
        }
        return false;
    }
    void finish(const CountedQuery& query) {
        out[query.i] = query.sum;
        count += query.sum != 0 ? 1 : 0;
    }
};

}  // namespace

template <class Scalar>
std::size_t crossings(const Scene<Scalar>& scene, const Ways<Scalar>& ways, std::size_t first, std::size_t last,
                      int* out, QueryCounters& counters, std::size_t& invalid) {
    Sums<Scalar> sums{scene, ways, first, last, out, invalid};
    fly_and_count(scene, sums, counters);
    return sums.count;
}

template std::size_t crossings(const Scene<float>&, const Ways<float>&, std::size_t, std::size_t, int*, QueryCounters&,
                               std::size_t&);
template std::size_t crossings(const Scene<double>&, const Ways<double>&, std::size_t, std::size_t, int*,
                               QueryCounters&, std::size_t&);

}  // namespace pierce::detail
