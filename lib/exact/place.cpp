// The place of a hit in exact arithmetic.
#include <exact/place.h>

#include <cmath>
#include <limits>

#include <exact/volumes.h>

namespace pierce::detail {

namespace {

__extension__ using Rank = __int128;  // differences of ranks take 65 bits

// The numbers of a scalar in their order, as integers that follow one another; both zeros are 0.
template <class Scalar>
struct Ranks {
    using Whole = std::conditional_t<sizeof(Scalar) == 4, std::int32_t, std::int64_t>;

    static Rank of(Scalar x) {
        const auto bits = std::bit_cast<Whole>(std::abs(x));
        return std::signbit(x) ? -bits : bits;
    }
    static double value(Rank rank) {
        const auto x = static_cast<double>(std::bit_cast<Scalar>(static_cast<Whole>(rank < 0 ? -rank : rank)));
        return rank < 0 ? -x : x;
    }
};

// One coordinate of a hit: (B from + A end) / (A + B), A and B being the magnitudes of the ends' volumes. The end is
// `to`, or of a ray from + to.
class Coordinate {
  public:
    // The coordinate is not below `low`, and not above `high`.
    Coordinate(const Magnitude& a, const Magnitude& b, const Lattice& lattice, const Path& path, std::size_t k,
               double low, double high)
        : a_(a),
          b_(b),
          lattice_(lattice),
          from_(path.from[k]),
          to_(path.to[k]),
          ray_(path.ray),
          low_(low),
          high_(high) {}

    // The sign of twice the coordinate - (x + y): of A (2 end - x - y) + B (2 from - x - y).
    [[nodiscard]] int compare(double x, double y) const {
        Lattice lattice = lattice_;
        lattice.add(x);
        lattice.add(y);
        Accumulator sum(lattice, 4);
        for (int twice = 0; twice < 2; ++twice) {
            sum.add(false, a_, Odd(to_));
            if (ray_) sum.add(false, a_, Odd(from_));
            sum.add(false, b_, Odd(from_));
        }
        for (const double z : {x, y}) {
            sum.add(true, a_, Odd(z));
            sum.add(true, b_, Odd(z));
        }
        return sum.sign();
    }

    // The least number whose middle to the next one it does not pass. `start`: where to look first; from there in steps
    // that double, then by halves.
    template <class Scalar>
    [[nodiscard]] double rounded(double start) const {
        using R = Ranks<Scalar>;
        const auto passes = [this](Rank rank) {
            const int sign = compare(R::value(rank), R::value(rank + 1));
            return sign > 0 || (sign == 0 && rank % 2 != 0);
        };
        Rank low = R::of(static_cast<Scalar>(low_));
        Rank high = R::of(static_cast<Scalar>(high_));
        const Rank at = std::clamp(R::of(static_cast<Scalar>(start)), low, high);
        Rank step = 1;
        if (at < high && passes(at)) {
            for (low = at + 1; low + step < high && passes(low + step); step += step) low += step + 1;
            high = std::min(high, low + step);
        } else {
            for (high = at; high - step > low && !passes(high - step); step += step) high -= step;
            low = std::max(low, high - step);
        }
        while (low < high) {
            const Rank middle = low + (high - low) / 2;
            if (passes(middle))
                low = middle + 1;
            else
                high = middle;
        }
        return R::value(low);
    }

  private:
    const Magnitude& a_;
    const Magnitude& b_;
    const Lattice& lattice_;
    double from_;
    double to_;
    bool ray_;
    double low_;
    double high_;
};

// A number > 0 as mantissa 2^exponent, within 2^-60 of itself.
struct Scaled {
    double mantissa;
    int exponent;

    explicit Scaled(const Magnitude& x)
        : mantissa(std::ldexp(static_cast<double>(top_bits(x)), -64)), exponent(bit_length(x)) {}
};

}  // namespace

template <class Scalar>
Point exact_position(const Path& path, const Corners& corners, const Point& near) {
    const Lattice lattice = lattice_of(path, corners);
    const WideVolumes volumes(path, corners, lattice);
    const Magnitude a = magnitude(volumes.from_side());
    const Magnitude b = magnitude(volumes.to_side());
    if (a.zero()) return path.from;
    if (b.zero() && !path.ray) return path.to;
    Point position{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double from = path.from[k];
        const double to = path.to[k];
        // A ray's end is no number: there what bounds the point is the triangle.
        const double low = path.ray ? std::min({corners[0][k], corners[1][k], corners[2][k]}) : std::min(from, to);
        const double high = path.ray ? std::max({corners[0][k], corners[1][k], corners[2][k]}) : std::max(from, to);
        position[k] = Coordinate(a, b, lattice, path, k, low, high).rounded<Scalar>(std::clamp(near[k], low, high));
    }
    return position;
}

bool is_far_enough(const Corners& corners, const Point& from, const Point& point, double grain) {
    const Lattice lattice = lattice_of({from, point}, corners);
    const WideVolumes volumes({from, point}, corners, lattice);
    const Accumulator there = volumes.to_side();
    const Accumulator here = volumes.from_side();
    if (there.sign() == 0 || there.sign() != here.sign()) return false;
    const Magnitude volume = magnitude(there);
    if (compare_products(volume, Magnitude(1), magnitude(here), Magnitude(1)) >= 0) return true;

    // volume >= grain |n|, or just not: a point that lies exactly a grain off is not refused by the roundings here.
    const OddPoint a = odd(corners[0]);
    const OddPoint b = odd(corners[1]);
    const OddPoint c = odd(corners[2]);
    Magnitude normal[3];
    int highest = std::numeric_limits<int>::min();
    for (std::size_t k = 0; k < 3; ++k) {
        normal[k] = magnitude(WideVolumes::wide_normal(a, b, c, k, lattice));
        if (!normal[k].zero()) highest = std::max(highest, bit_length(normal[k]));
    }
    double square = 0;
    for (const Magnitude& component : normal) {
        if (component.zero()) continue;
        const Scaled scaled(component);
        const double x = std::ldexp(scaled.mantissa, std::max(scaled.exponent - highest, -200));
        square += x * x;
    }
    const Scaled far(volume);
    const int exponent =
        highest - far.exponent;  // of what is compared with 1/2 to 1; it is far away from that where it is large
    return far.mantissa >= std::ldexp(grain, std::clamp(exponent, -3000, 3000)) * std::sqrt(square) * (1 - 0x1p-41);
}

template Point exact_position<float>(const Path&, const Corners&, const Point&);
template Point exact_position<double>(const Path&, const Corners&, const Point&);

}  // namespace pierce::detail
