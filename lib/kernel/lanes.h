// The wide kernels' one algorithm, for any instruction set that says how to hold four or eight numbers at once.
//
// Included by backend_*.cpp, which are compiled with flags of their own: nothing here may be shared with other files, so no
// standard header with inline functions, and every function depends on a type of an unnamed namespace.
//
// refine: is the triangle a, b, c certainly missed? With a, b, c taken relative to the origin and d the direction:
//   wc = d . (a x b),  wa = d . (b x c),  wb = d . (c x a)     volumes of the line and each edge; all <= 0 for a hit of the front, all >= 0 for one of the back
//   s  = wa + wb + wc = d . n                                  n = (b-a) x (c-a)
//   v  = a . (b x c) = n . a                                   minus the origin's side; v - s is minus that of origin + d
// (Bailey's four determinants, `pierce::kernels::cramer`. Bloom's planes ask the same; but wide, tests/bench/table1 has all of these near to
// the time that reading the data takes, and determinants need nothing stored but the corners: README.md, "The narrow phase".)
//
// The bounds. Let u = 2^-24, M the largest |component| of the computed a, b, c and D that of d. Each difference x - origin and each d is
// rounded once to within u of itself (twice for double, the first time within 2^-53; scaling is exact). Then, for each component,
//   products of two, computed, are within 3u M^2 of the exact ones, a component of a cross product within 6u M^2 + u 2M^2 = 8u M^2,
//   and at most 2 M^2;
//   a term d_k c_k is within D 8u M^2 + u D 2M^2 + u D 2M^2 = 12u D M^2, three of them and two additions 36u + u (4 + 6) D M^2:
//   |err w| <= 46u D M^2 and terms of second order, below u: 48u D M^2.
// A line that passes the origin at a distance of h (in each component) in place of through it: w changes by
// d . (h x b + a x h), plus d . (h x h) = 0: at most 12 D M h. So w is certain beyond E = D M (48u M + 13 h).
//   With w certain of both signs the line passes beside the triangle, and so does every segment of which all points are within h of it:
//   where it met the triangle, a line of direction d through that point would too. Such are those to points of the segment that
//   were rounded. (All of one sign would do for the segment alone, if only one side counts. But one to a rounded point near the start can
//   go the other way through the plane: tests/query/verified_point_test.cpp.)
//   v in the same way: 48u M^3. s: 3 x 46u + u (12 + 18) < 170u D M^2. v - s: 48u M^3 + 170u D M^2 + u (6 M^3 + 18 D M^2) <
//   54u M^3 + 190u D M^2 < Ev = 64u M^2 (M + 3 D).
//   A start behind the plane is behind it for every segment from there, and is not hit from the front. But that the other end is on
//   the same side says nothing of a segment to a point within h of a start that is on the plane: both must be off it by more than h moves
//   them, |n . h| <= 24 M^2 h: Ev + 26 M^2 h.
// Fused operations round less often; the bounds hold with and without. The bounds themselves are computed with a few roundings,
// for which 46 to 48 and the like have room (2 of 48 is 2^-5). Underflow: what a denormal loses is at most 2^-149 times the at most 32
// products of the others, 2^-144 max(1, D) max(1, M)^2: 2^-126 (1 + D) (1 + M)^2 is added. Overflow: |w|, |v| <= 18 max(D, M)^3, all
// finite where D M^2 and M^3 are below 2^120; beyond, and for NaN, nothing is refused.
#pragma once

#include <kernel/backend.h>

namespace pierce::detail {

/// One triangle in each lane.
template <class Wide>
struct Lanes {
    typename Wide::Float x, y, z;
};

template <class Wide>
[[gnu::always_inline]] inline Lanes<Wide> cross(const Lanes<Wide>& p, const Lanes<Wide>& q) {
    return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}

template <class Wide>
[[gnu::always_inline]] inline typename Wide::Float dot(const Lanes<Wide>& p, const Lanes<Wide>& q) {
    return p.x * q.x + p.y * q.y + p.z * q.z;
}

template <class Wide>
[[gnu::always_inline]] inline typename Wide::Float largest(const Lanes<Wide>& p) {
    return Wide::max(Wide::abs(p.x), Wide::max(Wide::abs(p.y), Wide::abs(p.z)));
}

/// Bit i is set where lane i may be hit. `probe`: with the direction and the noise of each lane, all else for all of them.
template <class Wide, class Scalar>
[[gnu::always_inline]] inline unsigned may_hit(const Probe<Scalar>& probe, const Lanes<Wide>& d, const typename Wide::Float& noise,
                                               const Lanes<Wide>& a, const Lanes<Wide>& b, const Lanes<Wide>& c) {
    using Float = typename Wide::Float;
    const Lanes<Wide> bc = cross(b, c);
    const Float wa = dot(d, bc);
    const Float wb = dot(d, cross(c, a));
    const Float wc = dot(d, cross(a, b));
    const Float v = dot(a, bc);
    const Float end = v - (wa + wb + wc);

    const Float reach = largest(d);
    const Float most = Wide::max(largest(a), Wide::max(largest(b), largest(c)));
    const Float square = most * most;
    const Float more = most + Wide::all(1);
    const Float floor = Wide::all(0x1p-126F) * (Wide::all(1) + reach) * (more * more);
    const Float unit = Wide::all(probe.unit);
    const Float e = reach * most * (Wide::all(48) * unit * most + Wide::all(13) * noise) + floor;
    const Float ev = Wide::all(64) * unit * square * (most + Wide::all(3) * reach) + floor;

    // Each is the bits of lanes where the comparison is true: false for NaN, so that nothing is refused for it.
    const Float highest = Wide::max(wa, Wide::max(wb, wc));
    const Float lowest = Wide::min(wa, Wide::min(wb, wc));
    const unsigned beside = Wide::less(e, highest) & Wide::less(lowest, -e);
    unsigned front = beside;
    unsigned back = beside;
    if (probe.ends != 0) {
        const Float em = ev + Wide::all(26) * noise * square;
        const unsigned apart = (Wide::less(end, -em) & Wide::less(v, -em)) | (Wide::less(em, end) & Wide::less(em, v));
        front |= apart | Wide::less(ev, v);
        back |= apart | Wide::less(v, -ev);
    }
    const unsigned tame = Wide::less(square * (most + reach), Wide::all(0x1p120F));
    return ~(tame & (front | ~probe.front) & (back | ~probe.back));
}

/// Points relative to origins, a row for each point of a lane; row i is of the lanes i, i + 4, ..., or of all lanes where there is one row only.
template <class Wide, class Scalar, class Row>
[[gnu::always_inline]] inline Lanes<Wide> relative(const Scalar* const* at, const Row* origin, float scale) {
    const auto row = [&](unsigned i) { return Wide::scaled(Wide::row(at, i), origin[i], scale); };
    if constexpr (Wide::rows == 1) return row(0);
    else return Wide::columns(row(0), row(1), row(2), row(3));
}

/// Lanes without a list's entry of their own take the first one.
template <class Wide>
[[gnu::always_inline]] inline void fill_lanes(std::uint32_t* list, unsigned count) {
    if (count % Wide::width == 0) return;
    for (unsigned i = 0; i < Wide::width - 1; ++i) list[count + i] = list[0];
}

/// `may_hit` for as many triangles of a list as there are lanes; `here` of them count.
template <class Wide, class Scalar, class Row>
[[gnu::always_inline]] inline unsigned may_hit(const Probe<Scalar>& probe, const Lanes<Wide>& d, const typename Wide::Float& noise,
                                               const Row* origin, const Scalar* corners, const std::uint32_t* ids, unsigned here) {
    const Scalar* at[Wide::width];
    for (unsigned i = 0; i < Wide::width; ++i) at[i] = corners + 9 * std::size_t{ids[i]};
    const auto corner = [&](unsigned k) {
        const Scalar* x[Wide::width];
        for (unsigned i = 0; i < Wide::width; ++i) x[i] = at[i] + 3 * k;
        return relative<Wide>(x, origin, probe.scale);
    };
    const unsigned lanes = may_hit<Wide>(probe, d, noise, corner(0), corner(1), corner(2));
    return lanes & ((1U << here) - 1);
}

template <class Wide, class Scalar>
[[gnu::always_inline]] inline unsigned refine(const Probe<Scalar>& probe, const Scalar* corners, std::uint32_t* ids, unsigned count,
                                              std::uint32_t* out) {
    const Lanes<Wide> d = {Wide::all(probe.ray.direction[0]), Wide::all(probe.ray.direction[1]), Wide::all(probe.ray.direction[2])};
    const auto noise = Wide::all(probe.ray.direction[3]);
    const auto same = Wide::same_row(probe.ray.origin);
    const decltype(Wide::same_row(probe.ray.origin)) origin[] = {same, same, same, same};
    unsigned left = 0;
    fill_lanes<Wide>(ids, count);
    for (unsigned first = 0; first < count; first += Wide::width) {
        const unsigned here = count - first < Wide::width ? count - first : Wide::width;
        for (unsigned found = may_hit<Wide>(probe, d, noise, origin, corners, ids + first, here); found != 0; found &= found - 1)
            out[left++] = ids[first + static_cast<unsigned>(__builtin_ctz(found))];
    }
    return left;
}

template <class Wide>
[[gnu::always_inline]] inline unsigned cull(const std::uint64_t* boxes, const std::uint32_t* ids, unsigned count,
                                            std::uint64_t above, std::uint64_t seen, std::uint32_t* out) {
    const auto limit = Wide::bytes(above);
    const auto bits = Wide::bytes(seen);
    unsigned left = 0;
    unsigned first = 0;
    for (; first + Wide::boxes <= count; first += Wide::boxes)
        left += Wide::keep(Wide::left(boxes + first, limit, bits), ids + first, out + left);
    if (first < count) {
        const unsigned rest = (1U << (count - first)) - 1;
        left += Wide::keep(Wide::left(boxes + first, limit, bits) & rest, ids + first, out + left);
    }
    return left;
}

}  // namespace pierce::detail
