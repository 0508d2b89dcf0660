// Which triangles of a cluster may a segment hit? Four or eight at a time, in float, with a bound: what is left out is
// certainly not hit.
//
// As Moller and Trumbore 1997, without division. Relative to corner a: edges p and q, start s = origin - a, direction
// d, n = p x q, r = s x d:
//   U = r . q,  V = -r . p,  W = -d . n - U - V    of one sign (or 0) where the line meets the triangle
//   T = n . s,  E = T + limit (n . d)              which sides of the plane the start and the point at `limit` are on
//
// The bounds. Let u = 2^-24; S, D, H the largest |components| of s, d, and of p and q. Each of these is rounded once
// (for double from an exact or nearly exact difference): within u of itself. Products of two are within 3u of S D, a
// component of r within 2 * 3u S D + u 2 S D = 8u S D, and at most 2 S D; a term r_k q_k within 12u S D H, three and
// two sums: 36u + (4 + 6)u < 48u S D H for U and V. In the same way 48u D H^2 for d . n, 48u S H^2 for T.
//   W: 48u D H^2 + 96u S D H, and two sums of at most 6 D H^2 + 6 S D H and 6 D H^2 + 12 S D H: 60u D H^2 + 114u S D H.
//   E: 54u S H^2 + 60u D H^2.
// The line may lie beside that of the segment by g in each component (the way to a rounded point; the rounded origin of
// a clipped segment). A way that hits the triangle at X has a point of the segment within g of X, and a line of
// direction d through X, so r changes by g x d, U and V by at most 6 g D H, W by 12 g D H; X is in the plane, so
// n . (the segment's point) is within 6 g H^2 of 0.
//   Bound for U, V, W: D H (64u H + 128u S + 12 g) =: e.    Bound for T and E: H^2 (64u S + 64u D + 6 g) =: f.
// (What is left of 64 and 128 is for terms of second order and the roundings of the bounds.) So the triangle is
// certainly missed where
//   one of U, V, W is above e and one below -e: the line, and each that is beside it, passes an edge on its outer side
//   T and E are both above f or both below -f: the segment up to `limit` stays on one side
//   T < -f and only fronts count, T > f and only backs.
// Underflow: a product loses at most 2^-150, times at most two others: `floor`, 2^-120 (1 + R)^2 with R >= S, D, H, is
// added. Overflow: for float the scene is between 2^-30 and 2^31 wide or `floor` is infinite; for double all are scene
// units, below 32. NaN and infinite bounds: each comparison is false, and nothing is refused.
#pragma once

#include <cluster/record.h>
#include <kernel/probe.h>

namespace pierce::detail {

/// Bit i is set where triangle i of the cluster may be hit before `limit`.
template <class Wide, class Scalar>
[[gnu::always_inline]] inline unsigned may_hit(const Probe<Scalar>& probe, const Scalar* record, unsigned count,
                                               unsigned first, float limit) {
    using Float = typename Wide::Float;
    const Scalar* at = record + first;
    const auto row = [&](unsigned r) {
        return Wide::corner_row(at + r * count, probe.corner_origin[r % 3], probe.scale);
    };
    // Relative to the origin: a = -s.
    const Float ax = row(0);
    const Float ay = row(1);
    const Float az = row(2);
    Float px, py, pz, qx, qy, qz;
    if constexpr (sizeof(Scalar) == sizeof(float)) {
        // Differences of corners: one rounding of the exact one.
        const auto edge = [&](unsigned r) { return Wide::load(at + r * count) - Wide::load(at + (r % 3) * count); };
        px = edge(3), py = edge(4), pz = edge(5), qx = edge(6), qy = edge(7), qz = edge(8);
    } else {
        const auto edge = [&](unsigned r) {
            return Wide::row_difference(at + r * count, at + (r % 3) * count, probe.scale);
        };
        px = edge(3), py = edge(4), pz = edge(5), qx = edge(6), qy = edge(7), qz = edge(8);
    }
    const Float dx = Wide::all(probe.corner_direction[0]);
    const Float dy = Wide::all(probe.corner_direction[1]);
    const Float dz = Wide::all(probe.corner_direction[2]);
    const Float nx = py * qz - pz * qy;
    const Float ny = pz * qx - px * qz;
    const Float nz = px * qy - py * qx;
    // r = s x d = d x a
    const Float rx = dy * az - dz * ay;
    const Float ry = dz * ax - dx * az;
    const Float rz = dx * ay - dy * ax;
    const Float dn = dx * nx + dy * ny + dz * nz;
    const Float u = rx * qx + ry * qy + rz * qz;
    const Float v = -(rx * px + ry * py + rz * pz);
    const Float w = -dn - u - v;
    const Float t = -(ax * nx + ay * ny + az * nz);
    const Float end = t + dn * Wide::all(limit);

    const Float s = Wide::max(Wide::abs(ax), Wide::max(Wide::abs(ay), Wide::abs(az)));
    const Float h =
        Wide::max(Wide::max(Wide::max(Wide::abs(px), Wide::abs(py)), Wide::max(Wide::abs(pz), Wide::abs(qx))),
                  Wide::max(Wide::abs(qy), Wide::abs(qz)));
    const Float floor = Wide::all(probe.floor);
    const Float e =
        h * (Wide::all(probe.edge_bound) * h + Wide::all(probe.start_bound) * s + Wide::all(probe.noise_bound)) + floor;
    const Float f = h * h * (Wide::all(probe.plane_bound) * s + Wide::all(probe.plane_noise)) + floor;

    const Float highest = Wide::max(u, Wide::max(v, w));
    const Float lowest = Wide::min(u, Wide::min(v, w));
    auto refused = Wide::both(Wide::below(e, highest), Wide::below(lowest, -e));
    refused = Wide::either(refused, Wide::below(f, Wide::min(t, end)));
    refused = Wide::either(refused, Wide::below(Wide::max(t, end), -f));
    if (probe.front_only) refused = Wide::either(refused, Wide::below(t, -f));
    if (probe.back_only) refused = Wide::either(refused, Wide::below(f, t));
    return ~Wide::bits(refused);
}

template <class Wide, class Scalar>
[[gnu::always_inline]] inline unsigned test_cluster(const Probe<Scalar>& probe, const Scalar* records,
                                                    ClusterRef cluster, float limit) {
    const unsigned count = count_of(cluster);
    const Scalar* record = records + k_row_count * first_of(cluster);
    unsigned lanes = may_hit<Wide>(probe, record, count, 0, limit);
    for (unsigned first = Wide::width; first < count; first += Wide::width)
        lanes = (lanes & ((1U << first) - 1)) | may_hit<Wide>(probe, record, count, first, limit) << first;
    return lanes & ((1U << count) - 1);
}

}  // namespace pierce::detail
