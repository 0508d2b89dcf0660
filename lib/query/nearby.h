// Ways to many places close together, asked about one after the other: all triangles that could be in the way, each
// with its shadow (shadow.h).
//
// In the tip of a thin spike, seen from inside, no place near the hit is clear, and place.h asks about some 2,000 of
// them. With a full test of each triangle, 50 to 200 ns, or a traversal for each where there are more than a list
// holds, that took 0.5 ms between 3 faces and 30 ms between 200. A shadow answers in a few nanoseconds, for all but the
// places on its rim; those, and the first of each triangle's hits, are left to the full test. So each answer is what it
// was.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <query/grain.h>
#include <query/shadow.h>
#include <query/traverse.h>

namespace pierce::detail {

/// While it lives, it answers for `ways`, an OtherWays, about near places: from the second on, as one alone isn't worth
/// it. About 40 kB.
template <class Ways>
class Nearby {
  public:
    explicit Nearby(const Ways& ways) : ways_(ways),
          unit_(ways.scene.grain / k_grain_units),
          per_unit_(1 / unit_) { ways.nearby = this; }
    ~Nearby() { ways_.nearby = nullptr; }
    Nearby(const Nearby&) = delete;
    Nearby& operator=(const Nearby&) = delete;

    /// Whether it can tell about this place.
    [[nodiscard]] bool knows(const Point& point) {
        if (state_ == State::unused) state_ = State::asked;
        else if (state_ == State::asked) state_ = gather(point) ? State::ready : State::useless;
        return state_ == State::ready && is_at(point);
    }

    /// Whether a place is certainly not clear, from what is known already: a few nanoseconds.
    [[nodiscard]] bool hides(const Point& point) {
        if (state_ != State::ready || !is_at(point)) return false;
        const std::uint8_t last = last_[cell()];
        return last != k_none && shadows_[last].hides(place_);
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
        std::uint8_t& last = last_[cell()];
        std::array<std::uint8_t, k_most_triangles> unsure;
        unsigned left = 0;
        for (unsigned i = 0; i < count_; ++i) {
            const Seen seen = shadows_[i].seen(place_);
            if (seen == Seen::beside) continue;
            if (seen == Seen::hidden && stops_[i]) {
                last = static_cast<std::uint8_t>(i);
                return false;
            }
            unsure[left++] = static_cast<std::uint8_t>(i);
        }
        for (unsigned n = 0; n < left; ++n) {
            const unsigned i = unsure[n];
            if (!test(triangles_[i])) continue;
            // What stops one way stops each way into its shadow: sides, mask and what was passed before are the same
            // for all of them. Not so the caller's own test.
            if (!ways_.options.accept) {
                stops_[i] = true;
                last = static_cast<std::uint8_t>(i);
            }
            return false;
        }
        return true;
    }

  private:
    static constexpr unsigned k_most_triangles = 255;
    static constexpr std::uint8_t k_none = 255;
    enum class State : std::uint8_t { unused, asked, ready, useless };

    [[nodiscard]] bool is_at(const Point& point) {
        for (std::size_t k = 0; k < 3; ++k) place_[k] = (point[k] - origin_[k]) * per_unit_;
        return std::abs(place_[0]) <= Shadow::k_most && std::abs(place_[1]) <= Shadow::k_most &&
               std::abs(place_[2]) <= Shadow::k_most;
    }

    // All triangles that could be in a near way, and their shadows; false if they are too many.
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
        last_.fill(k_none);
        Point view = difference_of(origin_, ways_.path.from);
        if (!normalise(view)) view = {0, 0, 1};
        for (std::size_t k = 0; k < 3; ++k)
            if (std::abs(view[k]) > std::abs(view[depth_])) depth_ = k;
        for (std::size_t k = 0; k < 2; ++k) slope_[k] = view[(depth_ + 1 + k) % 3] / view[depth_];
        return true;
    }
    void add(TriangleRef triangle) {
        if (triangle == ways_.own || masked(ways_.scene, triangle, ways_.options)) return;
        triangles_[count_] = triangle;
        shadows_[count_] = Shadow(ways_.scene.corners(triangle), ways_.path.from, origin_, unit_);
        stops_[count_++] = false;
    }

    // A fraction of the path that the true hit, within `near_bound` of `point` in each coordinate, does not exceed:
    // each_candidate leaves out nothing that a near way hits up to there.
    double up_to(const Point& point) {
        const Path& path = ways_.path;
        double whole = 0;
        double way = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double along = std::abs(path.to[k] / 2 - path.from[k] / 2);  // halves: no difference overflows
            if (along <= whole) continue;
            whole = along;
            way = std::abs(point[k] / 2 - path.from[k] / 2) + ways_.scene.near_bound;
        }
        const double fraction = way / whole * (1 + 0x1p-48);
        return limit_ = fraction < 1 ? fraction : 1;
    }

    // Places with the same direction from the start, all but: what hides one probably hides the next. Only a hint.
    [[nodiscard]] std::size_t cell() const {
        const auto number = [&](std::size_t k) {
            const double across = place_[(depth_ + 1 + k) % 3] - slope_[k] * place_[depth_];
            return static_cast<unsigned>(static_cast<int>(across + 3 * Shadow::k_most)) % k_cells;
        };
        return number(0) * k_cells + number(1);
    }
    static constexpr unsigned k_cells = 32;

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
    std::array<std::uint8_t, k_cells * k_cells> last_;  ///< what hid the last place of a cell
    std::array<TriangleRef, k_most_triangles> triangles_;
    std::array<bool, k_most_triangles> stops_;  ///< was found in the way to some place
    std::array<Shadow, k_most_triangles> shadows_;
};

}  // namespace pierce::detail
