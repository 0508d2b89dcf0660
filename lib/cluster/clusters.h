// The triangles in records of up to eight that are near one another: the leaves of the tree, what the grid's cells
// list, what kernels read.
#pragma once

#include <cstring>

#include <cluster/record.h>
#include <point.h>
#include <raw_array.h>

namespace pierce::detail {

/// The box of a cluster, in scene units (Frame in node.h), rounded outward by nothing: coordinates times a power of
/// two.
template <class Scalar>
struct ClusterBox {
    Scalar low[3];
    ClusterRef ref;
    Scalar high[3];
    std::uint32_t key;  ///< of its first triangle: 30 bits of a Morton order
};

/// A record of n triangles: nine rows of n Scalars (a.x, a.y, a.z, b.x, ... c.z), then n places of a Scalar's size
/// whose first four bytes are the triangle's number in the caller's order. Records lie one behind the other, at
/// `k_row_count` times the place of their first triangle. One more, of a triangle that is a point and has the number
/// `k_no_triangle`, is behind the last; `empty` names it.
template <class Scalar>
struct Clusters {
    RawArray<Scalar> records;
    ClusterRef empty = k_leaf_bit;

    [[nodiscard]] const Scalar* record(ClusterRef ref) const { return records.data() + k_row_count * first_of(ref); }
    [[nodiscard]] Corners corners(ClusterRef ref, unsigned lane) const {
        const Scalar* x = record(ref) + lane;
        const std::size_t n = count_of(ref);
        const auto corner = [&](std::size_t k) {
            return Point{static_cast<double>(x[3 * k * n]), static_cast<double>(x[(3 * k + 1) * n]),
                         static_cast<double>(x[(3 * k + 2) * n])};
        };
        return {corner(0), corner(1), corner(2)};
    }
    [[nodiscard]] std::uint32_t triangle(ClusterRef ref, unsigned lane) const {
        std::uint32_t number;
        std::memcpy(&number, record(ref) + 9 * count_of(ref) + lane, sizeof number);
        return number;
    }
};

}  // namespace pierce::detail
