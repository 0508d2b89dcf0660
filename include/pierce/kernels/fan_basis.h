// The bases of Barnes' test: one for each triangle of a fan, and the change of coordinates from each to the next.
//
// Source: Barnes 2014, "A Beautiful Ray/Mesh Intersection Algorithm" (tavianator.com). The triangles are A R0 R1, A R1
// R2, ... In the basis of the first, p = A + u AB + v AC + w N, with B = R0, C = R1, N = AB x AC. Our derivation of the
// step to the next, A C D, where p = A + u' AC + v' AD + w' N' with N' = AC x AD: the origins agree, and AC is the
// first vector of the new basis. The other two are
//   AB = a AC + b AD + c N'     N = d AC + e AD + f N'
// and by Cramer's rule, over N'.N' = [AC AD N'],
//   a = (AB x AD).N'   b = (AC x AB).N'   c = AB.N'     d = (N x AD).N'   e = (AC x N).N'   f = N.N'
// Putting them into p gives u' = a u + v + d w, v' = b u + e w, w' = c u + f w: six numbers, 6 multiplications, 4
// additions a vector. All that is asked of N is its direction. Its length is chosen as `FanBasis` says, so that u, v, w
// and the six are free of units.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <pierce/kernels/number.h>

namespace pierce::kernels {

/// What a fan can be computed with, as a power of two: 40 for float, 320 for double. See `FanBasis`.
template <class Scalar>
inline constexpr int k_fan_range = std::numeric_limits<Scalar>::max_exponent * 5 / 16;

/// The affine map to the first triangle's basis.
template <class Number>
struct FanFirst {
    Plane<Number> u;         ///< weight of the first ring vertex
    Plane<Number> u_plus_v;  ///< both weights together
    Plane<Number> height;    ///< along N
};

/// From the basis of one triangle to that of the next. The first `a` of a fan is lowered by one, and in the last `a`
/// and `d` are a + b and d + e, see triangle_fan.h.
template <class Number>
struct FanTurn {
    /// The coefficients of the change of basis, as at the head of this file.
    Number a, b, c, d, e, f;
};

static_assert(sizeof(FanFirst<float>) == 12 * sizeof(float) && sizeof(FanTurn<float>) == 6 * sizeof(float));

/// Two edges at the apex times the power of two that brings their largest component between 1 and 2, and n = ab x ac
/// there, so that n.n has no fourth power of a length. N is n in the world's units, n / scale.
///
/// With R for `k_fan_range`, which allows the exponents -R - 1 .. R: edges are at most 2 sqrt(3) < 2^1.8 long, n 2^3.6,
/// and at least 2^-R. The edges and N of one basis are at most 2^(2 R + 1) times as large in the units of the next. So
/// the largest of the six, d and e, are at most 2^(3.6 + 2 R + 1) 2^1.8 / 2^-R = 2^(3 R + 6.4), for float 2^126.4, and
/// their numerators less; rows are at most 2^(R + 1) 2^1.8 / 2^-R.
template <class Scalar>
struct FanBasis {
    Triple<Scalar> ab;  ///< the first edge, scaled
    Triple<Scalar> ac;  ///< the second edge, scaled
    Triple<Scalar> n;   ///< their cross product
    Scalar square;      ///< n.n
    Scalar scale;       ///< the power of two
};

/// The basis of a triangle, if it is in the range of `k_fan_range`.
template <class Scalar>
[[nodiscard]] std::optional<FanBasis<Scalar>> fan_basis(const Triple<Scalar>& ab, const Triple<Scalar>& ac) {
    const Scalar size = std::max(std::abs(ab[largest(ab)]), std::abs(ac[largest(ac)]));
    const int exponent = std::ilogb(size);  // of zero, infinity and NaN far out of range
    if (exponent < -k_fan_range<Scalar> - 1 || exponent > k_fan_range<Scalar>) return std::nullopt;
    const Scalar scale = std::scalbn(Scalar{1}, -exponent);
    FanBasis<Scalar> basis{scale * ab, scale * ac, {}, {}, scale};
    basis.n = cross(basis.ab, basis.ac);
    basis.square = dot(basis.n, basis.n);
    if (!(basis.square >= std::scalbn(Scalar{1}, -2 * k_fan_range<Scalar>))) return std::nullopt;  // NaN too
    return basis;
}

/// The map to the first basis. Rows of the inverse of (AB, AC, N): the cross products of the other two columns, over
/// [AB AC N] = n.n / scale^3.
template <class Scalar>
[[nodiscard]] FanFirst<Scalar> fan_first(const FanBasis<Scalar>& b, const Triple<Scalar>& a) {
    const Scalar inverse = 1 / b.square;
    const auto row = [&](const Triple<Scalar>& x) { return plane(b.scale * (inverse * x), a); };
    // u + v is 1 on BC: (AC x N + N x AB) = N x (AB - AC)
    return {row(cross(b.ac, b.n)), row(cross(b.n, b.ab - b.ac)), row(b.n)};
}

/// From one basis to the next.
template <class Scalar>
[[nodiscard]] FanTurn<Scalar> fan_turn(const FanBasis<Scalar>& before, const FanBasis<Scalar>& basis, bool last) {
    const Scalar units = basis.scale / before.scale;
    const Triple<Scalar> ab = units * before.ab;
    const Triple<Scalar> normal = units * before.n;
    const Triple<Scalar>& ac = basis.ab;
    const Triple<Scalar>& ad = basis.ac;
    // a + b and d + e: (AB x AD + AC x AB) = AB x (AD - AC)
    const Triple<Scalar> other = last ? ad - ac : ad;
    const auto part = [&](const Triple<Scalar>& x) { return dot(x, basis.n) / basis.square; };
    return {part(cross(ab, other)),     part(cross(ac, ab)),     part(ab),
            part(cross(normal, other)), part(cross(ac, normal)), part(normal)};
}

}  // namespace pierce::kernels
