// The values of a hit, each with a bound for its error: what evaluate.h finds, and first_place.h chooses a place from.
#pragma once

#include <cstdint>

namespace pierce::detail {

/// What is known of a place, by its distance from the plane.
enum class Tried : std::uint8_t {
    far,     ///< certainly on the start's side, and a grain off the plane or as far off as the start
    unfit,   ///< certainly not, or too far from the true point
    unsure,  ///< only exact arithmetic can tell
};

/// Vectors have a fourth number that means nothing, but for `weights`. Errors are infinite where there is no bound.
struct Values {
    double weights[4];        ///< of a, b and c; then the fraction; each rounded, in [0, 1]
    double weight_error;      ///< of each, before it was rounded
    double fraction_error;    ///< before it was rounded
    double normal[4];         ///< towards the front
    double normal_error;      ///< of the normal as a vector, before it was rounded
    double normal_errors[4];  ///< of each component, as it is here
    double length;            ///< |normal|
    double length_error;      ///< the sum of normal_errors
    /// Of the start from the plane, in units of |normal|: at least that but for a rounding, or about, unless `located`.
    double distance;
    double high[4];  ///< `high + low` is within `error` of the true point
    double low[4];
    double error[4];
    // What follows depends on the Scalar that values are rounded to.
    double position[4];  ///< the true point, rounded
    bool rounded;        ///< correctly
    bool located;        ///< `error` is at most a sixteenth of a unit of the search for a place
    double point[4];     ///< the first place tried
    Tried tried;         ///< what is known of it
};

/// What of that goes into a hit.
template <class Scalar>
struct Rounded {
    Scalar point[4];
    Scalar position[4];
    Scalar normal[4];  ///< of length 1
    Scalar weights[4];
};

}  // namespace pierce::detail
