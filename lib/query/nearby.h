// Ways to many places close together, asked about one after the other: all triangles that could be in the way, each
// with its shadow (shadow.h).
//
// In the tip of a thin spike, seen from inside, no place near the hit is clear, and place.h asks about some 2,000 of
// them. With a full test of each triangle, 50 to 200 ns, or a traversal for each where there are more than a list
// holds, that took 0.5 ms with 3 faces and 30 ms with 200. A shadow answers in a few nanoseconds, for all but the
// places on its rim; those, and the first of each triangle's hits, are left to the full test. So each answer is what it
// was.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include <query/grain.h>
#include <query/shadow.h>
#include <query/traverse.h>

namespace pierce::detail {

/// While it lives, it answers for `ways`, an OtherWays, about near places. About 40 kB, not set until they are needed.
template <class Ways>
class Nearby {
  public:
    explicit Nearby(const Ways& ways) : ways_(ways), unit_(ways.scene.grain / k_grain_units), per_unit_(1 / unit_) {
        ways.nearby = this;
    }
    ~Nearby() { ways_.nearby = nullptr; }
    Nearby(const Nearby&) = delete;
    Nearby& operator=(const Nearby&) = delete;

    /// Whether it can tell about this place.
    [[nodiscard]] bool knows(const Point& point) {
        const bool listed = ways_.list != nullptr && ways_.list->complete;
        if (state_ == State::unused && listed)
            state_ = State::asked;  // one more way past a list is soon asked about; what another traversal costs is not
        else if (state_ <= State::asked)
            state_ = gather(point) ? State::ready : State::useless;
        return state_ == State::ready && is_at(point);
    }

    /// Whether a place is certainly not clear, from what is known already: a few nanoseconds.
    [[nodiscard]] bool hides(const Point& point) {
        if (state_ != State::ready || !is_at(point)) return false;
        const std::uint8_t likely = likely_[direction(projected(place_))];
        return likely != k_none && stops_[likely] && shadows_[likely].hides(place_);
    }

    /// Of the place that knows() was asked about. Calls `test(triangle)` for those that may be in the way to it.
    template <class Test>
    void each(Test&& test) const {
        for (unsigned i = 0; i < count_; ++i)
            if (shadows_[i].seen(place_) != Seen::beside) test(triangles_[i]);
    }

    /// The same, up to the first in the way, which `test(triangle)` says. Whether none is.
    template <class Test>
    [[nodiscard]] bool clear(Test&& test) {
        const unsigned at = direction(projected(place_));
        for (const unsigned by : {0U, 1U, k_directions - 1}) {
            const unsigned i = likely_[(at + by) % k_directions];
            if (i != k_none && shadows_[i].hides(place_) && (stops_[i] || stops(i, at, test))) return false;
        }
        std::array<std::uint8_t, k_most_triangles> unsure;
        unsigned left = 0;
        for (unsigned i = 0; i < count_; ++i) {
            const Seen seen = shadows_[i].seen(place_);
            if (seen == Seen::beside) continue;
            if (seen == Seen::hidden && stops_[i]) {
                likely_[at] = static_cast<std::uint8_t>(i);
                return false;
            }
            unsure[left++] = static_cast<std::uint8_t>(i);
        }
        for (unsigned n = 0; n < left; ++n)
            if (stops(unsure[n], at, test)) return false;
        return true;
    }

  private:
    static constexpr unsigned k_most_triangles = 255;
    static constexpr std::uint8_t k_none = 255;
    enum class State : std::uint8_t { unused, asked, ready, useless };

    // What stops one way stops each way into its shadow: sides, mask and what was passed before are the same for all of
    // them. Not so the caller's own test.
    template <class Test>
    [[nodiscard]] bool stops(unsigned i, unsigned direction, Test&& test) {
        if (!test(triangles_[i])) return false;
        if (!ways_.options.accept) {
            stops_[i] = true;
            likely_[direction] = static_cast<std::uint8_t>(i);
        }
        return true;
    }

    [[nodiscard]] bool is_at(const Point& point) {
        for (std::size_t k = 0; k < 3; ++k) place_[k] = (point[k] - origin_[k]) * per_unit_;
        return std::abs(place_[0]) <= Shadow::k_most && std::abs(place_[1]) <= Shadow::k_most &&
               std::abs(place_[2]) <= Shadow::k_most;
    }

    // All triangles that could be in a near way, and their shadows; false if they are too many. `point` becomes the
    // origin: the others are within twice `near_bound` of it, 24 units, which Shadow has room for.
    bool gather(const Point& point) {
        if (!std::isfinite(per_unit_)) return false;  // of a unit that is denormal
        origin_ = point;
        const auto* const list = ways_.list;
        if (list != nullptr && list->complete) {
            for (unsigned i = 0; i < list->count; ++i) add(list->triangles[i]);
        } else {
            bool fits = true;
            each_candidate(ways_.scene, ways_.path, ways_.options.sides, up_to(point), ways_.counters,
                           [&](ClusterRef cluster, unsigned lanes) -> double {
                               for (; lanes != 0 && fits; lanes &= lanes - 1) {
                                   fits = count_ < k_most_triangles;
                                   if (fits) add({cluster, static_cast<std::uint32_t>(std::countr_zero(lanes))});
                               }
                               return fits ? limit_ : -1;
                           });
            if (!fits) return false;
        }
        set_directions();
        return true;
    }
    void add(TriangleRef triangle) {
        if (triangle == ways_.own || masked(ways_.scene, triangle, ways_.options)) return;
        Shadow& shadow = shadows_[count_];
        shadow = Shadow(ways_.scene.corners(triangle), ways_.path.from, origin_, unit_);
        const Sides sides = ways_.options.sides;
        if ((sides == Sides::front && shadow.start_side() < 0) || (sides == Sides::back && shadow.start_side() > 0))
            return;
        triangles_[count_] = triangle;
        stops_[count_++] = false;
    }

    // A fraction of the path that the true hit, within `near_bound` of `point` in each coordinate, does not exceed:
    // each_candidate leaves out nothing that a near way hits up to there.
    double up_to(const Point& point) {
        const Path& path = ways_.path;
        double whole = 0;
        double way = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double start = path.ray ? 0 : path.from[k];
            const double along = std::abs(path.to[k] / 2 - start / 2);  // halves: no difference overflows
            if (along <= whole) continue;
            whole = along;
            way = std::abs(point[k] / 2 - path.from[k] / 2) + ways_.scene.near_bound;
        }
        const double fraction = way / whole * (1 + 0x1p-48);
        return limit_ = fraction < 1 ? fraction : 1;
    }

    // What probably hides a place, by its direction from the corner nearest to the origin as the start sees it: faces
    // around a corner are sectors there. Only hints, so nothing here need be exact.
    void set_directions() {
        likely_.fill(k_none);
        Point view = difference_of(origin_, ways_.path.from);
        if (!normalise(view)) view = {0, 0, 1};
        for (std::size_t k = 0; k < 3; ++k)
            if (std::abs(view[k]) > std::abs(view[depth_])) depth_ = k;
        for (std::size_t k = 0; k < 2; ++k) slope_[k] = view[(depth_ + 1 + k) % 3] / view[depth_];
        double least = k_most * k_most;
        Point tip{};
        for (unsigned i = 0; i < count_; ++i)
            for (const Point& corner : ways_.scene.corners(triangles_[i])) {
                Point at = difference_of(corner, origin_);
                for (double& x : at) x *= per_unit_;
                const double square = dot_product(at, at);
                if (!(square < least)) continue;
                least = square;
                tip = corner;
                middle_ = projected(at);
            }
        for (unsigned i = 0; i < count_ && least < k_most * k_most; ++i) {
            const Corners corners = ways_.scene.corners(triangles_[i]);
            for (std::size_t k = 0; k < 3; ++k)
                if (corners[k] == tip)
                    fill(i, difference_of(corners[(k + 1) % 3], tip), difference_of(corners[(k + 2) % 3], tip));
        }
    }
    // The directions from p to q, the shorter way.
    void fill(unsigned i, Point p, Point q) {
        if (!normalise(p) || !normalise(q)) return;
        const auto along = [&](const Point& way) {
            const Flat flat = projected(way);
            return direction({flat[0] + middle_[0], flat[1] + middle_[1]});
        };
        unsigned from = along(p);
        unsigned to = along(q);
        if ((to - from) % k_directions > k_directions / 2) std::swap(from, to);
        for (unsigned at = from; at != to; at = (at + 1) % k_directions) likely_[at] = static_cast<std::uint8_t>(i);
        likely_[to] = static_cast<std::uint8_t>(i);
    }

    using Flat = std::array<double, 2>;
    // Along the ways, which are all but parallel, to where the depth is the origin's.
    [[nodiscard]] Flat projected(const Point& place) const {
        return {place[(depth_ + 1) % 3] - slope_[0] * place[depth_],
                place[(depth_ + 2) % 3] - slope_[1] * place[depth_]};
    }
    // From 0 on all around the middle.
    [[nodiscard]] unsigned direction(const Flat& place) const {
        const double x = place[0] - middle_[0];
        const double y = place[1] - middle_[1];
        const double part = x / (std::abs(x) + std::abs(y) + std::numeric_limits<double>::min());
        const double turned = y >= 0 ? 1 - part : 3 + part;
        return static_cast<unsigned>(turned * (k_directions / 4)) % k_directions;
    }
    static constexpr unsigned k_directions = 1024;
    static constexpr double k_most = Shadow::k_most;

    const Ways& ways_;
    double unit_;
    double per_unit_;  ///< as exact: a power of two
    State state_ = State::unused;
    unsigned count_ = 0;
    double limit_ = 1;
    Point origin_{};
    Point place_{};
    std::size_t depth_ = 0;  ///< the axis along which the ways go most
    std::array<double, 2> slope_{};
    Flat middle_{};
    std::array<std::uint8_t, k_directions> likely_;  ///< of each direction, what hid the last place or should hide one
    std::array<TriangleRef, k_most_triangles> triangles_;
    std::array<bool, k_most_triangles> stops_;  ///< was found in the way to some place
    std::array<Shadow, k_most_triangles> shadows_;
};

}  // namespace pierce::detail
