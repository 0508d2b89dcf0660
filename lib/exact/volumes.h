// The five determinants that say everything about a segment and a triangle, in either arithmetic: integers of a fixed
// width, and sums of products for coordinates too far apart for them. The rules read signs, and are written once.
#pragma once

#include <exact/magnitude.h>

namespace pierce::detail {

/// n . (x - a) with n = (b - a) x (c - a): six times the volume of a, b, c, x; positive in front of the triangle.
template <int N>
[[nodiscard]] inline Integer<3 * N> side_volume(const Vector<2 * N>& normal, const Vector<N>& a, const Vector<N>& x) {
    return dot(x - a, normal);
}

/// A segment and a triangle on their common lattice, with coordinates that fit N limbs (`with_limbs`).
template <int N>
class Volumes {
  public:
    Volumes(const Path& path, const Corners& corners, const Lattice& lattice)
        : Volumes(on_lattice<N>(path.from, lattice),
                  path.ray ? on_lattice<N>(path.from, lattice) + on_lattice<N>(path.to, lattice)
                           : on_lattice<N>(path.to, lattice),
                  corners, lattice) {}
    /// From one point to another, each a coordinate or the sum or difference of two.
    Volumes(const Vector<N>& from, const Vector<N>& end, const Corners& corners, const Lattice& lattice)
        : from_(from),
          end_(end),
          way_(end_ - from_),
          corner_{on_lattice<N>(corners[0], lattice), on_lattice<N>(corners[1], lattice),
                  on_lattice<N>(corners[2], lattice)},
          normal_(cross(corner_[1] - corner_[0], corner_[2] - corner_[0])) {}

    [[nodiscard]] Integer<3 * N> from_side() const { return side_volume<N>(normal_, corner_[0], from_); }
    [[nodiscard]] Integer<3 * N> to_side() const { return side_volume<N>(normal_, corner_[0], end_); }

    /// way . ((next - from) x (other - from)) for corner k, where `other` and `next` are the two corners after
    /// it.
    /// The three add up to from_side() - to_side(); divided by that sum they are the barycentric weights of the point
    /// where the line through the segment meets the plane (Cramer's rule). In front of the triangle the weight is
    /// positive on the inner side of the edge opposite to corner k.
    [[nodiscard]] Integer<3 * N> weight(int k) const {
        const Vector<N> after = corner_[(k + 1) % 3] - from_;
        const Vector<N> before = corner_[(k + 2) % 3] - from_;
        return dot(way_, cross(before, after));
    }

    /// Component k of the normal.
    [[nodiscard]] const Integer<2 * N>& normal(std::size_t k) const { return normal_[k]; }
    /// The sign of n . (e, e^2, e^3) for e -> 0+.
    [[nodiscard]] int normal_shift() const { return first_sign(normal_); }
    /// The same for way x (the edge opposite to corner k, from the corner before it to the one after it).
    [[nodiscard]] int edge_shift(int k) const {
        return first_sign(cross(way_, corner_[(k + 1) % 3] - corner_[(k + 2) % 3]));
    }

  private:
    static int first_sign(const Vector<2 * N>& v) {
        for (const Integer<2 * N>& component : v)
            if (const int sign = component.sign(); sign != 0) return sign;
        return 0;
    }

    Vector<N> from_;
    Vector<N> end_;
    Vector<N> way_;
    Vector<N> corner_[3];
    Vector<2 * N> normal_;
};

/// A row (x, y, z, 1), or (x, y, z, 0) for a direction, of the determinant that a volume is.
struct WideRow {
    const OddPoint* at;
    bool direction = false;
};

/// Adds (b - a) x (c - a) . (x - a), which is minus the determinant of the rows (p, 1), p = a, b, c, x. It is linear in
/// each row, so a point that is a sum is two rows, of which one is a direction.
///
/// By Laplace along two pairs of columns, x y and z w: for each pair of rows i < j with the others k < l,
/// (-1)^(i+j+1) (x_i y_j - x_j y_i) (z_k w_l - z_l w_k).
inline void add_volume(const WideRow& a, const WideRow& b, const WideRow& c, const WideRow& x, Accumulator& sum) {
    const auto rows = [&sum](bool minus, const WideRow& i, const WideRow& j, const WideRow& k, const WideRow& l) {
        const Odd zero(0);
        const Odd& first = l.direction ? zero : (*k.at)[2];
        const Odd& second = k.direction ? zero : (*l.at)[2];
        sum.add(minus, (*i.at)[0], (*j.at)[1], first, second);
        sum.add(!minus, (*j.at)[0], (*i.at)[1], first, second);
    };
    rows(true, a, b, c, x);
    rows(false, a, c, b, x);
    rows(true, a, x, b, c);
    rows(true, b, c, a, x);
    rows(false, b, x, a, c);
    rows(true, c, x, a, b);
}

/// The same for any finite doubles.
class WideVolumes {
  public:
    WideVolumes(const Path& path, const Corners& corners, const Lattice& lattice)
        : lattice_(lattice),
          from_(odd(path.from)),
          to_(odd(path.to)),
          ray_(path.ray),
          corner_{odd(corners[0]), odd(corners[1]), odd(corners[2])} {}

    [[nodiscard]] Accumulator from_side() const {
        Accumulator sum(lattice_, 3);
        add_volume({&corner_[0]}, {&corner_[1]}, {&corner_[2]}, {&from_}, sum);
        return sum;
    }
    [[nodiscard]] Accumulator to_side() const {
        Accumulator sum(lattice_, 3);
        if (ray_) add_volume({&corner_[0]}, {&corner_[1]}, {&corner_[2]}, {&from_}, sum);
        add_volume({&corner_[0]}, {&corner_[1]}, {&corner_[2]}, {&to_, ray_}, sum);
        return sum;
    }
    [[nodiscard]] Accumulator weight(int k) const {
        Accumulator sum(lattice_, 3);
        add_volume({&from_}, {&corner_[(k + 2) % 3]}, {&corner_[(k + 1) % 3]}, {&to_, ray_}, sum);
        return sum;
    }

    [[nodiscard]] Accumulator normal(std::size_t k) const {
        return wide_normal(corner_[0], corner_[1], corner_[2], k, lattice_);
    }
    [[nodiscard]] int normal_shift() const {
        for (std::size_t k = 0; k < 3; ++k)
            if (const int sign = normal(k).sign(); sign != 0) return sign;
        return 0;
    }
    [[nodiscard]] int edge_shift(int corner) const {
        const OddPoint& head = corner_[(corner + 1) % 3];
        const OddPoint& tail = corner_[(corner + 2) % 3];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = (k + 1) % 3;
            const std::size_t j = (k + 2) % 3;
            Accumulator sum(lattice_, 2);
            for (const bool minus : {false, true}) {
                if (minus && ray_) continue;
                const OddPoint& p = minus ? from_ : to_;
                sum.add(minus, p[i], head[j]);
                sum.add(!minus, p[i], tail[j]);
                sum.add(!minus, p[j], head[i]);
                sum.add(minus, p[j], tail[i]);
            }
            if (const int sign = sum.sign(); sign != 0) return sign;
        }
        return 0;
    }

    /// Component k of (b - a) x (c - a), as a x b + b x c + c x a.
    static Accumulator wide_normal(const OddPoint& a, const OddPoint& b, const OddPoint& c, std::size_t k,
                                   const Lattice& lattice) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        Accumulator sum(lattice, 2);
        for (const auto& [p, q] : {std::pair{&a, &b}, {&b, &c}, {&c, &a}}) {
            sum.add(false, (*p)[i], (*q)[j]);
            sum.add(true, (*p)[j], (*q)[i]);
        }
        return sum;
    }

  private:
    Lattice lattice_;
    OddPoint from_;
    OddPoint to_;  ///< of a ray, the way
    bool ray_;
    OddPoint corner_[3];
};

[[nodiscard]] inline Lattice lattice_of(const Path& path, const Corners& corners) {
    Lattice lattice;
    lattice.add(path.from);
    lattice.add(path.to);
    for (const Point& corner : corners) lattice.add(corner);
    return lattice;
}

/// Calls `f` with the `Volumes` of a segment and a triangle, in the least width that holds them, else its
/// `WideVolumes`.
template <class F>
decltype(auto) with_volumes(const Path& path, const Corners& corners, F&& f) {
    const Lattice lattice = lattice_of(path, corners);
    return with_limbs(
        lattice.bits(), [&]<int N>(std::integral_constant<int, N>) { return f(Volumes<N>(path, corners, lattice)); },
        [&] { return f(WideVolumes(path, corners, lattice)); });
}

}  // namespace pierce::detail
