// The table of one instruction set's narrow phase.
#pragma once

#include <kernel/evaluate.h>
#include <kernel/filter.h>
#include <kernel/first_place.h>
#include <kernel/narrow.h>

namespace pierce::detail {

namespace {

template <class Four, class Scalar>
struct NarrowOf {
    [[gnu::always_inline]] static Pair pair(Scalar x, double y) { return Pair{static_cast<double>(x), y}; }
    [[gnu::always_inline]] static void measure_row(Row<Scalar> row, const double* from, const double* to, bool ray,
                                                   Measured& measured) {
        const Scalar* x = row.first;
        const std::size_t n = row.stride;
        const auto both_of = [ x, n ](std::size_t i, std::size_t j) __attribute__((always_inline)) {
            return Pair{static_cast<double>(x[i * n]), static_cast<double>(x[j * n])};
        };
        measure_lines<Scalar>({{both_of(3, 0), both_of(4, 1), both_of(5, 2)},
                               {pair(x[6 * n], to[0]), pair(x[7 * n], to[1]), pair(x[8 * n], to[2])},
                               {pair(x[0], from[0]), pair(x[n], from[1]), pair(x[2 * n], from[2])},
                               kept_of(ray)},
                              measured);
    }

    static void filter_row(Row<Scalar> row, const double* from, const double* to, bool ray, Sides sides,
                           Filtered& filtered, Measured& measured) {
        measure_row(row, from, to, ray, measured);
        filter<Four>(measured, sides, filtered);
    }

    template <class Number>
    [[gnu::always_inline]] static void answer(const Measured& measured, Sides side, double grain, Values& values,
                                              Rounded<Scalar>& rounded) {
        const PlaceOf of = place_of(measured, grain, side);
        if constexpr (sizeof(Number) == sizeof(Pair)) {
            evaluate<Scalar, Four>(measured, measured.meeting, of.unit, values);
        } else {
            Meeting<Number> finer;
            meet(measured.lines, finer);
            evaluate<Scalar, Four>(measured, finer, of.unit, values);
        }
        finish(of, values, rounded);
    }
    /// Tries the first place, and rounds all.
    [[gnu::always_inline]] static void finish(const PlaceOf& of, Values& values, Rounded<Scalar>& rounded) {
        Four point;
        values.tried = try_place<Scalar>(values, of, off_plane<Four>(values, of), k_outwards, point);
        point.store(values.point);
        point.round_to(rounded.point);
        Four::load(values.position).round_to(rounded.position);
        Four::load(values.weights).round_to(rounded.weights);
        (Four::all(1 / values.length) * Four::load(values.normal)).round_to(rounded.normal);
    }
    static void coarse(const Measured& measured, Sides side, double grain, Values& values, Rounded<Scalar>& rounded) {
        answer<Pair>(measured, side, grain, values, rounded);
    }
    static void fine(const Measured& measured, Sides side, double grain, Values& values, Rounded<Scalar>& rounded) {
        answer<BasicDoubleDouble<Pair, typename Four::Product>>(measured, side, grain, values, rounded);
    }
    static constexpr NarrowKernels<Scalar> table() {
        return {filter_row, sizeof(Scalar) == sizeof(float) ? coarse : fine, fine};
    }
};

template <class Four>
constexpr Narrow narrow_of() {
    return {NarrowOf<Four, float>::table(), NarrowOf<Four, double>::table()};
}

}  // namespace

}  // namespace pierce::detail
