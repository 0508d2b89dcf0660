// How a cluster is named and how its record is laid out: plain memory, which kernels read as well.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pierce::detail {

/// Names a cluster: bit 31 is set, bits 28-30 are the number of its triangles less one, bits 0-27 the place of its
/// first triangle. (A tree's child reference without bit 31 is the number of a node.)
using ClusterRef = std::uint32_t;
constexpr ClusterRef k_leaf_bit = 0x80000000U;
constexpr unsigned k_most_in_cluster = 8;
constexpr std::size_t k_most_triangles = std::size_t{1} << 28;

// Always inlined: the wide kernels' files may share no function with others, whatever the optimiser does.
[[nodiscard, gnu::always_inline]] constexpr ClusterRef cluster_ref(std::uint32_t first, unsigned count) {
    return k_leaf_bit | (count - 1) << 28 | first;
}
[[nodiscard, gnu::always_inline]] constexpr unsigned count_of(ClusterRef ref) { return (ref >> 28 & 7) + 1; }
[[nodiscard, gnu::always_inline]] constexpr std::uint32_t first_of(ClusterRef ref) { return ref & 0x0fffffffU; }

/// Scalars that a triangle takes in its record: nine coordinates and its number.
constexpr std::size_t k_row_count = 10;
/// What a kernel may read behind the last record, in Scalars.
constexpr std::size_t k_beyond_records = 16;
/// The number of what is no triangle: of the record that an empty place of a node leads to.
constexpr std::uint32_t k_no_triangle = 0xffffffffU;

}  // namespace pierce::detail
