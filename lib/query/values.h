// What is certified about a triangle that is hit, each value by the cheapest arithmetic that is certainly good enough: double (for float only),
// double-double, exact integers.
#pragma once

#include <optional>
#include <type_traits>

#include <exact/decide.h>
#include <exact/fraction.h>
#include <exact/planes.h>
#include <kernel/plane.h>
#include <pierce/options.h>

namespace pierce::detail {

/// The values of a meeting, each rounded once.
template <class Number>
[[nodiscard]] Measures quotients(const Meeting<Number>& meeting) {
    const typename Arithmetic<Number>::Divisor over_s(meeting.s);
    const auto share = [&](const Number& w) { return std::clamp(over_s(w), 0.0, 1.0); };
    return {over_s(meeting.v), {share(meeting.w.x), share(meeting.w.y), share(meeting.w.z)}};
}

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

    /// The side of the plane that a point is on: as side_of.
    [[nodiscard]] int side(const Point& point) {
        int side = plane_.side(point);
        if (k_coarse && side == plane_.doubtful) side = finer().side(point);
        if (side != plane_.doubtful) return side;
        ++counters_.exact_sides;
        return side_of(corners_, point);
    }

    static constexpr bool k_coarse = std::is_same_v<Scalar, float>;
    /// Of all values, before they are rounded: at most a thirty-second of the unit of rounding.
    static constexpr double k_tolerance = k_coarse ? 0x1p-29 : 0x1p-58;

  private:
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
