// Where along a segment its hits lie.
#include <exact/fraction.h>

#include <exact/ratio.h>
#include <exact/volumes.h>

namespace pierce::detail {

// For a hit, from_side = F and to_side = T have opposite signs (or F is 0), so with A = |F| and B = |T| its fraction is
// A / (A + B), whichever side was hit.

int compare_fractions(const Path& path, const Corners& first, const Corners& second) {
    Lattice lattice = lattice_of(path, first);
    for (const Point& corner : second) lattice.add(corner);
    return with_limbs(lattice.bits(), [&]<int N>(std::integral_constant<int, N>) {
        const Volumes<N> one(path, first, lattice);
        const Volumes<N> two(path, second, lattice);
        // A1 / (A1 + B1) < A2 / (A2 + B2)  <=>  A1 B2 < A2 B1, all of them >= 0.
        return compare(magnitude(one.from_side()) * magnitude(two.to_side()),
                       magnitude(two.from_side()) * magnitude(one.to_side()));
    });
}

bool fraction_at_most(const Path& path, const Corners& corners, double limit) {
    if (!(limit >= 0)) return false;
    if (limit >= 1) return true;
    return with_volumes(path, corners, [limit]<int N>(const Volumes<N>& volumes) {
        const Integer<3 * N> a = magnitude(volumes.from_side());
        const Integer<3 * N> b = magnitude(volumes.to_side());
        const Integer<3 * N> sum = a + b;  // below 2^(192 N - 5), see with_limbs
        const Bits bits(limit);
        if (a.zero() || bits.mantissa == 0) return a.zero();
        // A <= limit (A + B)  <=>  A 2^shift <= mantissa (A + B), where limit = mantissa / 2^shift < 1.
        const int shift = -bits.exponent;
        // With mantissa < 2^53, a larger shift puts the right side below 1, and A is at least 1.
        if (shift > bit_length(sum) + 53) return false;
        Integer<1> mantissa;
        mantissa.limb[0] = bits.mantissa;
        const Integer<6 * N + 2> left = widen<6 * N + 2>(a) << shift;
        return compare(left, widen<6 * N + 2>(sum * mantissa)) <= 0;
    });
}

Measures measure(const Path& path, const Corners& corners) {
    return with_volumes(path, corners, []<int N>(const Volumes<N>& volumes) {
        const Integer<3 * N> a = magnitude(volumes.from_side());
        const Integer<3 * N> sum = a + magnitude(volumes.to_side());
        Measures measures{};
        measures.fraction = ratio(a, sum);
        for (int k = 0; k < 3; ++k)
            measures.barycentric[static_cast<std::size_t>(k)] = ratio(magnitude(volumes.weight(k)), sum);
        return measures;
    });
}

}  // namespace pierce::detail
