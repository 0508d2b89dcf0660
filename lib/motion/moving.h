// A moving point against a moving triangle: whether, when and on what they meet. Exact decisions, total over all finite
// coordinates; README.md has the rules, and the proofs that no chain of steps leaks.
#pragma once

#include <cstdint>

#include <point.h>

namespace pierce::detail {

/// Goes from at[0] to at[1] in one step, at constant velocity: at time t in [0, 1] it is at (1 - t) at[0] + t at[1].
struct MovingPoint {
    Point at[2];
};

/// Each corner goes from where it is in at[0] to where it is in at[1], at a constant velocity of its own.
struct MovingTriangle {
    Corners at[2];
};

/// Which contacts count. A contact is a time at which the point lies in the closed triangle. `closed` counts all of
/// them.
///
/// `front`: the point is behind the plane just after it, and was not just before; at time 0 on the plane counts as in
/// front, at time 1 nothing counts, since the next step has it. On an edge or a vertex (also of a triangle without area
/// at that time) a contact at a time in (0, 1) counts unless the point comes from behind and goes to the front: there
/// a point can get behind the surface without ever changing the side of a plane (README.md). In the triangle's plane
/// for the whole step it never counts. `back` is the same mirrored. `both` counts what `front` and `back` do at times
/// in (0, 1), at time 0 what `front` does, and at time 1 what comes from behind.
/// For a triangle that doesn't turn or change its shape these are the rules of `Sides`.
enum class ContactRule : std::uint8_t { front, back, both, closed };

[[nodiscard]] constexpr ContactRule rule_of(Sides sides) { return static_cast<ContactRule>(sides); }

/// The first contact that counts.
struct Impact {
    bool hit = false;
    Sides side = Sides::front;        ///< front or back: where the point comes from
    Feature feature = Feature::face;  ///< of a triangle without area at that time: edge or vertex
    std::uint8_t feature_index = 0;   ///< as in Hit: edge i leads from corner i to the next
    bool at_start = false;            ///< exactly at time 0
    /// The exact time is in [earliest, latest], a part of [0, 1]; where both are equal it is that number.
    double earliest = 0;
    double latest = 1;
};

/// A coordinate that is no finite number: no hit.
[[nodiscard]] Impact first_contact(const MovingPoint& point, const MovingTriangle& triangle,
                                   ContactRule contact) noexcept;

/// Whether they touch at any time in [0, 1].
[[nodiscard]] inline Impact meets(const MovingPoint& point, const MovingTriangle& triangle) noexcept {
    return first_contact(point, triangle, ContactRule::closed);
}
/// The first passage that counts, for moving points that must not leak.
[[nodiscard]] inline Impact strikes(const MovingPoint& point, const MovingTriangle& triangle, Sides sides) noexcept {
    return first_contact(point, triangle, rule_of(sides));
}

/// The exact order of the times of two impacts of one point, by one rule: < 0 where the first comes before the second,
/// 0 where they are equal. (So the first hit among many is the least by this, then by face number.) Both must be hits.
[[nodiscard]] int compare_impacts(const MovingPoint& point, ContactRule contact, const MovingTriangle& first,
                                  const Impact& one, const MovingTriangle& second, const Impact& two) noexcept;

/// The order of the exact time of an impact and `time`, a finite number.
[[nodiscard]] int compare_time(const MovingPoint& point, ContactRule contact, const MovingTriangle& triangle,
                               const Impact& impact, double time) noexcept;

/// The same impact with the narrowest interval: `earliest` is the exact time rounded down to a double, `latest` the
/// time rounded up. Below 2^-10 the interval may be wider than that, but not wider than 2^-62.
[[nodiscard]] Impact sharpened(const MovingPoint& point, ContactRule contact, const MovingTriangle& triangle,
                               const Impact& impact) noexcept;

/// True where they certainly do not touch in the whole step: cheap, and never wrong about it.
[[nodiscard]] bool certainly_apart(const MovingPoint& point, const MovingTriangle& triangle) noexcept;

}  // namespace pierce::detail
