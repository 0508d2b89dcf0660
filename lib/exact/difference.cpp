// Ways between differences: the same volumes, of ends that take one bit more, or of rows that are sums.
#include <exact/difference.h>

#include <exact/ratio.h>
#include <exact/shares.h>
#include <exact/volumes.h>

namespace pierce::detail {

namespace {

// With coordinates below 2^b the ends are below 2^(b+1), and so as far from a corner as b + 2 bits say, as is the way:
// a minor of two such is below 2^(2b+5), a weight, three products of a minor and the way, below 2^(3b+9); a side, whose
// minors are of edges, below 2^(3b+7). With b <= 64 N - 4 that is 192 N - 3 bits, and a sum of two sides 192 N - 4.

/// For coordinates too far apart: each end is two rows, the point and minus what it is seen from as a direction.
class WideDifferenceVolumes {
  public:
    WideDifferenceVolumes(const DifferencePath& path, const Corners& corners, const Lattice& lattice)
        : lattice_(lattice),
          from_{odd(path.from), minus(path.from_off)},
          to_{odd(path.to), minus(path.to_off)},
          corner_{odd(corners[0]), odd(corners[1]), odd(corners[2])} {}

    [[nodiscard]] Accumulator from_side() const { return side(from_); }
    [[nodiscard]] Accumulator to_side() const { return side(to_); }
    [[nodiscard]] Accumulator weight(int k) const {
        Accumulator sum(lattice_, 3);
        for (const bool off : {false, true})
            for (const bool end_off : {false, true})
                add_volume({&from_[off ? 1 : 0], off}, {&corner_[(k + 2) % 3]}, {&corner_[(k + 1) % 3]},
                           {&to_[end_off ? 1 : 0], end_off}, sum);
        return sum;
    }

  private:
    static OddPoint minus(const Point& p) { return odd({-p[0], -p[1], -p[2]}); }
    [[nodiscard]] Accumulator side(const OddPoint (&end)[2]) const {
        Accumulator sum(lattice_, 3);
        for (const bool off : {false, true})
            add_volume({&corner_[0]}, {&corner_[1]}, {&corner_[2]}, {&end[off ? 1 : 0], off}, sum);
        return sum;
    }

    Lattice lattice_;
    OddPoint from_[2];
    OddPoint to_[2];
    OddPoint corner_[3];
};

Lattice lattice_of(const DifferencePath& path, const Corners& corners) {
    Lattice lattice;
    for (const Point* p : {&path.from, &path.from_off, &path.to, &path.to_off}) lattice.add(*p);
    for (const Point& corner : corners) lattice.add(corner);
    return lattice;
}

template <int N>
Volumes<N> volumes_of(const DifferencePath& path, const Corners& corners, const Lattice& lattice) {
    return {on_lattice<N>(path.from, lattice) - on_lattice<N>(path.from_off, lattice),
            on_lattice<N>(path.to, lattice) - on_lattice<N>(path.to_off, lattice), corners, lattice};
}

template <class F>
decltype(auto) with_volumes(const DifferencePath& path, const Corners& corners, F&& f) {
    const Lattice lattice = lattice_of(path, corners);
    return with_limbs(
        lattice.bits(), [&]<int N>(std::integral_constant<int, N>) { return f(volumes_of<N>(path, corners, lattice)); },
        [&] { return f(WideDifferenceVolumes(path, corners, lattice)); });
}

}  // namespace

Decision decide(const DifferencePath& path, const Corners& corners, Sides sides) {
    return with_volumes(path, corners, [sides](const auto& volumes) {
        return closed_rule(volumes.from_side().sign(), volumes.to_side().sign(), sides,
                           [&volumes](int k) { return volumes.weight(k).sign(); });
    });
}

int compare_fractions(const DifferencePath& path, const Corners& first, const Corners& second) {
    Lattice lattice = lattice_of(path, first);
    for (const Point& corner : second) lattice.add(corner);
    return with_limbs(
        lattice.bits(),
        [&]<int N>(std::integral_constant<int, N>) {
            return compare_shares(volumes_of<N>(path, first, lattice), volumes_of<N>(path, second, lattice));
        },
        [&] {
            return compare_shares(WideDifferenceVolumes(path, first, lattice),
                                  WideDifferenceVolumes(path, second, lattice));
        });
}

int compare_fraction(const DifferencePath& path, const Corners& corners, double limit) {
    return with_volumes(path, corners, [limit](const auto& volumes) { return compare_share(volumes, limit); });
}

double measure_fraction(const DifferencePath& path, const Corners& corners) {
    return with_volumes(path, corners, [](const auto& volumes) {
        const auto a = magnitude(volumes.from_side());
        return ratio(a, a + magnitude(volumes.to_side()));
    });
}

}  // namespace pierce::detail
