// Ear clipping: the ring of corners, two queues, and the test whether a corner is in the way.
#include "mesh/read_ear_clipper.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace pierce::detail {

void EarClipper::cut(std::span<const Point2> points, std::span<std::array<std::uint32_t, 3>> triangles) {
    left_ = triangles;
    start(points);
    while (left_.size() > 1 && (clip_next_ear() || clip_next_flat())) {
    }
    std::uint32_t apex = 0;
    while (clipped_[apex]) {
        ++apex;
    }
    for (std::uint32_t corner = next_[apex]; !left_.empty(); corner = next_[corner], left_ = left_.subspan(1)) {
        left_[0] = {apex, corner, next_[corner]};
    }
}

void EarClipper::start(std::span<const Point2> points) {
    points_ = points;
    const auto count = static_cast<std::uint32_t>(points.size());
    previous_.resize(count);
    next_.resize(count);
    turn_.resize(count);
    clipped_.assign(count, 0);
    ears_.clear();
    flats_.clear();
    for (std::uint32_t i = 0; i < count; ++i) {
        previous_[i] = i == 0 ? count - 1 : i - 1;
        next_[i] = i + 1 == count ? 0 : i + 1;
    }
    obstacles_ = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        turn_[i] = 1;
        look_again(i);
    }
    rebuild_grid();
}

bool EarClipper::clip_next_ear() {
    while (!ears_.empty()) {
        std::pop_heap(ears_.begin(), ears_.end(), std::greater<>());
        const auto [length, tip] = ears_.back();
        ears_.pop_back();
        // An entry from before a neighbour was clipped has another one after it.
        const bool current = !clipped_[tip] && turn_[tip] > 0 && diagonal(tip) == length;
        if (current && !is_blocked(tip)) {
            clip(tip);
            return true;
        }
    }
    return false;
}

bool EarClipper::clip_next_flat() {
    while (!flats_.empty()) {
        const std::uint32_t tip = flats_.back();
        flats_.pop_back();
        if (!clipped_[tip] && turn_[tip] == 0) {
            clip(tip);
            return true;
        }
    }
    return false;
}

void EarClipper::clip(std::uint32_t tip) {
    const std::uint32_t before = previous_[tip];
    const std::uint32_t after = next_[tip];
    left_[0] = {before, tip, after};
    left_ = left_.subspan(1);
    obstacles_ -= is_in_the_way(tip) ? 1U : 0U;
    clipped_[tip] = 1;
    next_[before] = after;
    previous_[after] = before;
    look_again(before);
    look_again(after);
    if (obstacles_ < in_the_way_.size() / 2) {
        rebuild_grid();  // with fewer cells: a triangle covers more of the grid as the polygon gets coarser
    }
}

void EarClipper::look_again(std::uint32_t corner) {
    const int turn = turn_at(corner);
    obstacles_ -= turn_[corner] <= 0 ? 1U : 0U;
    obstacles_ += turn <= 0 ? 1U : 0U;
    turn_[corner] = static_cast<std::int8_t>(turn);
    if (turn > 0) {
        ears_.emplace_back(diagonal(corner), corner);
        std::push_heap(ears_.begin(), ears_.end(), std::greater<>());
    } else if (turn == 0) {
        flats_.push_back(corner);
    }
}

/// The length, in the larger coordinate, of the cut that would take the corner off.
double EarClipper::diagonal(std::uint32_t tip) const {
    const Point2& a = points_[previous_[tip]];
    const Point2& b = points_[next_[tip]];
    return std::max(std::abs(a[0] - b[0]), std::abs(a[1] - b[1]));
}

int EarClipper::turn_at(std::uint32_t corner) const {
    return orient2d(points_[previous_[corner]], points_[corner], points_[next_[corner]]);
}

/// A corner at the very place of one of the triangle's own is not in the way: it belongs to a bridge or a touching
/// point.
bool EarClipper::is_blocked(std::uint32_t tip) const {
    const Point2& a = points_[previous_[tip]];
    const Point2& b = points_[tip];
    const Point2& c = points_[next_[tip]];
    Box2 box;
    box.add(a);
    box.add(b);
    box.add(c);
    return grid_.any_near(a, b, c, [&](std::uint32_t corner) {
        const Point2& point = points_[corner];
        return box.holds(point) && is_in_the_way(corner) && point != a && point != b && point != c &&
               orient2d(a, b, point) >= 0 && orient2d(b, c, point) >= 0 && orient2d(c, a, point) >= 0;
    });
}

void EarClipper::rebuild_grid() {
    Box2 bounds;
    in_the_way_.clear();
    for (std::uint32_t corner = 0; corner < points_.size(); ++corner) {
        if (!clipped_[corner]) {
            bounds.add(points_[corner]);
        }
        if (is_in_the_way(corner)) {
            in_the_way_.push_back(corner);
        }
    }
    obstacles_ = in_the_way_.size();
    grid_.build(points_, in_the_way_, bounds);
}

}  // namespace pierce::detail
