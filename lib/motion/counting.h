// Which contacts count: the rule of ContactRule, on the signs of the point's side just before and just after.
#pragma once

#include <motion/moving.h>

namespace pierce::detail {

/// Sides: +1 in front, -1 behind; 0 only for a point that is in the plane for the whole step.
struct Counting {
    ContactRule contact;

    [[nodiscard]] constexpr bool at_start(int after) const {
        return contact == ContactRule::closed || (contact == ContactRule::back ? after > 0 : after < 0);
    }
    [[nodiscard]] constexpr bool at_end(int before) const {
        return contact == ContactRule::closed || (contact == ContactRule::both && before < 0);
    }
    /// At a time in (0, 1), on the open face of a triangle with area.
    [[nodiscard]] constexpr bool on_face(int before, int after) const {
        switch (contact) {
            case ContactRule::front:
                return before > 0 && after < 0;
            case ContactRule::back:
                return before < 0 && after > 0;
            case ContactRule::both:
                return before != after;
            default:
                return true;
        }
    }
    /// On its border, or on a triangle that has no area at that time.
    [[nodiscard]] constexpr bool on_border(int before, int after) const {
        switch (contact) {
            case ContactRule::front:
                return before > 0 || after < 0;
            case ContactRule::back:
                return before < 0 || after > 0;
            default:
                return true;
        }
    }
    [[nodiscard]] constexpr Sides side(int before) const {
        if (contact == ContactRule::front) return Sides::front;
        if (contact == ContactRule::back) return Sides::back;
        return before > 0 ? Sides::front : Sides::back;
    }
};

}  // namespace pierce::detail
