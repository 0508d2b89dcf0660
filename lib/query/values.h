// What is certified about a triangle that is hit, each value by the cheapest arithmetic that is certainly good enough:
// double (for float only),
// double-double, exact integers.
#pragma once

#include <exact/fraction.h>
#include <exact/planes.h>
#include <kernel/filter.h>
#include <kernel/refine.h>
#include <pierce/options.h>

namespace pierce::detail {

/// What could be said of a hit's place without exact arithmetic.
struct Located {
    const Spot* spot = nullptr;  ///< near enough to choose a place from, as long as the face lives
    bool rounded = false;        ///< and the true point is correctly rounded
};

/// `Scalar`: what the values will be rounded to.
template <class Scalar>
class CertifiedFace {
  public:
    /// All must live as long. `measured`: of this path.
    CertifiedFace(const Path& path, const Measured& measured, const Decision& decision, const Refine& refine,
                  QueryCounters& counters)
        : path_(path), measured_(measured), decision_(decision), refine_(refine), counters_(counters) {
        if constexpr (k_coarse)
            evaluate(measured_, measured_.meeting, values_);
        else
            refine_(measured_, values_);
    }
    CertifiedFace(const CertifiedFace&) = delete;
    CertifiedFace& operator=(const CertifiedFace&) = delete;

    /// The normal up to a factor, each component within 2^-28 (for float) or 2^-52 (for double) of its length.
    [[nodiscard]] Point normal() {
        if (measured_.tame) {
            if (values_.normal_error <= k_tolerance * values_.length) return values_.spot.normal;
            if (k_coarse && finer().normal_error <= k_tolerance * finer().length) return finer().spot.normal;
        }
        ++counters_.exact_values;
        return exact_planes(corners_of(measured_)).normal;
    }

    /// Fraction and weights of a hit, within `k_tolerance` of themselves and of 1 before they are rounded to double.
    [[nodiscard]] Measures measures() {
        if (is_near(values_)) return measures_of(values_);
        if (k_coarse && is_near(finer())) return measures_of(finer());
        ++counters_.exact_values;
        return measure(path_, corners_of(measured_));
    }

    /// The true point of a hit, within a sixteenth of `unit` in each coordinate, and correctly rounded.
    [[nodiscard]] Located locate(double unit, Point& position) {
        Located located = located_by(values_, unit, position);
        if (k_coarse && !located.rounded) {
            const Located by_finer = located_by(finer(), unit, position);
            if (by_finer.spot != nullptr) located = by_finer;
        }
        return located;
    }

    static constexpr bool k_coarse = sizeof(Scalar) == sizeof(float);
    /// Of all values, before they are rounded: at most a thirty-second of the unit of rounding.
    static constexpr double k_tolerance = k_coarse ? 0x1p-29 : 0x1p-58;

  private:
    // At the start the fraction is exactly 0, and no computed one is within a part of itself.
    [[nodiscard]] bool is_near(const Values& x) const {
        return x.good && x.weight_error <= k_tolerance &&
               (decision_.at_start || x.fraction_error <= k_tolerance * x.fraction);
    }

    [[nodiscard]] Measures measures_of(const Values& x) const {
        Measures measures{x.fraction, {x.barycentric[0], x.barycentric[1], x.barycentric[2]}};
        if (decision_.at_start) measures.fraction = 0;
        if (decision_.feature == Feature::face) return measures;
        for (int k = 0; k < 3; ++k)
            if (is_off(decision_, k)) measures.barycentric[static_cast<std::size_t>(k)] = 0;
        if (decision_.feature == Feature::vertex) measures.barycentric[decision_.feature_index] = 1;
        return measures;
    }

    static Located located_by(const Values& x, double unit, Point& position) {
        const Point& error = x.spot.error;
        if (!x.good || !(std::max({error[0], error[1], error[2]}) <= unit / 16)) return {};
        return {&x.spot, round_position<Scalar>(x.spot, position)};
    }

    [[nodiscard]] const Values& finer() {
        if (!has_finer_) refine_(measured_, finer_);
        has_finer_ = true;
        return finer_;
    }

    const Path& path_;
    const Measured& measured_;
    const Decision& decision_;
    const Refine& refine_;
    QueryCounters& counters_;
    Values values_;
    Values finer_;  ///< for float, where it is needed
    bool has_finer_ = false;
};

}  // namespace pierce::detail
