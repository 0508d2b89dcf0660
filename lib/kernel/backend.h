// The wide kernels, one set for each instruction set: cull boxes, then refuse the triangles that a segment certainly misses.
//
// What is refused depends on the instruction set in the last bits of the bounds; what is hit does not: all that is left goes to
// the filter (filter.h) and where that is in doubt to exact arithmetic.
//
// A file of some hundred lines for each instruction set, not Highway: the algorithms are written once, over a dozen operations that each file
// gives them, and compilers' own vectors do the rest. Highway would be a dependency at link time, includes each file once more for each
// target. It was not tried.
#pragma once

#include <cstddef>
#include <cstdint>

#include <packed_level.h>

namespace pierce::detail {

/// A line as the wide kernels read it, in units of about a cell, so that single precision neither overflows nor underflows.
template <class Scalar>
struct Ray {
    Scalar origin[4];    ///< a point that the line passes; the segment's start where `ends` are asked about. The fourth is 0
    float direction[4];  ///< to - from, times `scale`, each component rounded once. The fourth: how far off, in each component and times
                         ///< `scale`, what a refusal is to hold for is from the line through the origin (lanes.h)
};

/// And what is asked of it.
template <class Scalar>
struct Probe {
    Ray<Scalar> ray;
    float scale;            ///< a power of two
    float ends;             ///< 1: ask also on which side of the plane the ends are, which needs the start as origin; 0: do not
    float unit;             ///< the rounding unit that the bounds are in: 2^-24 (a benchmark sets it to 0)
    std::uint32_t front;    ///< all bits set: hits from the front count
    std::uint32_t back;
};

/// The ends of many segments: number i is the three scalars at `from + i * from_stride`, and so on.
template <class Scalar>
struct Ends {
    const Scalar* from;
    const Scalar* to;
    std::ptrdiff_t from_stride;
    std::ptrdiff_t to_stride;
};

/// Kernels that have to do with the caller's numbers.
template <class Scalar>
struct ScalarKernels {
    /// The cells of some short segments in a level (many.h), at most `k_group` from `first` on, in their order: how many. `out` has room
    /// for `k_most_block` each; `looks` gets what each look says, if it is more than what it says already; `rays` those that have cells.
    unsigned (*find)(const PackedLevel& level, const Ends<Scalar>& ends, std::size_t first, unsigned count, float scale, Stop* out,
                     Look* looks, Ray<Scalar>* rays);
    /// The ids of the triangles that the segment may hit, in order; returns how many. `corners` has nine scalars a triangle, and one
    /// more at the end. `out` has room for `count`; `ids` for 7 more if their number is no multiple of 8, which are overwritten.
    unsigned (*refine)(const Probe<Scalar>& probe, const Scalar* corners, std::uint32_t* ids, unsigned count, std::uint32_t* out);
    /// The same for triangles of which each has the ray of its own query in place of that of the probe. `out` gets the places in the list that
    /// are left; `ids` and `queries` as `ids` of refine.
    unsigned (*refine_many)(const Probe<Scalar>& probe, const Ray<Scalar>* rays, const Scalar* corners, std::uint32_t* ids,
                            std::uint32_t* queries, unsigned count, std::uint32_t* out);
};

struct Backend {
    const char* name;
    /// The cells of a short segment in a level (block.h), culled: the ids that are left, how many cells there were. -1: too many cells, or
    /// `room` may not do for what they leave. `out` has 8 more.
    int (*look)(const PackedLevel& level, const double* from, const double* to, std::uint32_t* out, unsigned room,
                unsigned* cells);
    /// A walk through a level, see walk.h: `start_walk`, then `walk` until it gives fewer stops than there is room for.
    Walking (*start_walk)(const PackedLevel& level, const double* from, const double* to, double limit, bool once, Walk& walk);
    unsigned (*walk)(const PackedLevel& level, Walk& walk, double limit, Stop* stops, unsigned room);
    /// The ids of the boxes that `above` and `seen` leave (packed_box.h), in order; returns how many. Reads up to 7 boxes and ids
    /// beyond the last. `out` has room for `count` and 8 more.
    unsigned (*cull)(const std::uint64_t* boxes, const std::uint32_t* ids, unsigned count, std::uint64_t above, std::uint64_t seen,
                     std::uint32_t* out);
    /// The same for the cells of many queries: each id with its query. Both have room for all and 8 more. Asks memory for the triangles,
    /// which have so many bytes each from `corners` on.
    unsigned (*cull_many)(const Boxes* cells, unsigned count, const void* corners, std::size_t bytes, std::uint32_t* ids,
                          std::uint32_t* queries);
    ScalarKernels<float> of_floats;
    ScalarKernels<double> of_doubles;

    template <class Scalar>
    [[nodiscard]] const ScalarKernels<Scalar>& of() const {
        if constexpr (sizeof(Scalar) == sizeof(float)) return of_floats;
        else return of_doubles;
    }
    template <class Scalar>
    [[nodiscard]] unsigned refine(const Probe<Scalar>& probe, const Scalar* corners, std::uint32_t* ids, unsigned count,
                                  std::uint32_t* out) const {
        return of<Scalar>().refine(probe, corners, ids, count, out);
    }
};

}  // namespace pierce::detail
