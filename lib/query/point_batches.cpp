// Winding numbers of many points, each on its own way out, in flight. Points that are given in no order are taken in
// Z-order (Morton 1966): ways of neighbours go side by side, and find in the caches what those before them read.
#include <query/count_batches.h>

#include <chunks.h>
#include <query/counting_flight.h>

namespace pierce::detail {

namespace {

template <class Scalar, class Out>
struct PointWays {
    const Scene<Scalar>& scene;
    const PointsView<Scalar>& points;
    const std::uint64_t* entries;  ///< null: in the order given
    std::size_t next_one;
    std::size_t last;
    Out* out;
    std::size_t& invalid;
    OutTargets targets;
    std::size_t count = 0;

    bool next(CountedQuery& query) {
        while (next_one < last) {
            const std::size_t i = number_of(next_one);
            if (entries != nullptr && last - next_one > k_ahead) {
                const std::size_t later = number_of(next_one + k_ahead);
                __builtin_prefetch(reinterpret_cast<const std::byte*>(points.data()) +
                                   static_cast<std::ptrdiff_t>(later) * points.stride());
                __builtin_prefetch(out + later, 1);
            }
            ++next_one;
            out[i] = 0;
            const Point point = to_point(points[i]);
            if (!are_finite(point)) {
                ++invalid;
                continue;
            }
            if (is_clearly_outside(scene, point)) continue;
            query.path = way_out(point, targets);
            query.i = i;
            query.sum = 0;
            return true;
        }
        return false;
    }
    [[nodiscard]] std::size_t number_of(std::size_t place) const {
        return entries != nullptr ? static_cast<std::uint32_t>(entries[place]) : place;
    }
    void finish(const CountedQuery& query) {
        out[query.i] = static_cast<Out>(sizeof(Out) == 1 ? query.sum != 0 : -query.sum);
        count += query.sum != 0 ? 1 : 0;
    }
};

/// The low 10 bits, each with two 0s behind it.
[[nodiscard]] std::uint64_t spread(std::uint64_t x) {
    x = (x | x << 16) & 0x030000ff;
    x = (x | x << 8) & 0x0300f00f;
    x = (x | x << 4) & 0x030c30c3;
    return (x | x << 2) & 0x09249249;
}

}  // namespace

template <class Scalar>
bool are_in_order(const Scene<Scalar>& scene, const PointsView<Scalar>& points) {
    constexpr std::size_t k_samples = 256;
    const std::size_t pairs = points.size() - 1;
    const std::size_t step = std::max<std::size_t>(pairs / k_samples, 1);
    std::size_t seen = 0;
    std::size_t near = 0;
    for (std::size_t i = 0; i < pairs; i += step) {
        const Point x = to_point(points[i]);
        const Point y = to_point(points[i + 1]);
        bool both = true;
        for (std::size_t k = 0; k < 3; ++k)
            both = both && std::abs(x[k] - y[k]) <= (scene.bounds.high[k] - scene.bounds.low[k]) / 16;
        ++seen;
        near += both ? 1 : 0;
    }
    return 2 * near >= seen;
}

template <class Scalar>
void key_points(const Scene<Scalar>& scene, const PointsView<Scalar>& points, std::size_t first, std::size_t last,
                std::uint64_t* entries) {
    constexpr double k_most = 1023;
    double per_cell[3];
    for (std::size_t k = 0; k < 3; ++k) per_cell[k] = k_most / (scene.bounds.high[k] - scene.bounds.low[k]);
    for (std::size_t i = first; i < last; ++i) {
        const Point point = to_point(points[i]);
        std::uint64_t key = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            double cell = (point[k] - scene.bounds.low[k]) * per_cell[k];
            cell = cell > 0 ? cell : 0;  // NaN: 0
            key |= spread(static_cast<std::uint64_t>(cell < k_most ? cell : k_most)) << k;
        }
        entries[i] = key << 32 | i;
    }
}

template <class Scalar, class Out>
std::size_t winding_numbers(const Scene<Scalar>& scene, const PointsView<Scalar>& points, const std::uint64_t* entries,
                            std::size_t first, std::size_t last, Out* out, QueryCounters& counters,
                            std::size_t& invalid) {
    PointWays<Scalar, Out> ways{scene, points, entries, first, last, out, invalid, OutTargets(scene.bounds)};
    fly_and_count(scene, ways, counters);
    return ways.count;
}

#define PIERCE_POINTS(Scalar)                                                                                   \
    template bool are_in_order(const Scene<Scalar>&, const PointsView<Scalar>&);                                \
    template void key_points(const Scene<Scalar>&, const PointsView<Scalar>&, std::size_t, std::size_t,         \
                             std::uint64_t*);                                                                   \
    template std::size_t winding_numbers(const Scene<Scalar>&, const PointsView<Scalar>&, const std::uint64_t*, \
                                         std::size_t, std::size_t, int*, QueryCounters&, std::size_t&);         \
    template std::size_t winding_numbers(const Scene<Scalar>&, const PointsView<Scalar>&, const std::uint64_t*, \
                                         std::size_t, std::size_t, std::uint8_t*, QueryCounters&, std::size_t&)
PIERCE_POINTS(float);
PIERCE_POINTS(double);
#undef PIERCE_POINTS

}  // namespace pierce::detail
