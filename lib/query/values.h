// What is certified about a triangle that is hit, each value by the cheapest arithmetic that is certainly good enough: double (for float only),
// double-double, exact integers.
#pragma once

#include <optional>
#include <type_traits>

#include <exact/decide.h>
#include <exact/fraction.h>
#include <exact/planes.h>
#include <kernel/spot.h>
#include <pierce/options.h>

namespace pierce::detail {

/// The values of a meeting, each rounded once.
template <class Number>
[[nodiscard]] Measures quotients(const Meeting<Number>& meeting) {
    const typename Arithmetic<Number>::Divisor over_s(meeting.s);
    const auto share = [&](const Number& w) { return std::clamp(over_s(w), 0.0, 1.0); };
    return {over_s(meeting.v), {share(meeting.w.x), share(meeting.w.y), share(meeting.w.z)}};
}

/// What could be said of a hit's place without exact arithmetic.
struct Located {
    bool spot = false;     ///< near enough to choose a place from
    bool rounded = false;  ///< and the true point is correctly rounded
};

/// `Scalar`: what the values will be rounded to.
template <class Scalar>
class CertifiedFace {
  public:
    /// `corners` must live as long.
    CertifiedFace(const Corners& corners, QueryCounters& counters) : corners_(corners), counters_(counters), plane_(corners_) {}
    CertifiedFace(const CertifiedFace&) = delete;
    CertifiedFace& operator=(const CertifiedFace&) = delete;

    /// The normal up to a factor, each component within 2^-28 (for float) or 2^-52 (for double) of the largest.
    [[nodiscard]] Point normal() {
        if (plane_.has_normal(k_tolerance)) return point(plane_.normal);
        if (k_coarse && finer().has_normal(k_tolerance)) return point(finer().normal);
        ++counters_.exact_values;
        return exact_planes(corners_).normal;
    }

    /// Fraction and weights of a hit, within `k_tolerance` of themselves and of 1 before they are rounded to double.
    [[nodiscard]] Measures measures(const Path& path, const Decision& decision) {
        // On an edge some weights are exactly 0, which only exact arithmetic gives. (At the start the fraction is; but then no computed
        // one is within a part of itself.)
        if (decision.feature == Feature::face) {
            const Meeting meeting(plane_, path);
            if (meeting.within(k_tolerance)) return quotients(meeting);
            if (k_coarse) {
                const Meeting closer(finer(), path);
                if (closer.within(k_tolerance)) return quotients(closer);
            }
        }
        ++counters_.exact_values;
        return measure(path, corners_);
    }

    /// The true point of a hit, within a sixteenth of `unit` in each coordinate, and correctly rounded.
    [[nodiscard]] Located locate(const Path& path, double unit, Spot& spot, Point& position) {
        Located located = located_by(plane_, path, unit, spot, position);
        if (k_coarse && !located.rounded) {
            Spot closer;
            const Located by_finer = located_by(finer(), path, unit, closer, position);
            if (by_finer.spot) spot = closer, located = by_finer;
        }
        return located;
    }

    static constexpr bool k_coarse = std::is_same_v<Scalar, float>;
    /// Of all values, before they are rounded: at most a thirty-second of the unit of rounding.
    static constexpr double k_tolerance = k_coarse ? 0x1p-29 : 0x1p-58;

  private:
    template <class Number>
    static Located located_by(const Plane<Number>& plane, const Path& path, double unit, Spot& spot, Point& position) {
        if (!find_spot(plane, Meeting(plane, path), path, spot)) return {};
        if (!(std::max({spot.error[0], spot.error[1], spot.error[2]}) <= unit / 16)) return {};
        return {true, round_position<Scalar>(spot, position)};
    }

    static Point point(const Triple<double>& p) { return {p.x, p.y, p.z}; }

    [[nodiscard]] const Plane<DoubleDouble>& finer() {
        if (!finer_) finer_.emplace(corners_);
        return *finer_;
    }

    const Corners& corners_;
    QueryCounters& counters_;
    const Plane<std::conditional_t<k_coarse, double, DoubleDouble>> plane_;
    std::optional<Plane<DoubleDouble>> finer_;  ///< for float, where it is needed
};

}  // namespace pierce::detail
