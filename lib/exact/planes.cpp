// The planes of Bloom's test for one triangle, rounded once from their exact values.
#include <exact/planes.h>

#include <algorithm>

#include <exact/lattice.h>
#include <exact/ratio.h>

namespace pierce::detail {

namespace {

// v / |n|^2, where the lattice's unit is 2^unit: v is a length cubed and |n|^2 a length to the fourth.
template <int N>
Point over(const Vector<3 * N>& v, const Integer<4 * N>& norm, int unit) {
    Point plane{};
    for (std::size_t k = 0; k < 3; ++k) {
        plane[k] = ratio(magnitude(v[k]), norm, -unit);
        if (v[k].negative()) plane[k] = -plane[k];
    }
    return plane;
}

}  // namespace

Planes exact_planes(const Corners& corners) {
    Lattice lattice;
    for (const Point& corner : corners) lattice.add(corner);
    return with_limbs(lattice.bits(), [&]<int N>(std::integral_constant<int, N>) {
        const Vector<N> a = on_lattice<N>(corners[0], lattice);
        const Vector<N> b = on_lattice<N>(corners[1], lattice);
        const Vector<N> c = on_lattice<N>(corners[2], lattice);
        const Vector<2 * N> normal = cross(b - a, c - a);
        // With coordinates below 2^m, a component of n is below 2^(2m+3), one of n x edge below 2^(3m+5), and |n|^2 below
        // 2^(4m+8): with m <= 64 N - 4 (with_limbs) they fit 2N, 3N and 4N limbs.
        const Integer<4 * N> norm = dot(normal, normal);
        Planes planes{};
        if (norm.zero()) return planes;
        int length = 0;
        for (const Integer<2 * N>& component : normal) length = std::max(length, bit_length(magnitude(component)));
        for (std::size_t k = 0; k < 3; ++k) planes.normal[k] = to_double(normal[k], -length);
        planes.weight_c = over<N>(cross(normal, b - a), norm, lattice.lowest);
        planes.weight_a = over<N>(cross(normal, c - b), norm, lattice.lowest);
        return planes;
    });
}

}  // namespace pierce::detail
