// The place of a hit: its true position, and the verified point.
//
// The verified point keeps to the start's side of the face, a grain off its plane, or as far off as the start was if that is less. On the plane itself,
// or nearer than what rounding does to any point of the mesh, a point would be behind it by the next rounding, or could not leave. So the first
// point to be tried is the true one P, moved off by a grain along the normal, rounded; then its coordinates are rounded outwards, so that no term of
// n . (point - P) lacks of the grain; then places around it, within eight units in the last place of the mesh's largest coordinate, which are
// clear where edges and corners of other faces are not; and only then points back along the way from the start.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <exact/place.h>
#include <pierce/hit.h>
#include <query/values.h>

namespace pierce::detail {

/// A unit in the last place of the mesh's largest |coordinate|, and the grain, in units of that.
///
/// Two units are what rounding a point of the mesh may do to its distance from a plane (half a unit a coordinate, sqrt(3) / 2 in all, for the point, and the
/// same for a target projected onto the plane). Measured: see tests/query/place_test.cpp.
inline constexpr double k_grain_units = 4;

template <class Scalar>
[[nodiscard]] double last_place(double largest) {
    using Limits = std::numeric_limits<Scalar>;
    const double unit = largest > 0 ? static_cast<double>(Limits::epsilon()) * std::ldexp(1.0, std::ilogb(largest)) : 0;
    return std::max(unit, static_cast<double>(Limits::denorm_min()));
}
template <class Scalar>
[[nodiscard]] double grain_of(double largest) {
    return k_grain_units * last_place<Scalar>(largest);
}
/// How far from the true intersection a point may be that `clear(point, true)` is asked about.
[[nodiscard]] constexpr double near_margin(double grain) { return grain * (1 + 8 / k_grain_units); }

template <class Scalar>
[[nodiscard]] Scalar rounded_down(double x) {
    const auto near = static_cast<Scalar>(x);
    return static_cast<double>(near) > x ? std::nextafter(near, -std::numeric_limits<Scalar>::infinity()) : near;
}

template <class Scalar>
[[nodiscard]] Point rounded_to(const Point& point) {
    const auto rounded = [](double x) { return static_cast<double>(static_cast<Scalar>(x)); };
    return {rounded(point[0]), rounded(point[1]), rounded(point[2])};
}

/// The number next to `x`, which is a Scalar and finite, in the direction of `sign`. Without a branch: which way it goes can't be predicted.
template <class Scalar>
[[nodiscard]] double next_to(double x, double sign) {
    using Bits = std::conditional_t<sizeof(Scalar) == 4, std::int32_t, std::int64_t>;
    constexpr Bits k_sign = std::numeric_limits<Bits>::min();
    const auto bits = std::bit_cast<Bits>(static_cast<Scalar>(x));
    const auto wanted = std::bit_cast<Bits>(static_cast<Scalar>(std::copysign(1.0, sign))) & k_sign;
    const Bits next = (bits & k_sign) == wanted ? bits + 1 : bits - 1;
    return static_cast<double>(std::bit_cast<Scalar>(x == 0 ? wanted | 1 : next));
}

/// Looks for the verified point of a hit that does not start on its face.
template <class Scalar, class Clear>
class PlaceSearch {
  public:
    /// `spot`: null where nothing but exact arithmetic is certain; `position` is the true point rounded, `normal` the face's.
    PlaceSearch(const Path& path, const Corners& corners, Sides side, double grain, const Spot* spot, const Point& position, const Point& normal,
                QueryCounters& counters, Clear& clear)
        : path_(path), corners_(corners), grain_(grain), unit_(grain / k_grain_units), per_unit_(1 / unit_), spot_(spot), counters_(counters), clear_(clear) {
        const Point& n = spot != nullptr ? spot->normal : normal;
        length_ = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        const double inverse = 1 / length_;
        double off = grain;
        const double sign = side == Sides::front ? 1 : -1;
        if (spot != nullptr) {
            high_ = spot->high;
            low_ = spot->low;
            off = std::min(grain, spot->distance * inverse);
        } else {
            high_ = position;
            double distance = 0;
            for (std::size_t k = 0; k < 3; ++k) distance += n[k] / length_ * (path.from[k] - position[k]);
            off = std::min(grain, std::abs(distance));
        }
        for (std::size_t k = 0; k < 3; ++k) {
            out_[k] = sign * n[k];
            unit_normal_[k] = out_[k] * inverse;
            off_[k] = off * unit_normal_[k];
        }
    }

    /// Sets `fraction` and `point`; `exact` is the true fraction, rounded once. Returns how many points were not clear.
    int find(double exact, Hit<Scalar>& hit) {
        // Below the true fraction, which `exact` is within CertifiedFace::k_tolerance of, and one rounding; two steps where it is denormal.
        const double below = std::max(0.0, exact * (1 - (sizeof(Scalar) == 4 ? 0x1p-28 : 0x1p-52)) - 0x1p-1073);
        if (find_near(hit)) {
            hit.fraction = same_as_start(hit) ? Scalar{0} : rounded_down<Scalar>(below);
            return tries_;
        }
        find_back(below, hit);
        return tries_;
    }

  private:
    bool find_near(Hit<Scalar>& hit) {
        const Point none{};
        if (try_near(none, false, hit) || try_near(none, true, hit)) return true;
        // Away from other faces: back to the start, then in 26 directions. Never towards the plane.
        Point back{};
        double most = 0;
        for (std::size_t k = 0; k < 3; ++k) back[k] = path_.from[k] / 2 - path_.to[k] / 2, most = std::max(most, std::abs(back[k]));
        for (double& x : back) x /= most;
        if (try_moved(back, 2, hit) || try_moved(back, 5, hit)) return true;
        // First the 26 to the neighbours, then the 72 that lie between those: some corners leave no more than a sliver.
        for (const int finest : {1, 2})
            for (const double by : {1.5, 3.5, 6.5, 9.0})
                for (int x = -finest; x <= finest; ++x)
                    for (int y = -finest; y <= finest; ++y)
                        for (int z = -finest; z <= finest; ++z) {
                            if (std::max({std::abs(x), std::abs(y), std::abs(z)}) != finest || (x % 2 == 0 && y % 2 == 0 && z % 2 == 0)) continue;
                            if (try_moved({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)}, by, hit)) return true;
                        }
        return false;
    }

    bool try_moved(const Point& direction, double by, Hit<Scalar>& hit) {
        const double length = std::sqrt(direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2]);
        double in = 0;  // towards the plane
        for (std::size_t k = 0; k < 3; ++k) in += direction[k] / length * unit_normal_[k];
        in = std::min(in, 0.0);
        Point moved{};
        for (std::size_t k = 0; k < 3; ++k) moved[k] = by * unit_ * (direction[k] / length - in * unit_normal_[k]);
        return try_near(moved, true, hit);
    }

    // The true point, moved off the plane and by `moved`.
    bool try_near(const Point& moved, bool outwards, Hit<Scalar>& hit) {
        double square = 0;  // of the distance from the true point, in units
        Point by{};
        for (std::size_t k = 0; k < 3; ++k) by[k] = low_[k] + (off_[k] + moved[k]);
        Point point = rounded_to<Scalar>({high_[0] + by[0], high_[1] + by[1], high_[2] + by[2]});
        for (std::size_t k = 0; k < 3; ++k) {
            const double beyond = (point[k] - high_[k]) - by[k];
            const double next = next_to<Scalar>(point[k], out_[k]);
            point[k] = outwards && beyond * unit_normal_[k] < 0 ? next : point[k];
            const double x = ((point[k] - high_[k]) - low_[k]) * per_unit_;
            square += x * x;
        }
        // One unit for what the true point may be off. (False for what is not finite.)
        constexpr double k_most = k_grain_units + 8 - 1;
        return square <= k_most * k_most && take(point, true, hit);
    }

    void find_back(double below, Hit<Scalar>& hit) {
        // Between the start and the first point tried, both of which are far enough from the plane.
        double way = 0;
        for (std::size_t k = 0; k < 3; ++k) way = std::max(way, std::abs(high_[k] / 2 + off_[k] / 2 - path_.from[k] / 2));
        double back = 4 * unit_ / way;
        if (!(back > 0)) back = 1;
        for (; back < 1; back *= 2) {
            const double share = 1 - back;
            Point point{};
            for (std::size_t k = 0; k < 3; ++k) point[k] = path_.from[k] * back + (high_[k] + off_[k]) * share;
            point = rounded_to<Scalar>(point);
            hit.fraction = rounded_down<Scalar>(below * share);
            if (point != path_.from && take(point, false, hit)) return;
            for (std::size_t k = 0; k < 3; ++k)
                if (out_[k] != 0) point[k] = next_to<Scalar>(point[k], out_[k]);
            if (point != path_.from && take(point, false, hit)) return;
        }
        hit.fraction = 0;
        for (int k = 0; k < 3; ++k) hit.point[k] = static_cast<Scalar>(path_.from[static_cast<std::size_t>(k)]);
    }

    bool take(const Point& point, bool near, Hit<Scalar>& hit) {
        for (const double x : point)
            if (!std::isfinite(x)) return false;
        if (point != path_.from) {
            if (!is_far(point)) return false;
            if (!clear_(point, near)) {
                ++tries_;
                return false;
            }
        }
        for (int k = 0; k < 3; ++k) hit.point[k] = static_cast<Scalar>(point[static_cast<std::size_t>(k)]);
        return true;
    }

    // On the start's side, and a grain off the plane or as far as the start. The first by n . (point - P), P being in the plane, the second by
    // n . (point - from): each term is off by what n and P may be off, and 2^-51 of itself for its roundings and the sum's. (Where each term of the
    // second has a factor that is exactly 0, so is it.) Only what neither proves nor refutes is left to exact arithmetic.
    bool is_far(const Point& point) {
        if (spot_ != nullptr) {
            double from_plane = 0;
            double plane_error = 0x1p-1060;
            double from_start = 0;
            double start_error = 0;
            double length_error = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const double n = std::abs(out_[k]);
                const double dn = spot_->normal_error[k] + 0x1p-51 * n;
                const double x = (point[k] - high_[k]) - low_[k];
                from_plane += out_[k] * x;
                plane_error += dn * std::abs(x) + (n + dn) * spot_->error[k];
                const double y = point[k] - path_.from[k];
                from_start += out_[k] * y;
                if (y != 0 && (n != 0 || spot_->normal_error[k] != 0)) start_error += dn * std::abs(y) + 0x1p-1060;
                length_error += spot_->normal_error[k];
            }
            plane_error *= 1.01;
            start_error *= 1.01;
            const double wanted = grain_ * (length_ + length_error) * (1 + 0x1p-48);
            if (from_plane - plane_error >= wanted || from_start >= start_error) return true;
            if (from_plane + plane_error < wanted && from_start < -start_error) return false;
        }
        ++counters_.exact_sides;
        return is_far_enough(corners_, path_.from, point, grain_);
    }

    bool same_as_start(const Hit<Scalar>& hit) const { return to_point(hit.point) == path_.from; }

    const Path& path_;
    const Corners& corners_;
    double grain_;
    double unit_;
    double per_unit_;
    const Spot* spot_;
    QueryCounters& counters_;
    Clear& clear_;
    double length_;
    Point high_{};
    Point low_{};
    Point out_{};          ///< the normal, towards the start
    Point unit_normal_{};  ///< of length 1
    Point off_{};          ///< from the plane to where the point is looked for
    int tries_ = 0;
};

/// Sets `position`, `point` and `fraction` of a hit: the segment from -> point has no hit, none of the hit's own triangle, from whose plane the point
/// keeps off, and none of any other, which `clear(point, near)` says. `near`: the point is within `near_margin(grain)` of the true one in each
/// coordinate. `from` itself needs no proof. `exact`: the true fraction, rounded once. Returns how many points were not clear.
template <class Scalar, class Face, class Clear>
int place(const Path& path, const Corners& corners, const Decision& decision, double grain, double exact, Face& face, QueryCounters& counters,
          Clear&& clear, Hit<Scalar>& hit) {
    Point position = path.from;
    int tries = 0;
    if (decision.at_start) {
        hit.fraction = 0;
        for (int k = 0; k < 3; ++k) hit.point[k] = static_cast<Scalar>(path.from[static_cast<std::size_t>(k)]);
    } else {
        const Located located = face.locate(grain / k_grain_units, position);
        if (!located.rounded) {
            ++counters.exact_values;
            position = exact_position<Scalar>(path, corners);
        }
        tries = PlaceSearch<Scalar, std::remove_reference_t<Clear>>(path, corners, decision.side, grain, located.spot, position, face.normal(), counters,
                                           clear).find(exact, hit);
    }
    for (int k = 0; k < 3; ++k) hit.position[k] = static_cast<Scalar>(position[static_cast<std::size_t>(k)]);
    return tries;
}

}  // namespace pierce::detail
