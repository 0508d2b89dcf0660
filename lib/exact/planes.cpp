// The planes of Bloom's test for one triangle, rounded once from their exact values.
#include <exact/planes.h>

#include <algorithm>
#include <limits>

#include <exact/ratio.h>
#include <exact/volumes.h>

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

// A component of the normal, with its sign.
struct Component {
    Magnitude size;
    bool negative;
};

double signed_ratio(const Accumulator& numerator, const Magnitude& denominator) {
    const double value = ratio(magnitude(numerator), denominator);
    return numerator.sign() < 0 ? -value : value;
}

// |n|^2 from the highest bits of n: all terms are >= 0, so nothing cancels. A component is cut below 2^-63 of the
// largest, each square below 2^-62 and to 2^-126; the sum below 2^-61.4, which leaves the quotient within 2^-61 with
// the 2^-63 of its numerator.
Magnitude square_of(const Component (&normal)[3], int length) {
    Wide sum = 0;
    for (const Component& component : normal) {
        if (component.size.zero()) continue;
        const int below = length - bit_length(component.size);
        if (below >= 64) continue;
        const std::uint64_t top = top_bits(component.size) >> below;
        sum += (static_cast<Wide>(top) * top) >> 2;
    }
    // In units of 2^(2 (length - 64) + 2), brought to an exponent that is all that a quotient asks of it.
    Magnitude square;
    square.limb[0] = static_cast<std::uint64_t>(sum);
    square.limb[1] = static_cast<std::uint64_t>(sum >> 64);
    square.exponent = 2 * length - 126;
    square.trim(2);
    return square;
}

Planes wide_planes(const Corners& corners, const Lattice& lattice) {
    const OddPoint a = odd(corners[0]);
    const OddPoint b = odd(corners[1]);
    const OddPoint c = odd(corners[2]);
    Planes planes{};
    Component normal[3];
    int length = std::numeric_limits<int>::min();
    for (std::size_t k = 0; k < 3; ++k) {
        const Accumulator n = WideVolumes::wide_normal(a, b, c, k, lattice);
        normal[k] = {magnitude(n), n.sign() < 0};
        if (!normal[k].size.zero()) length = std::max(length, bit_length(normal[k].size));
    }
    if (length == std::numeric_limits<int>::min()) return planes;
    const Magnitude square = square_of(normal, length);
    // Component k of n x (q - p), over |n|^2.
    const auto weight = [&](const OddPoint& p, const OddPoint& q, std::size_t k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        Accumulator sum(lattice, 3);
        sum.add(normal[i].negative, normal[i].size, q[j]);
        sum.add(!normal[i].negative, normal[i].size, p[j]);
        sum.add(!normal[j].negative, normal[j].size, q[i]);
        sum.add(normal[j].negative, normal[j].size, p[i]);
        return signed_ratio(sum, square);
    };
    for (std::size_t k = 0; k < 3; ++k) {
        if (!normal[k].size.zero()) {
            const int bits = bit_length(normal[k].size);
            planes.normal[k] = rounded(top_bits(normal[k].size), bits - 64 - length);
            if (normal[k].negative) planes.normal[k] = -planes.normal[k];
        }
        planes.weight_c[k] = weight(a, b, k);
        planes.weight_a[k] = weight(b, c, k);
    }
    return planes;
}

}  // namespace

Planes exact_planes(const Corners& corners) {
    Lattice lattice;
    for (const Point& corner : corners) lattice.add(corner);
    const auto narrow = [&]<int N>(std::integral_constant<int, N>) {
        const Vector<N> a = on_lattice<N>(corners[0], lattice);
        const Vector<N> b = on_lattice<N>(corners[1], lattice);
        const Vector<N> c = on_lattice<N>(corners[2], lattice);
        const Vector<2 * N> normal = cross(b - a, c - a);
        // With coordinates below 2^m, a component of n is below 2^(2m+3), one of n x edge below 2^(3m+5), and |n|^2
        // below 2^(4m+8): with m <= 64 N - 4 (with_limbs) they fit 2N, 3N and 4N limbs.
        const Integer<4 * N> norm = dot(normal, normal);
        Planes planes{};
        if (norm.zero()) return planes;
        int length = 0;
        for (const Integer<2 * N>& component : normal) length = std::max(length, bit_length(magnitude(component)));
        for (std::size_t k = 0; k < 3; ++k) planes.normal[k] = to_double(normal[k], -length);
        planes.weight_c = over<N>(cross(normal, b - a), norm, lattice.lowest);
        planes.weight_a = over<N>(cross(normal, c - b), norm, lattice.lowest);
        return planes;
    };
    return with_limbs(lattice.bits(), narrow, [&] { return wide_planes(corners, lattice); });
}

}  // namespace pierce::detail
