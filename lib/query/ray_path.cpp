// The length of a ray's path: the least power of two, as a multiple of its direction, that leads out of the mesh's box
// or past what limits it.
//
// Any such length gives the same answers: a triangle that the ray hits lies in the box, so at a parameter t below
// 2^exponent the ray has been at each point of the box that it comes to, and the end of the path is strictly behind each
// plane that it passed. The comparison with a limit is exact: limit 2^-exponent is a double.
#include <query/ray_path.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace pierce::detail {

namespace {

/// The least k with x < 2^k d (1 - 2^-50), for x, d > 0.
int exponent_above(double x, double d) {
    int of_x = 0;
    int of_d = 0;
    const double share = std::frexp(x, &of_x) / std::frexp(d, &of_d);
    return of_x - of_d + (share * (1 + 0x1p-49) < 1 ? 0 : 1);
}

/// The least k with x <= 2^k, for x > 0.
int exponent_at_least(double x) {
    int exponent = 0;
    return std::frexp(x, &exponent) == 0.5 ? exponent - 1 : exponent;
}

/// The exponent of the last bit of x != 0 that is set.
int last_bit(double x) {
    int exponent = 0;
    const auto whole = static_cast<std::uint64_t>(std::ldexp(std::frexp(std::abs(x), &exponent), 53));
    return exponent - 53 + std::countr_zero(whole);
}

}  // namespace

bool set_ray_path(const Box& bounds, const Point& origin, const Point& direction, double limit, double most,
                  bool floats, Path& path) {
    constexpr int k_none = std::numeric_limits<int>::max();
    constexpr int k_lowest = std::numeric_limits<double>::min_exponent - std::numeric_limits<double>::digits;
    if (!(limit > 0) || !(most >= 0)) return false;
    int exponent = k_none;
    int least = -5000;      // of which each component is a double
    int largest = 5000;
    for (std::size_t k = 0; k < 3; ++k) {
        const double d = direction[k];
        if (d == 0) {
            if (origin[k] < bounds.low[k] || origin[k] > bounds.high[k]) return false;
            continue;
        }
        // How far it is to the side that the ray leaves the box by: halves, as the difference may be infinite.
        const double side = d > 0 ? bounds.high[k] : bounds.low[k];
        const double halves = d > 0 ? side * 0.5 - origin[k] * 0.5 : origin[k] * 0.5 - side * 0.5;
        if (d > 0 ? side < origin[k] : origin[k] < side) return false;
        // On the side itself hits may lie where it starts: some way behind them.
        const double least_way = std::max(std::abs(side) * 0x1p-60, std::numeric_limits<double>::min());
        exponent = std::min(exponent, exponent_above(std::max(halves, least_way), std::abs(d)) + 1);
        int size = 0;
        static_cast<void>(std::frexp(d, &size));
        least = std::max(least, k_lowest - last_bit(d));
        largest = std::min(largest, std::numeric_limits<double>::max_exponent - size);
    }
    if (exponent == k_none) return false;
    const double nearest = most > 0 ? std::min(limit, most) : limit;
    if (nearest < std::numeric_limits<double>::infinity())
        exponent = std::min(exponent, exponent_at_least(nearest));
    exponent = std::min(std::max(exponent, least), largest);

    path.from = origin;
    path.ray = true;
    path.exponent = exponent;
    path.wild = false;
    for (std::size_t k = 0; k < 3; ++k) {
        path.to[k] = std::ldexp(direction[k], exponent);
        const double size = std::abs(path.to[k]);
        path.wild = path.wild || (floats && size != 0 && !(size >= 0x1p-200 && size <= 0x1p200));
    }
    const auto part = [exponent](double x) { return std::ldexp(x, -exponent); };
    path.most = part(most);
    path.end = part(limit) <= 1 ? part(limit) : std::numeric_limits<double>::infinity();
    return true;
}

}  // namespace pierce::detail
