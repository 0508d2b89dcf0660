// Two independent judges of the decision contract: CGAL's exact predicates, and rational arithmetic on another formula.
#pragma once

#include <cmath>
#include <limits>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Gmpq.h>
#include <CGAL/intersections.h>

#include <exact/decide.h>

namespace pierce::test {

/// The rule by CGAL 5.5, exact predicates on doubles. For a triangle of area zero or a segment of length zero CGAL's
/// answers are undefined: `defined` says whether the pair is neither.
class CgalOracle {
  public:
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using P = Kernel::Point_3;

    CgalOracle(const detail::Path& path, const detail::Corners& c)
        : from_(point(path.from)), to_(point(path.to)), a_(point(c[0])), b_(point(c[1])), c_(point(c[2])) {}

    [[nodiscard]] bool defined() const { return from_ != to_ && !CGAL::collinear(a_, b_, c_); }

    [[nodiscard]] bool hit(Sides sides) const {
        const CGAL::Orientation from = CGAL::orientation(a_, b_, c_, from_);
        const CGAL::Orientation to = CGAL::orientation(a_, b_, c_, to_);
        const bool front = sides != Sides::back && from != CGAL::NEGATIVE && to == CGAL::NEGATIVE;
        bool back = sides == Sides::back && from != CGAL::POSITIVE && to == CGAL::POSITIVE;
        if (sides == Sides::both) back = from == CGAL::NEGATIVE && to != CGAL::NEGATIVE;
        return (front || back) && CGAL::do_intersect(Kernel::Segment_3(from_, to_), Kernel::Triangle_3(a_, b_, c_));
    }

  private:
    static P point(const detail::Point& p) { return {p[0], p[1], p[2]}; }
    P from_, to_, a_, b_, c_;
};

/// The rule by construction in rational numbers: the point where the line meets the plane, and its barycentric
/// coordinates in the projection along the largest component of the normal. Total, and slow.
class RationalOracle {
  public:
    using Q = CGAL::Gmpq;

    RationalOracle(const detail::Path& path, const detail::Corners& corners) {
        for (std::size_t k = 0; k < 3; ++k) {
            p_[k] = Q(path.from[k]);
            q_[k] = Q(path.to[k]);
            for (std::size_t i = 0; i < 3; ++i) t_[i][k] = Q(corners[i][k]);
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = (k + 1) % 3;
            const std::size_t j = (k + 2) % 3;
            n_[k] = (t_[1][i] - t_[0][i]) * (t_[2][j] - t_[0][j]) - (t_[1][j] - t_[0][j]) * (t_[2][i] - t_[0][i]);
        }
        from_side_ = height(p_);
        to_side_ = height(q_);
        if (from_side_ == to_side_) return;
        pierces_ = true;
        fraction_ = from_side_ / (from_side_ - to_side_);
        std::size_t k = 0;
        for (std::size_t i = 1; i < 3; ++i)
            if (abs(n_[i]) > abs(n_[k])) k = i;
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        const Q x = p_[i] + fraction_ * (q_[i] - p_[i]);
        const Q y = p_[j] + fraction_ * (q_[j] - p_[j]);
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const auto& u = t_[(corner + 1) % 3];
            const auto& v = t_[(corner + 2) % 3];
            weight_[corner] = ((u[i] - x) * (v[j] - y) - (u[j] - y) * (v[i] - x)) / n_[k];
        }
    }

    [[nodiscard]] bool hit(Sides sides) const {
        if (!pierces_) return false;
        const bool front = sides != Sides::back && from_side_ >= 0 && to_side_ < 0;
        bool back = sides == Sides::back && from_side_ <= 0 && to_side_ > 0;
        if (sides == Sides::both) back = from_side_ < 0 && to_side_ >= 0;
        return (front || back) && weight_[0] >= 0 && weight_[1] >= 0 && weight_[2] >= 0;
    }
    /// Of the point where the line meets the plane, for a hit.
    [[nodiscard]] const Q& fraction() const { return fraction_; }
    [[nodiscard]] const Q& weight(std::size_t corner) const { return weight_[corner]; }
    [[nodiscard]] const Q& from_side() const { return from_side_; }
    [[nodiscard]] const Q& to_side() const { return to_side_; }
    [[nodiscard]] bool zero_area() const { return n_[0] == 0 && n_[1] == 0 && n_[2] == 0; }
    /// A component of the normal, of a triangle that has one, over the largest of them; rounded once.
    [[nodiscard]] double normal_ratio(std::size_t k) const {
        Q largest = 0;
        for (const Q& component : n_) largest = std::max(largest, abs(component));
        return CGAL::to_double(n_[k] / largest);
    }

  private:
    static Q abs(const Q& x) { return x < 0 ? -x : x; }
    [[nodiscard]] Q height(const std::array<Q, 3>& x) const {
        Q sum = 0;
        for (std::size_t k = 0; k < 3; ++k) sum += n_[k] * (x[k] - t_[0][k]);
        return sum;
    }

    std::array<Q, 3> p_, q_, n_;
    std::array<std::array<Q, 3>, 3> t_;
    Q from_side_, to_side_, fraction_;
    std::array<Q, 3> weight_;
    bool pierces_ = false;
};

/// The distance of a value from the exact one, in units in the last place of `at`.
template <class Scalar>
double ulps(Scalar value, const RationalOracle::Q& exact, double at) {
    const auto near = static_cast<Scalar>(std::abs(at));
    const double ulp = double(std::nextafter(near, std::numeric_limits<Scalar>::infinity())) - double(near);
    return std::abs(CGAL::to_double((RationalOracle::Q(double(value)) - exact) / RationalOracle::Q(ulp)));
}

}  // namespace pierce::test
