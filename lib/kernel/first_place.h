// The places that the point of a hit may come to: the true point moved a little and rounded, and whether a point is as
// far off the face's plane as it has to be (query/place.h says which and why); and how large the grain is.
#pragma once

#include <decision.h>
#include <kernel/four.h>
#include <kernel/meeting.h>
#include <kernel/values.h>

namespace pierce::detail {

/// How a place is rounded. Below 8: to nearest, but for the coordinates whose bit is set: those to the further of their
/// two neighbours.
inline constexpr unsigned k_to_nearest = 0;
inline constexpr unsigned k_outwards = 8;  ///< off the plane, so that no term of n . (point - P) lacks of the grain

/// Of a hit that starts off its face.
struct PlaceOf {
    double from[4];  ///< of the path
    double grain;    ///< how far off the plane the point keeps, unless the start is nearer
    double unit;     ///< the last place of the mesh's largest coordinate
    double side;     ///< 1: the start is in front; -1: behind
    double reach;    ///< how far from the true point a place may be, in units
};

/// The grain, in units in the last place of the mesh's largest |coordinate|.
///
/// Rounding moves a point by up to half a unit a coordinate, sqrt(3) / 2 in all, along a normal; a target projected
/// onto the plane takes three such roundings (the product, the difference, the sum): 2.6 units. Four is the least power
/// of two above. Measured, landings stuck (S1), slides by the book in float (S4: 160 of 5 inclines, 4 rates, 8 offsets;
/// the 24 of the test at offsets 0 and 1000), exact entries a step at rest in double, tilted, height 1 (T1):
///   units                        1      2      3      4      5      6      8
///   stuck of 230,000             0      0      0      0      0      0      0
///   of 160 slides off by > 5 %   1      2      4      4      4      5      4
///   the test's worst share    .991   .571   .766   .991   .571   .766   .571
///   exact entries a step      1.08   1.11   1.14   1.17   1.33   1.36   1.42
/// (The .571 and .766 are one slide each, at 1 degree and 240 steps a second, whose first steps are parts of a unit.)
/// So none of the three tells a larger one from a smaller: what decides is the bound above. place_test.cpp has the
/// three loops; each column is that test built with another number here.
inline constexpr double k_grain_units = 4;

/// How far from the true intersection a point may lie, in the same units, before points back along the way are tried.
inline constexpr double k_reach_units = k_grain_units + 8;

[[nodiscard]] [[gnu::always_inline]] inline PlaceOf place_of(const Measured& measured, double grain, Sides side) {
    const Triple<Pair>& af = measured.lines.af;
    return {{af.x[1], af.y[1], af.z[1], 0},
            grain,
            grain / k_grain_units,
            side == Sides::front ? 1.0 : -1.0,
            k_reach_units - 0.125};  // less a sixteenth of a unit that each coordinate of the true one may be off
}

/// Of a grain, so that a point that lies exactly a grain off is not refused by the roundings in Farness (2^-47).
inline constexpr double k_nearly = 1 - 0x1p-40;
/// More than products lose where they underflow, 2^-1075 each. A normal number: products with one that is not take 150
/// cycles.
inline constexpr double k_underflow = 0x1p-1000;

/// Whether a point is on the start's side, and a grain off the plane or as far off as the start. The first by
/// n . (point - P), P being in the plane, the second by n . (point - from): each term is off by what n and P may be
/// off, and 2^-51 of itself for its roundings and the sum's. (Where each term of the second has a factor that is
/// exactly 0, so is it.) Errors that are infinite prove nothing. `point` must be finite.
template <class Four>
class Farness {
  public:
    [[gnu::always_inline]] Farness(const Values& values, const PlaceOf& of, Four point)
        : values_(values),
          of_(of),
          point_(point),
          out_(Four::all(of.side) * Four::load(values.normal)),
          n_(magnitudes(out_)),
          dn_(Four::load(values.normal_errors) + Four::all(0x1p-51) * n_) {
        const Four x = (point - Four::load(values.high)) - Four::load(values.low);
        // Or the inverse of a subnormal unit would be infinite, and multiples of a huge one as well.
        const double scale = of.unit < 1 ? 0x1p60 : 0x1p-60;
        const Four units = Four::all(scale) * x * Four::all(1 / (of.unit * scale));
        const Four off = dn_ * magnitudes(x) + (n_ + dn_) * Four::load(values.error);
        const Four sums = Four::sums(out_ * x, off, units * units, units);
        from_plane_ = Four::lane(sums, 0);
        plane_error_ = 1.01 * (Four::lane(sums, 1) + k_underflow);
        square_ = Four::lane(sums, 2);
        wanted_ = k_nearly * of.grain * (values.length + values.length_error);
    }
    /// Whether the point is finite and within reach of the true one.
    [[nodiscard]] [[gnu::always_inline]] bool within_reach() const { return square_ <= of_.reach * of_.reach; }
    [[nodiscard]] [[gnu::always_inline]] Tried tried() const {
        if (from_plane_ - plane_error_ >= wanted_) [[likely]]
            return Tried::far;
        return by_start();
    }

  private:
    [[nodiscard]] [[gnu::always_inline]] Tried by_start() const {
        const Four zero = Four::all(0);
        const Four y = point_ - Four::load(of_.from);
        const Four is_zero = Four::equal(y, zero) | Four::equal(n_ + Four::load(values_.normal_errors), zero);
        const Four error = Four::select(is_zero, zero, dn_ * magnitudes(y) + Four::all(k_underflow));
        const Four sums = Four::sums(out_ * y, error, y, y);
        const double from_start = Four::lane(sums, 0);
        const double start_error = 1.01 * Four::lane(sums, 1);
        if (from_start >= start_error) return Tried::far;
        return from_plane_ + plane_error_ < wanted_ && from_start < -start_error ? Tried::unfit : Tried::unsure;
    }

    const Values& values_;
    const PlaceOf& of_;
    Four point_;
    Four out_;  ///< the normal, towards the start
    Four n_;
    Four dn_;
    double from_plane_;
    double plane_error_;
    double square_;
    double wanted_;
};

/// The way from the true point to where the first place is sought: off the plane by a grain, or as far as the start.
template <class Four>
[[nodiscard]] [[gnu::always_inline]] inline Four off_plane(const Values& values, const PlaceOf& of) {
    const double inverse = 1 / values.length;
    const double start = values.distance * inverse;
    const double off = start < of.grain ? start : of.grain;
    return Four::all(off) * (Four::all(inverse) * (Four::all(of.side) * Four::load(values.normal)));
}

/// The true point moved by `by` and rounded, to `point`, and what is known of that. No branch on how a coordinate is
/// rounded: it can't be predicted.
template <class Scalar, class Four>
[[nodiscard]] [[gnu::always_inline]] inline Tried try_place(const Values& values, const PlaceOf& of, Four by,
                                                            unsigned rounding, Four& point) {
    const Four zero = Four::all(0);
    const Four high = Four::load(values.high);
    const Four low = Four::load(values.low);
    const Four moved = low + by;
    const Four nearest = Four::template rounded<Scalar>(high + moved);
    const Four beyond = (nearest - high) - moved;
    const Four up = Four::less(beyond, zero);
    const Four down = Four::less(zero, beyond);
    Four turned;
    if (rounding == k_outwards) {
        const Four out = Four::all(of.side) * Four::load(values.normal);
        turned = (up & Four::less(zero, out)) | (down & Four::less(out, zero));
    } else {
        const auto bit = [rounding](unsigned k) __attribute__((always_inline)) {
            return static_cast<double>(rounding >> k & 1U);
        };
        turned = (up | down) & Four::less(zero, Four::of(Pair{bit(0), bit(1)}, Pair{bit(2), 0}));
    }
    point = Four::select(turned, Four::template next_to<Scalar>(nearest, -beyond), nearest);
    const Farness<Four> farness(values, of, point);
    return farness.within_reach() ? farness.tried() : Tried::unfit;
}

}  // namespace pierce::detail
