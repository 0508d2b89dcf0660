// The polynomials in time of a moving point and a moving triangle: what exact decisions are made on.
//
// Seen from the point the corners move linearly: A(t), B(t), C(t). The point is in the plane where f = -det(A, B, C), a
// cubic, is 0. Its weights there are those of B x C, C x A and A x B, which are parallel then: any component tells, so
// quadratics are enough (with n = (B - A) x (C - A), the sum of the three, the weight of c is A x B . n / |n|^2).
#pragma once

#include <motion/moving.h>
#include <motion/polynomial.h>

namespace pierce::detail {

[[nodiscard]] inline Lattice lattice_of(const MovingPoint& point, const MovingTriangle& triangle) {
    Lattice lattice;
    for (int i = 0; i < 2; ++i) {
        lattice.add(point.at[i]);
        for (const Point& corner : triangle.at[i]) lattice.add(corner);
    }
    return lattice;
}

/// With coordinates below 2^L on their lattice (`lattice_of`) the corners seen from the point are below 2^(L+1): `S`
/// limbs. Coefficients of quadratics are below 2^(2L+5), of f below 2^(3L+9).
template <int S, int C>
class Course {
  public:
    Course(const MovingPoint& point, const MovingTriangle& triangle, const Lattice& lattice) {
        for (int i = 0; i < 2; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                const auto p = whole<S>(point.at[i][k], lattice);
                for (std::size_t corner = 0; corner < 3; ++corner) {
                    corner_[i][corner][k] = whole<S>(triangle.at[i][corner][k], lattice);
                    add_to(corner_[i][corner][k], p, true);
                }
            }
    }

    /// f, positive where the point is in front of the triangle.
    void set_volume(Bernstein<C>& f) const {
        f.degree = 3;
        for (auto& b : f.b) b.count = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            Bernstein<C> area;
            set_area(0, k, area);
            // The coefficients in between, as sums, are three times f's; the area's ends are twice what they are.
            for (int i = 0; i < 2; ++i) {
                const Whole<S>& a = corner_[i][0][k];
                add_product(f.b[i], a, area.b[0], true);
                add_product(f.b[i + 1], a, area.b[1], true);
                add_product(f.b[i + 1], a, area.b[1], true);
                add_product(f.b[i + 2], a, area.b[2], true);
            }
        }
        const Whole<C> three = whole<C>(3);
        f.b[0] = f.b[0] * three;
        f.b[3] = f.b[3] * three;
    }

    /// A component of the cross product of the corners after corner `corner`: in the plane the weight of that corner.
    void set_area(int corner, std::size_t axis, Bernstein<C>& q) const {
        const auto& p = static_cast<std::size_t>((corner + 1) % 3);
        const auto& r = static_cast<std::size_t>((corner + 2) % 3);
        const std::size_t x = (axis + 1) % 3;
        const std::size_t y = (axis + 2) % 3;
        set_products(q, [&](int i, int j, Whole<C>& out) {
            add_product(out, corner_[i][p][x], corner_[j][r][y]);
            add_product(out, corner_[i][p][y], corner_[j][r][x], true);
        });
    }

    /// The scalar product of two corners.
    void set_dot(int p, int r, Bernstein<C>& q) const {
        set_products(q, [&](int i, int j, Whole<C>& out) {
            for (std::size_t k = 0; k < 3; ++k) add_product(out, corner_[i][p][k], corner_[j][r][k]);
        });
    }

  private:
    // Twice the polynomial: its coefficient in between is half the sum of two.
    template <class Add>
    static void set_products(Bernstein<C>& q, Add&& add) {
        q.degree = 2;
        for (auto& b : q.b) b.count = 0;
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j) add(i, j, q.b[i + j]);
        shift_up(q.b[0], 1);
        shift_up(q.b[2], 1);
    }

    Whole<S> corner_[2][3][3];
};

}  // namespace pierce::detail
