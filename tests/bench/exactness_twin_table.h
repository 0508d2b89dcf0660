// The inexact twin's narrow phase of one instruction set: the library's own code, told that nothing is off.
#pragma once

#include <kernel/narrow_table.h>

namespace pierce::detail {

namespace {

template <class Four, class Scalar>
struct TrustingOf {
    using Exact = NarrowOf<Four, Scalar>;

    static void filter(Row<Scalar> row, const double* from, const double* to, bool ray, Sides sides, Filtered& filtered,
                       Measured& x) {
        Exact::measure_row(row, from, to, ray, x);
        filtered.verdict = Verdict::miss;
        const double end = x.v() - x.s();
        const bool front = sides != Sides::back && x.v() <= 0 && end > 0;
        const bool back = sides != Sides::front && x.v() >= 0 && end < 0;
        if (!front && !back) return;
        const double a = x.s() - x.b() - x.c();
        if (front ? a > 0 || x.b() > 0 || x.c() > 0 : a < 0 || x.b() < 0 || x.c() < 0) return;
        filtered.verdict = Verdict::hit;
        filtered.decision = Decision{.hit = true, .side = front ? Sides::front : Sides::back};
        filtered.earliest = filtered.latest = x.v() / x.s();
    }
    static void evaluate_row(const Measured& measured, Sides side, double grain, Values& values,
                             Rounded<Scalar>& rounded) {
        const PlaceOf of = place_of(measured, grain, side);
        evaluate<Scalar, Four>(measured, measured.meeting, of.unit, values);
        const Four none = Four::all(0);
        none.store(values.error);
        none.store(values.normal_errors);
        values.length_error = 0;
        Exact::finish(of, values, rounded);
    }
    static constexpr NarrowKernels<Scalar> table() { return {filter, evaluate_row, evaluate_row}; }
};

template <class Four>
constexpr Narrow trusting_of() {
    return {TrustingOf<Four, float>::table(), TrustingOf<Four, double>::table()};
}

}  // namespace

}  // namespace pierce::detail
