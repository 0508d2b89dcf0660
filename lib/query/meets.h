// The places where a path meets faces: what a face adds to one, and the first places in exact order.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include <query/candidate.h>
#include <query/face_touches.h>

namespace pierce::detail {

/// A face that a path meets in one point, leading through its plane or up to it.
struct Meet : Filtered {
    TriangleRef triangle;
    int crossing = 0;  ///< by the rule of translation
    bool at_end = false;
};

/// The order of two meets along a path: < 0 where the first comes before the second, 0 at the same place.
template <class Scalar>
[[nodiscard]] int order_along(const Scene<Scalar>& scene, const Path& path, const Meet& x, const Meet& y,
                              QueryCounters& counters) {
    if (x.latest < y.earliest) return -1;
    if (y.latest < x.earliest) return 1;
    if (x.triangle == y.triangle || (x.decision.at_start && y.decision.at_start) || (x.at_end && y.at_end)) return 0;
    return order_of_places(path, scene.corners(x.triangle), x.decision, scene.corners(y.triangle), y.decision,
                           counters);
}

/// All faces that a path meets at one fraction. `Found`: a Meet.
template <class Found>
struct MeetingPlace {
    Found first;  ///< the first that was found, for the order
    /// Of those that are passed from the front, and from the back, the one of the smallest face; `hit` if there is any.
    std::array<Decision, 2> decisions;
    std::array<TriangleRef, 2> triangles;
    std::array<FaceTouch, 2> faces;
    std::size_t face_count = 0;
    int crossings = 0;

    void add(const Meet& meet, const FaceTouch& touch) {
        ++face_count;
        crossings += meet.crossing;
        const std::size_t side = meet.decision.side == Sides::front ? 0 : 1;
        if (decisions[side].hit && !comes_before(touch, faces[side])) return;
        decisions[side] = meet.decision;
        triangles[side] = meet.triangle;
        faces[side] = touch;
    }
    /// The side of the face that stands for all: see `Passage::face`.
    [[nodiscard]] std::size_t chosen() const {
        if (crossings != 0) return crossings > 0 ? 0 : 1;
        if (decisions[0].hit && decisions[1].hit) return comes_before(faces[0], faces[1]) ? 0 : 1;
        return decisions[0].hit ? 0 : 1;
    }
};

/// Keeps the first places of a path after a given one, in order. There are few as a rule: a sorted array is enough.
/// `Meetings` has
///   Found                 what is met: a Meet, or one that says more
///   int order(x, y)       of two of them: < 0 where the first comes before the second, 0 at the same place
///   FaceTouch touch(x)    as the caller gets it
template <class Meetings>
class FirstPlaces {
  public:
    using Meet = typename Meetings::Found;
    using Place = MeetingPlace<Meet>;

    /// So many are found by one traversal; it is repeated for those that come after.
    static constexpr std::size_t k_most = 32;

    explicit FirstPlaces(const Meetings& meetings) : meetings_(meetings) {}

    /// Begins anew with those after the last one that was kept; at most `most` of them are wanted.
    void go_on(std::size_t most) {
        if (kept_ > 0) after_ = places_[kept_ - 1].first;
        begun_ = kept_ > 0 || begun_;
        kept_ = 0;
        most_ = std::min(most, k_most);
    }
    [[nodiscard]] std::span<const Place> kept() const { return std::span(places_).first(kept_); }
    /// Whether there may be others behind those that are kept.
    [[nodiscard]] bool full() const { return kept_ == most_; }
    /// Meets beyond this fraction are of no use.
    [[nodiscard]] double limit() const { return full() ? places_[kept_ - 1].first.latest : 1; }

    void add(const Meet& meet) {
        if (begun_ && meetings_.order(meet, after_) <= 0) return;
        const auto [at, same] = find(meet);
        if (!same) {
            if (at == most_) return;
            if (kept_ < most_) ++kept_;
            const auto from = places_.begin() + static_cast<std::ptrdiff_t>(at);
            std::move_backward(from, places_.begin() + static_cast<std::ptrdiff_t>(kept_) - 1,
                               places_.begin() + static_cast<std::ptrdiff_t>(kept_));
            places_[at] = {};
            places_[at].first = meet;
        }
        places_[at].add(meet, meetings_.touch(meet));
    }
    struct At {
        std::size_t at;  ///< the first that does not come before
        bool same;       ///< it is the place of the meet
    };
    /// Where a meet is among the places that are kept.
    [[nodiscard]] At find(const Meet& meet) const {
        std::size_t low = 0;
        std::size_t high = kept_;
        while (low < high) {
            const std::size_t middle = (low + high) / 2;
            const int before = meetings_.order(meet, places_[middle].first);
            if (before == 0) return {middle, true};
            if (before < 0)
                high = middle;
            else
                low = middle + 1;
        }
        return {low, false};
    }

  private:
    const Meetings& meetings_;
    std::array<Place, k_most> places_;
    std::size_t kept_ = 0;
    std::size_t most_ = 0;
    bool begun_ = false;
    Meet after_;
};

}  // namespace pierce::detail
