// The narrow phase of an instruction set, as a table of functions: the filter's verdict on a triangle of a record, and
// the values of one that is hit. All sets answer the same bits.
#pragma once

#include <cstddef>

#include <kernel/per_scalar.h>
#include <kernel/values.h>
#include <kernel/verdict.h>

namespace pierce::detail {

struct Measured;

/// A triangle of a record: nine numbers, `stride` apart.
template <class Scalar>
struct Row {
    const Scalar* first;
    std::size_t stride;
};

template <class Scalar>
struct NarrowKernels {
    /// Whether a path hits a triangle under `sides`, strictly or where volumes are certainly 0 (filter.h). Sets
    /// `measured` in any case. `ray`: `to` is a direction.
    void (*filter)(Row<Scalar> row, const double* from, const double* to, bool ray, Sides sides, Filtered& filtered,
                   Measured& measured);
    /// Values of a triangle that is hit, as good as double (for floats) or double-double gives them, and the first
    /// place to be tried for the point.
    void (*evaluate)(const Measured& measured, Sides side, double grain, Values& values, Rounded<Scalar>& rounded);
    /// The same always in double-double.
    void (*evaluate_finely)(const Measured& measured, Sides side, double grain, Values& values,
                            Rounded<Scalar>& rounded);
};

using Narrow = PerScalar<NarrowKernels>;

// One for each file narrow_*.cpp.
extern const Narrow k_narrow;
extern const Narrow k_narrow_fused;

}  // namespace pierce::detail
