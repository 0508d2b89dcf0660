// Crossings of one path: how they are found, which comes first, and those in one place.
#pragma once

#include <bit>

#include <exact/crossing_order.h>
#include <query/certified.h>
#include <query/counting.h>
#include <query/region_scene.h>

namespace pierce::detail {

struct Crossing {
    TriangleRef triangle;
    int sign;         ///< as in crossing.h
    double earliest;  ///< an interval that contains the exact fraction
    double latest;
};

/// Whether the path crosses a triangle, unless beyond `limit`.
template <class Scalar>
[[nodiscard]] bool find_crossing(const Scene<Scalar>& scene, const Path& path, TriangleRef triangle, double limit,
                                 QueryCounters& counters, Crossing& found) {
    const Corners corners = scene.corners(triangle);
    Measured measured;
    measure_path<Scalar>(corners, path, measured);
    Filtered filtered = filter_strictly(measured, Sides::both);
    if (filtered.verdict == Verdict::miss || filtered.earliest > limit) return false;
    const int sign = sign_of_crossing(filtered, path, corners, counters);
    if (sign == 0) return false;
    if (filtered.verdict == Verdict::doubtful) set_exact_interval(path, corners, counters, filtered);
    found = {triangle, sign, filtered.earliest, filtered.latest};
    return found.earliest <= limit;
}

/// Calls `use(crossing)` for each crossing of the path up to what `limit()` then says.
template <class Scalar, class Limit, class Use>
void each_crossing(const Scene<Scalar>& scene, const Path& path, QueryCounters& counters, Limit&& limit, Use&& use) {
    each_candidate(scene, path, Sides::both, limit(), counters, [&](ClusterRef cluster, unsigned lanes) {
        for (; lanes != 0; lanes &= lanes - 1) {
            const TriangleRef triangle{cluster, static_cast<std::uint32_t>(std::countr_zero(lanes))};
            Crossing crossing{};
            if (find_crossing(scene, path, triangle, limit(), counters, crossing)) use(crossing);
        }
        return limit();
    });
}

/// < 0 where x comes first; 0 where both lie in one plane.
template <class Scalar>
[[nodiscard]] int order_of(const Scene<Scalar>& scene, const Path& path, const Crossing& x, const Crossing& y,
                           QueryCounters& counters) {
    if (x.latest < y.earliest) return -1;
    if (y.latest < x.earliest) return 1;
    if (x.triangle == y.triangle) return 0;
    ++counters.exact_orders;
    return compare_crossings(path, scene.corners(x.triangle), scene.corners(y.triangle));
}

/// By the caller's numbers.
template <class Scalar>
[[nodiscard]] bool has_smaller_number(const Scene<Scalar>& scene, TriangleRef x, TriangleRef y) {
    const std::uint32_t face_x = scene.face_of(x);
    const std::uint32_t face_y = scene.face_of(y);
    return face_x != face_y ? face_x < face_y : scene.number_of(x) < scene.number_of(y);
}

/// Crossings of coincident faces, in the order of their numbers; more than it holds are only counted.
template <class Scalar>
class Pile {
  public:
    explicit Pile(const RegionScene<Scalar>& regions) : regions_(regions) {}

    void add(const Crossing& crossing) {
        if (++total_ > all_.size()) return;
        std::size_t i = total_ - 1;
        for (; i > 0 && has_smaller_number(regions_.scene, crossing.triangle, all_[i - 1].triangle); --i)
            all_[i] = all_[i - 1];
        all_[i] = crossing;
    }
    /// Whether it holds all of them. If not, their order is that of the numbers.
    [[nodiscard]] bool complete() const { return total_ <= all_.size(); }

    /// Puts them in the order in which each leads on from the region before it, as far as there is one: `region` says
    /// which comes before the first; null: the first one is that which no other leads to.
    void chain(const std::uint32_t* region) {
        std::uint32_t current = region != nullptr ? *region : start();
        for (std::size_t i = 0; i < total_; ++i) {
            std::size_t next = i;
            while (next < total_ && near(next) != current) ++next;
            if (next == total_) next = i;
            std::rotate(all_.begin() + static_cast<std::ptrdiff_t>(i), all_.begin() + static_cast<std::ptrdiff_t>(next),
                        all_.begin() + static_cast<std::ptrdiff_t>(next) + 1);
            current = far(i);
        }
    }
    [[nodiscard]] const Crossing& operator[](std::size_t i) const { return all_[i]; }

  private:
    [[nodiscard]] std::uint32_t near(std::size_t i) const { return regions_.near(all_[i].triangle, all_[i].sign); }
    [[nodiscard]] std::uint32_t far(std::size_t i) const { return regions_.far(all_[i].triangle, all_[i].sign); }
    [[nodiscard]] std::uint32_t start() const {
        for (std::size_t i = 0; i < total_; ++i) {
            bool led_to = false;
            for (std::size_t j = 0; j < total_; ++j) led_to = led_to || (j != i && far(j) == near(i));
            if (!led_to) return near(i);
        }
        return near(0);
    }

    const RegionScene<Scalar>& regions_;
    std::array<Crossing, 32> all_;
    std::size_t total_ = 0;
};

}  // namespace pierce::detail
