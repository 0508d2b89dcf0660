// What a query wants of the hits that the traversal finds: the first, any, or all.
#pragma once

#include <algorithm>
#include <span>

#include <pierce/hit.h>
#include <query/candidate.h>
#include <query/values.h>

namespace pierce::detail {

/// Keeps the hit that comes before all others.
template <class Scalar>
class First {
  public:
    static constexpr bool once = false;

    First(const Scene<Scalar>& scene, const Path& path, QueryCounters& counters)
        : scene_(scene), path_(path), counters_(counters) {}

    [[nodiscard]] double limit() const { return best().latest; }
    [[nodiscard]] bool wants(std::uint32_t) const { return true; }
    [[nodiscard]] Candidate& room() { return candidates_[1 - best_]; }
    void add() {
        if (found_ && !comes_before(scene_, path_, room(), best(), counters_)) return;
        best_ = 1 - best_;
        found_ = true;
    }
    [[nodiscard]] bool found() const { return found_; }
    [[nodiscard]] const Candidate& best() const { return candidates_[best_]; }

  private:
    const Scene<Scalar>& scene_;
    const Path& path_;
    QueryCounters& counters_;
    std::array<Candidate, 2> candidates_;
    std::size_t best_ = 0;
    bool found_ = false;
};

/// Stops at any hit, but for those of one triangle and those that `passed(triangle)` says are known already.
template <class Passed>
class Any {
  public:
    static constexpr bool once = false;
    static constexpr std::uint32_t k_no_triangle = ~std::uint32_t{0};

    explicit Any(Passed passed, std::uint32_t own = k_no_triangle) : passed_(passed), own_(own) {}

    [[nodiscard]] double limit() const { return found_ ? -1 : 1; }
    [[nodiscard]] bool wants(std::uint32_t triangle) const { return !found_ && triangle != own_; }
    [[nodiscard]] Candidate& room() { return candidate_; }
    void add() { found_ = !passed_(candidate_.triangle); }
    [[nodiscard]] bool found() const { return found_; }

  private:
    Passed passed_;
    std::uint32_t own_;
    Candidate candidate_;
    bool found_ = false;
};

/// Counts every hit and keeps the first ones, in order, in `out`. Of those it fills what it needs itself: triangle (the library's number), feature, side,
/// at_start and exact_fraction.
template <class Scalar>
class All {
  public:
    static constexpr bool once = true;

    All(const Scene<Scalar>& scene, const Path& path, std::span<Hit<Scalar>> out, QueryCounters& counters)
        : scene_(scene), path_(path), out_(out), counters_(counters) {}

    [[nodiscard]] double limit() const { return 1; }
    [[nodiscard]] bool wants(std::uint32_t) const { return true; }
    [[nodiscard]] Candidate& room() { return candidate_; }
    void add() {
        const Candidate& candidate = candidate_;
        ++total_;
        // Insertion from the end: hits come roughly in order.
        std::size_t place = kept_;
        while (place > 0 && comes_before(scene_, path_, candidate, kept(place - 1), counters_)) --place;
        if (place == out_.size()) return;
        if (kept_ < out_.size()) ++kept_;
        std::move_backward(out_.begin() + static_cast<std::ptrdiff_t>(place),
                           out_.begin() + static_cast<std::ptrdiff_t>(kept_ - 1),
                           out_.begin() + static_cast<std::ptrdiff_t>(kept_));
        Hit<Scalar>& hit = out_[place];
        hit.triangle = candidate.triangle;
        hit.side = candidate.decision.side;
        hit.feature = candidate.decision.feature;
        hit.feature_index = candidate.decision.feature_index;
        hit.at_start = candidate.decision.at_start;
        hit.exact_fraction = static_cast<Scalar>(
            CertifiedFace<Scalar>(scene_.corners(candidate.triangle), counters_).measures(path_, candidate.decision).fraction);
    }
    [[nodiscard]] std::size_t total() const { return total_; }
    [[nodiscard]] std::size_t kept_count() const { return kept_; }

    /// A kept hit as a candidate again: its fraction was rounded to `Scalar` on top.
    [[nodiscard]] Candidate kept(std::size_t i) const {
        const Hit<Scalar>& hit = out_[i];
        const auto fraction = static_cast<double>(hit.exact_fraction);
        const double slack = fraction * static_cast<double>(std::numeric_limits<Scalar>::epsilon()) * 2 +
                             static_cast<double>(std::numeric_limits<Scalar>::denorm_min()) * 4;
        return {hit.triangle,
                {.hit = true, .side = hit.side, .feature = hit.feature, .feature_index = hit.feature_index,
                 .at_start = hit.at_start},
                fraction - slack,
                fraction + slack};
    }

  private:
    const Scene<Scalar>& scene_;
    const Path& path_;
    std::span<Hit<Scalar>> out_;
    QueryCounters& counters_;
    Candidate candidate_;
    std::size_t total_ = 0;
    std::size_t kept_ = 0;
};

}  // namespace pierce::detail
