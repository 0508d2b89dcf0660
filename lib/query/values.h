// The values of a hit, each by the cheapest arithmetic that is certainly good enough: double (for float only),
// double-double, exact integers.
#pragma once

#include <cmath>
#include <limits>

#include <exact/fraction.h>
#include <exact/place.h>
#include <exact/planes.h>
#include <kernel/filter.h>
#include <kernel/narrow.h>
#include <pierce/options.h>

namespace pierce::detail {

/// Of all values, before they are rounded: at most a thirty-second of the unit of rounding.
template <class Scalar>
inline constexpr double k_tolerance = sizeof(Scalar) == sizeof(float) ? 0x1p-29 : 0x1p-58;

/// Whether fraction and weights of a hit are within `tolerance` of themselves and of 1. At the start the fraction is
/// exactly 0, and no computed one is within a part of itself.
[[nodiscard]] inline bool measures_are_near(const Values& x, const Decision& decision, double tolerance) {
    return x.weight_error <= tolerance && (decision.at_start || x.fraction_error <= tolerance * x.weights[3]);
}

/// The same for the normal. Where its square overflows the length is infinite, and so is the error: nothing is known.
template <class Scalar>
[[nodiscard]] inline bool normal_is_near(const Values& x) {
    return x.normal_error <= k_tolerance<Scalar> * x.length && x.length < std::numeric_limits<double>::infinity();
}

/// What a hit on an edge, a corner or at the start is known to have.
inline void set_features(const Path& path, const Decision& decision, Values& values) {
    if (decision.at_start) {
        values.weights[3] = 0;
        for (std::size_t k = 0; k < 3; ++k) values.position[k] = path.from[k];
    }
    if (decision.feature == Feature::face) return;
    for (int k = 0; k < 3; ++k)
        if (is_off(decision, k)) values.weights[k] = 0;
    if (decision.feature == Feature::vertex) values.weights[decision.feature_index] = 1;
}

/// Sets fraction and weights exactly, rounded once.
inline void measure_exactly(const Path& path, const Corners& corners, QueryCounters& counters, Values& values) {
    ++counters.exact_values;
    const Measures exact = measure(path, corners);
    for (std::size_t k = 0; k < 3; ++k) values.weights[k] = exact.barycentric[k];
    values.weights[3] = exact.fraction;
}

/// Where a hit lies, in double. Roundings are those of the largest number of a sum: far ends of a path say less than
/// the triangle, far corners less than the path.
[[nodiscard]] inline Point rough_position(const Path& path, const Corners& corners, const Values& values) {
    Point position{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double from = path.from[k];
        const double to = path.to[k];
        const double fraction = values.weights[3];
        double inside = 0;
        double furthest = 0;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            inside += values.weights[corner] * corners[corner][k];
            furthest = std::max(furthest, std::abs(corners[corner][k]));
        }
        const double along = path.ray ? from + to * fraction : from * (1 - fraction) + to * fraction;
        position[k] = furthest < std::max(std::abs(from), std::abs(to)) ? inside : along;
    }
    return position;
}

/// Whether all that `certify` sets is certain.
template <class Scalar>
[[nodiscard]] inline bool are_certain(const Values& x, const Decision& decision) {
    const bool near = measures_are_near(x, decision, k_tolerance<Scalar>);
    return near && normal_is_near<Scalar>(x) && (decision.at_start || (x.located && x.rounded));
}

/// Makes certain what is not.
template <class Scalar>
[[gnu::noinline]] void complete(const NarrowKernels<Scalar>& kernels, const Measured& measured, const Path& path,
                                const Decision& decision, double grain, QueryCounters& counters, Values& values,
                                Rounded<Scalar>& rounded) {
    constexpr double k_unknown = std::numeric_limits<double>::infinity();
    if (sizeof(Scalar) == sizeof(float)) {
        kernels.evaluate_finely(measured, decision.side, grain, values, rounded);
        if (are_certain<Scalar>(values, decision)) return;
    }
    const Corners corners = corners_of(measured);
    if (!measures_are_near(values, decision, k_tolerance<Scalar>)) measure_exactly(path, corners, counters, values);
    if (!normal_is_near<Scalar>(values)) {
        ++counters.exact_values;
        const Point normal = exact_planes(corners).normal;
        values.length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
        for (std::size_t k = 0; k < 3; ++k) values.normal[k] = normal[k];
        values.located = false;
    }
    if (decision.at_start || (values.located && values.rounded)) return;
    ++counters.exact_values;
    const Point position = exact_position<Scalar>(path, corners, rough_position(path, corners, values));
    for (std::size_t k = 0; k < 3; ++k) values.position[k] = position[k];
    values.rounded = true;
    if (values.located) return;
    // Half a unit off, and nothing proves anything.
    double distance = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        values.high[k] = position[k];
        values.low[k] = 0;
        values.error[k] = values.normal_errors[k] = k_unknown;
        distance += values.normal[k] * (path.from[k] - position[k]);
    }
    values.length_error = k_unknown;
    values.distance = std::abs(distance);
    values.tried = Tried::unfit;  // so all is left to the search
}

/// Values of a triangle that is hit: fraction and weights within `k_tolerance` of themselves and of 1 before they are
/// rounded to double, the normal up to a factor, each component within 2^-28 (for float) or 2^-52 (for double) of its
/// length; the true point correctly rounded to Scalar; and what is known of the first place to be tried, unless it
/// starts on the face.
template <class Scalar>
void certify(const NarrowKernels<Scalar>& kernels, const Measured& measured, const Path& path, const Decision& decision,
             double grain, QueryCounters& counters, Values& values, Rounded<Scalar>& rounded) {
    kernels.evaluate(measured, decision.side, grain, values, rounded);
    const bool certain = are_certain<Scalar>(values, decision);
    if (certain && decision.feature == Feature::face && !decision.at_start) [[likely]]
        return;
    if (!certain) complete(kernels, measured, path, decision, grain, counters, values, rounded);
    set_features(path, decision, values);
    for (std::size_t k = 0; k < 4; ++k) {
        rounded.position[k] = static_cast<Scalar>(values.position[k]);
        rounded.normal[k] = static_cast<Scalar>(1 / values.length * values.normal[k]);
        rounded.weights[k] = static_cast<Scalar>(values.weights[k]);
    }
}

/// Fraction and weights for the caller's own test, within 2^-58 of themselves and of 1 before they are rounded.
template <class Scalar>
[[nodiscard]] Measures fine_measures(const NarrowKernels<Scalar>& kernels, const Measured& measured, const Path& path,
                                     const Decision& decision, QueryCounters& counters) {
    Values values;
    Rounded<Scalar> unused;
    kernels.evaluate_finely(measured, decision.side, 1, values, unused);
    if (!measures_are_near(values, decision, k_tolerance<double>))
        measure_exactly(path, corners_of(measured), counters, values);
    set_features(path, decision, values);
    return {values.weights[3], {values.weights[0], values.weights[1], values.weights[2]}};
}

}  // namespace pierce::detail
