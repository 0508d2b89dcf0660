// A place at the end of a step from which a particle goes on: where it is looked for, whatever moves.
//
// Tried first is where the contact's place on the mesh goes, a grain off the face. What is in the way of that is kept
// off as well, by its plane at the end of the step, until nothing is: as in a corner, where two or three faces meet. A
// way along a face that turns leaves the face's plane in between, by the square of the turn; so the next one to be
// tried is where the start itself would be carried by the face, which has no way along it. Each place that is tried is
// asked about as the caller would, so only what is clear is returned.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <path.h>
#include <pierce/options.h>

namespace pierce::detail {

/// A plane that a place has to be in front of.
struct Guard {
    Point at{};
    Point normal{};            ///< of length 1 and to the side that the point comes from; 0 where there is none
    std::uint32_t number = 0;  ///< of the triangle
};

[[nodiscard]] inline Point moved_by(const Point& x, const Point& way, double by) {
    return {x[0] + by * way[0], x[1] + by * way[1], x[2] + by * way[2]};
}

class Guards {
  public:
    static constexpr std::size_t k_most = 12;

    /// False: it is no plane, or there are too many.
    bool add(const Guard& guard) {
        if (count_ == k_most || guard.normal == Point{}) return false;
        guards_[count_++] = guard;
        return true;
    }
    /// The place brought `distance` in front of all planes, or of as many as a few rounds reach.
    [[nodiscard]] Point in_front(Point place, double distance) const {
        for (int round = 0; round < 16; ++round) {
            bool moved_any = false;
            for (std::size_t g = 0; g < count_; ++g) {
                const Guard& guard = guards_[g];
                double off = 0;
                for (std::size_t k = 0; k < 3; ++k) off += (place[k] - guard.at[k]) * guard.normal[k];
                const double short_of = distance - off;
                if (!(short_of > distance * 0x1p-6)) continue;
                place = moved_by(place, guard.normal, short_of);
                moved_any = true;
            }
            if (!moved_any) break;
        }
        return place;
    }

  private:
    std::array<Guard, k_most> guards_;
    std::size_t count_ = 0;
};

/// `ahead`: where the contact's place on the mesh goes; `along`: where the start would be carried; `first`: the face
/// that is met, at the end of the step. `ask(place, stop)` says whether a place is clear, and if it is not writes what
/// is in the way to `stop`, unless that is null. False: no place is; the last one asked about was `along`.
template <class Ask>
[[nodiscard]] bool find_end_place(const Point& ahead, const Point& along, const Guard& first, double grain,
                                  QueryCounters& counters, Ask&& ask) {
    for (const Point& base : {ahead, along}) {
        Guards guards;
        bool guarded = guards.add(first);
        double distance = grain;
        for (std::size_t round = 0; round < Guards::k_most && guarded; ++round) {
            Guard in_the_way;
            if (ask(guards.in_front(base, distance), &in_the_way)) return true;
            ++counters.retreats;
            if (in_the_way.number == first.number) distance *= 16;
            guarded = guards.add(in_the_way);
        }
    }
    // In all directions, further each time.
    double distance = grain;
    for (int round = 0; round < 14; ++round, distance *= 8)
        for (int direction = 0; direction < 27; ++direction) {
            const Point way{static_cast<double>(direction % 3 - 1), static_cast<double>(direction / 3 % 3 - 1),
                            static_cast<double>(direction / 9 - 1)};
            if (ask(moved_by(along, way, distance), nullptr)) return true;
            ++counters.retreats;
        }
    // On the mesh itself, for a start that lies on a vertex and goes with it.
    return ask(ahead, nullptr) || ask(along, nullptr);
}

}  // namespace pierce::detail
