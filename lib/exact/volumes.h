// The five determinants that say everything about a segment and a triangle, as integers.
#pragma once

#include <exact/lattice.h>

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
        : from_(on_lattice<N>(path.from, lattice)), to_(on_lattice<N>(path.to, lattice)),
          corner_{on_lattice<N>(corners[0], lattice), on_lattice<N>(corners[1], lattice),
                  on_lattice<N>(corners[2], lattice)},
          normal_(cross(corner_[1] - corner_[0], corner_[2] - corner_[0])) {}

    [[nodiscard]] Integer<3 * N> from_side() const { return side_volume<N>(normal_, corner_[0], from_); }
    [[nodiscard]] Integer<3 * N> to_side() const { return side_volume<N>(normal_, corner_[0], to_); }

    /// (to - from) . ((next - from) x (other - from)) for corner k, where `other` and `next` are the two corners after it.
    /// The three add up to from_side() - to_side(); divided by that sum they are the barycentric weights of the point where the
    /// line through the segment meets the plane (Cramer's rule). In front of the triangle the weight is positive
    /// on the inner side of the edge opposite to corner k.
    [[nodiscard]] Integer<3 * N> weight(int k) const {
        const Vector<N> after = corner_[(k + 1) % 3] - from_;
        const Vector<N> before = corner_[(k + 2) % 3] - from_;
        return dot(to_ - from_, cross(before, after));
    }

    [[nodiscard]] const Vector<2 * N>& normal() const { return normal_; }
    [[nodiscard]] Vector<N> direction() const { return to_ - from_; }
    /// From the corner before corner k to the one after it: the edge opposite to it, backwards.
    [[nodiscard]] Vector<N> edge_against(int k) const { return corner_[(k + 1) % 3] - corner_[(k + 2) % 3]; }

  private:
    Vector<N> from_;
    Vector<N> to_;
    Vector<N> corner_[3];
    Vector<2 * N> normal_;
};

[[nodiscard]] inline Lattice lattice_of(const Path& path, const Corners& corners) {
    Lattice lattice;
    lattice.add(path.from);
    lattice.add(path.to);
    for (const Point& corner : corners) lattice.add(corner);
    return lattice;
}

/// Calls `f` with the `Volumes` of a segment and a triangle, in the least width that holds them.
template <class F>
decltype(auto) with_volumes(const Path& path, const Corners& corners, F&& f) {
    const Lattice lattice = lattice_of(path, corners);
    return with_limbs(lattice.bits(),
                      [&]<int N>(std::integral_constant<int, N>) { return f(Volumes<N>(path, corners, lattice)); });
}

}  // namespace pierce::detail
