// The order of crossings: by the parameters of the moved path, as polynomials in the infinitesimal e.
//
// A path from F along d, moved by s = (e, e^2, e^3), meets the plane n . (x - a) = 0 at the parameter
//
//     t(s) = -(n . (F - a) + n . s) / (n . d) = t - g . s,    g = n / (n . d).
//
// n . d is not 0: a path that crosses has its moved ends on the two sides of the plane, both are moved by the same
// vector, and their heights n . (x - a) differ by n . d. So of two crossings that with the smaller t comes first. Where
// these are equal the difference of the parameters is (g2 - g1) . s = c1 e + c2 e^2 + c3 e^3, whose sign for e -> 0+ is
// that of the first component that is not 0: the crossing with the larger first component of g comes first.
//
// All three equal: g1 = g2 says that the normals are parallel, t1 = t2 that the planes have a point in common. Then
// they are one plane, and the converse holds as well. So this is a strict weak order, whose ties are the coincident
// planes.
//
// g1 > g2 in component k is n1 (n2 . d) > n2 (n1 . d), turned round where the slopes n . d have different signs: degree
// 2 times degree 3 in the coordinates. (A slope is below 2^(3b+8) by `with_limbs`, which leaves room for its sign.)
#include <exact/crossing_order.h>

#include <exact/fraction.h>
#include <exact/volumes.h>

namespace pierce::detail {

namespace {

/// n . d of a triangle that is crossed: heights of the ends are of different signs, or one of them is 0.
template <class Volumes>
struct Slope {
    explicit Slope(const Volumes& volumes)
        : from(magnitude(volumes.from_side())), to(magnitude(volumes.to_side())), size(from + to) {
        const int start = volumes.from_side().sign();
        sign = start != 0 ? -start : volumes.to_side().sign();
    }

    decltype(magnitude(std::declval<Volumes>().from_side())) from;
    decltype(from) to;
    decltype(from) size;
    int sign;
};

template <class Volumes>
int order(const Volumes& one, const Volumes& two) {
    const Slope first(one);
    const Slope second(two);
    // t = |from| / (|from| + |to|), as in fraction.cpp.
    if (const int sign = compare_products(first.from, second.to, second.from, first.to); sign != 0) return sign;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto n1 = one.normal(k);
        const auto n2 = two.normal(k);
        const int left = n1.sign() * first.sign;
        const int right = n2.sign() * second.sign;
        if (left != right) return left > right ? -1 : 1;
        if (left == 0) continue;
        const int sign = compare_products(magnitude(n1), second.size, magnitude(n2), first.size);
        if (sign != 0) return sign * left > 0 ? -1 : 1;
    }
    return 0;
}

}  // namespace

int compare_crossings(const Path& path, const Corners& first, const Corners& second) {
    if (first == second || in_one_axis_plane(first, second)) return 0;
    Lattice lattice = lattice_of(path, first);
    for (const Point& corner : second) lattice.add(corner);
    return with_limbs(
        lattice.bits(),
        [&]<int N>(std::integral_constant<int, N>) {
            return order(Volumes<N>(path, first, lattice), Volumes<N>(path, second, lattice));
        },
        [&] { return order(WideVolumes(path, first, lattice), WideVolumes(path, second, lattice)); });
}

}  // namespace pierce::detail
