// The length of a ray's path: the least power of two, as a multiple of its direction, that leads out of the mesh's box
// or past what limits it.
//
// Any such length gives the same answers: a triangle that the ray hits lies in the box, so at a parameter t below
// 2^exponent the ray has been at each point of the box that it comes to, and the end of the path is strictly behind
// each plane that it passed. Limits are compared with exactly: of the nearest one, limit 2^-exponent is at least a
// half, or it was scaled up.
#include <query/ray_path.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <exact/lattice.h>

namespace pierce::detail {

namespace {

/// x > 0 as fraction 2^exponent, with the fraction's highest bit as the highest of 64.
struct Parts {
    std::uint64_t fraction;
    int exponent;
    int last_bit;  ///< exponent of the last bit that is set

    explicit Parts(double x) {
        const Bits bits(x);
        const int zeros = std::countl_zero(bits.mantissa);
        fraction = bits.mantissa << zeros;
        exponent = bits.exponent - zeros;
        last_bit = bits.exponent + std::countr_zero(bits.mantissa);
    }
    [[nodiscard]] int size() const { return exponent + 64; }  ///< the least k with x < 2^k
};

/// A k with (1 + 2^-50) x < 2^k d, for x > 0: the least or the next one.
int exponent_above(const Parts& x, const Parts& d) {
    return x.exponent - d.exponent + ((x.fraction >> 1) + (std::uint64_t{1} << 14) >= d.fraction >> 1 ? 1 : 0);
}

/// x 2^exponent, where that is a double or x is infinite.
double scaled(double x, int exponent) {
    const auto power = [](int k) { return std::bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52); };
    for (; exponent > 1000; exponent -= 1000) x *= power(1000);
    for (; exponent < -1000; exponent += 1000) x *= power(-1000);
    return x * power(exponent);
}

}  // namespace

bool set_ray_path(const Box& bounds, const Point& origin, const Point& direction, double limit, double most,
                  bool floats, Path& path) {
    constexpr int k_none = std::numeric_limits<int>::max();
    constexpr int k_lowest = std::numeric_limits<double>::min_exponent - std::numeric_limits<double>::digits;
    if (!(limit > 0) || !(most >= 0)) return false;
    int exponent = k_none;
    int least = -5000;  // of which each component is a double
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
        const Parts parts(std::abs(d));
        exponent = std::min(exponent, exponent_above(Parts(std::max(halves, least_way)), parts) + 1);
        least = std::max(least, k_lowest - parts.last_bit);
        largest = std::min(largest, std::numeric_limits<double>::max_exponent - parts.size());
    }
    if (exponent == k_none) return false;
    // Past a limit as well: one at the end of the way could not be told from the end.
    const double nearest = most > 0 ? std::min(limit, most) : limit;
    if (nearest < std::numeric_limits<double>::infinity()) exponent = std::min(exponent, Parts(nearest).size());
    exponent = std::min(std::max(exponent, least), largest);

    path.from = origin;
    path.ray = true;
    path.exponent = exponent;
    path.wild = false;
    for (std::size_t k = 0; k < 3; ++k) {
        path.to[k] = scaled(direction[k], exponent);
        const double size = std::abs(path.to[k]);
        path.wild = path.wild || (floats && size != 0 && !(size >= 0x1p-200 && size <= 0x1p200));
    }
    path.most = scaled(most, -exponent);
    const double end = scaled(limit, -exponent);
    path.end = end <= 1 ? end : std::numeric_limits<double>::infinity();
    return true;
}

}  // namespace pierce::detail
