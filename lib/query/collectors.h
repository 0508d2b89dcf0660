// What a query wants of the hits that the traversal finds: the first, any, or all.
#pragma once

#include <algorithm>
#include <span>

#include <pierce/hit.h>
#include <query/candidate.h>
#include <query/values.h>

namespace pierce::detail {

/// The triangles that the wide kernels left; if `complete`, all that could stop a point on a way within
/// `Scene::near_bound` of the path, so that the verified point needs no second traversal.
struct Shortlist {
    void add(TriangleRef triangle) {
        if (count == triangles.size())
            complete = false;
        else
            triangles[count++] = triangle;
    }

    std::array<TriangleRef, 64> triangles;
    unsigned count = 0;
    bool complete = true;
};

/// Keeps the hit that comes before all others.
template <class Scalar>
class First {
  public:
    First(const Scene<Scalar>& scene, const Path& path, QueryCounters& counters)
        : scene_(scene), path_(path), counters_(counters) {}

    [[nodiscard]] double limit() const { return best().latest; }
    [[nodiscard]] bool wants(TriangleRef) const { return true; }
    [[nodiscard]] Candidate& room() { return candidates_[1 - best_]; }
    void seen(TriangleRef triangle) { list_.add(triangle); }
    void add() {
        if (found_ && !comes_before(scene_, path_, room(), best(), counters_)) return;
        best_ = 1 - best_;
        found_ = true;
    }
    [[nodiscard]] bool found() const { return found_; }
    [[nodiscard]] const Candidate& best() const { return candidates_[best_]; }
    [[nodiscard]] const Shortlist& list() const { return list_; }

  private:
    const Scene<Scalar>& scene_;
    const Path& path_;
    QueryCounters& counters_;
    std::array<Candidate, 2> candidates_;
    std::size_t best_ = 0;
    bool found_ = false;
    Shortlist list_;
};

/// Keeps the first hit, but for those of one triangle and those that `passed(triangle)` says are known already.
template <class Scalar, class Passed>
class FirstOther : public First<Scalar> {
  public:
    FirstOther(const Scene<Scalar>& scene, const Path& path, QueryCounters& counters, const Passed& passed,
               TriangleRef own)
        : First<Scalar>(scene, path, counters), passed_(passed), own_(own) {}

    [[nodiscard]] bool wants(TriangleRef triangle) const { return triangle != own_; }
    void add() {
        if (!passed_(this->room().triangle)) First<Scalar>::add();
    }

  private:
    const Passed& passed_;
    TriangleRef own_;
};

/// Stops at any hit, but for those of one triangle and those that `passed(triangle)` says are known already.
template <class Passed>
class Any {
  public:
    explicit Any(Passed passed, TriangleRef own = {}) : passed_(passed), own_(own) {}

    [[nodiscard]] double limit() const { return found_ ? -1 : 1; }
    [[nodiscard]] bool wants(TriangleRef triangle) const { return !found_ && triangle != own_; }
    [[nodiscard]] Candidate& room() { return candidate_; }
    void seen(TriangleRef) {}
    void add() { found_ = !passed_(candidate_.triangle); }
    [[nodiscard]] bool found() const { return found_; }

  private:
    Passed passed_;
    TriangleRef own_;
    Candidate candidate_;
    bool found_ = false;
};

/// Counts every hit and keeps the first ones in `out`: as a heap with the last of them on top (Williams 1964), so that
/// the time is n log n in the hits met; `sort` puts them in order. Of each it fills what it needs itself: the place of
/// the triangle (cluster in `triangle`, lane in `face`), feature, side, at_start and exact_fraction.
template <class Scalar>
class All {
  public:
    All(const Scene<Scalar>& scene, const Path& path, std::span<Hit<Scalar>> out, QueryCounters& counters)
        : scene_(scene), path_(path), out_(out), counters_(counters) {}

    [[nodiscard]] double limit() const { return 1; }
    [[nodiscard]] bool wants(TriangleRef) const { return true; }
    [[nodiscard]] Candidate& room() { return candidate_; }
    void seen(TriangleRef) {}
    void add() {
        ++total_;
        if (out_.empty()) return;
        if (kept_ < out_.size()) {
            write(out_[kept_++]);
            std::push_heap(out_.begin(), out_.begin() + static_cast<std::ptrdiff_t>(kept_), before());
        } else if (comes_before(scene_, path_, candidate_, candidate_of(out_[0]), counters_)) {
            std::pop_heap(out_.begin(), out_.end(), before());
            write(out_.back());
            std::push_heap(out_.begin(), out_.end(), before());
        }
    }
    void sort() { std::sort_heap(out_.begin(), out_.begin() + static_cast<std::ptrdiff_t>(kept_), before()); }
    [[nodiscard]] std::size_t total() const { return total_; }
    [[nodiscard]] std::size_t kept_count() const { return kept_; }

    /// What is kept of a candidate in a hit.
    static void keep(const Scene<Scalar>& scene, const Path& path, const Candidate& candidate, QueryCounters& counters,
                     Hit<Scalar>& hit) {
        hit.triangle = candidate.triangle.cluster;
        hit.face = candidate.triangle.lane;
        hit.side = candidate.decision.side;
        hit.feature = candidate.decision.feature;
        hit.feature_index = candidate.decision.feature_index;
        hit.at_start = candidate.decision.at_start;
        Values values;
        Rounded<Scalar> rounded;
        certify(scene.narrow(), candidate.measured, path, candidate.decision, scene.grain, counters, values, rounded);
        hit.exact_fraction = rounded.weights[3];
    }
    /// A kept hit as a candidate again, but for what was measured: its fraction was rounded to `Scalar` on top.
    [[nodiscard]] static Candidate candidate_of(const Hit<Scalar>& hit) {
        const auto fraction = static_cast<double>(hit.exact_fraction);
        const double slack = fraction * static_cast<double>(std::numeric_limits<Scalar>::epsilon()) * 2 +
                             static_cast<double>(std::numeric_limits<Scalar>::denorm_min()) * 4;
        const Decision decision{.hit = true,
                                .side = hit.side,
                                .feature = hit.feature,
                                .feature_index = hit.feature_index,
                                .at_start = hit.at_start};
        Candidate candidate;
        static_cast<Filtered&>(candidate) = {Verdict::hit, decision, fraction - slack, fraction + slack};
        candidate.triangle = {hit.triangle, hit.face};
        return candidate;
    }

  private:
    auto before() {
        return [this](const Hit<Scalar>& x, const Hit<Scalar>& y) {
            return comes_before(scene_, path_, candidate_of(x), candidate_of(y), counters_);
        };
    }
    void write(Hit<Scalar>& hit) { keep(scene_, path_, candidate_, counters_, hit); }

    const Scene<Scalar>& scene_;
    const Path& path_;
    std::span<Hit<Scalar>> out_;
    QueryCounters& counters_;
    Candidate candidate_;
    std::size_t total_ = 0;
    std::size_t kept_ = 0;
};

}  // namespace pierce::detail
