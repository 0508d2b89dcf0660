// Contacts and their times in exact arithmetic: what is asked where the filter can't tell. Total over all finite input.
//
// Coordinates further apart than 124 bits take numbers of up to 1,902 limbs, which are kept on the stack: about 400 KiB
// of it for a decision, 900 KiB for the order of two.
#pragma once

#include <motion/moving.h>

namespace pierce::detail {

/// The first contact that counts, with its time enclosed as by `sharpened`.
[[nodiscard]] Impact decide_contact(const MovingPoint& point, const MovingTriangle& triangle, Contact contact);

/// The order of the times of two impacts.
[[nodiscard]] int decide_order(const MovingPoint& point, Contact contact, const MovingTriangle& first,
                               const MovingTriangle& second);

/// The order of an impact's time and a number.
[[nodiscard]] int decide_order(const MovingPoint& point, Contact contact, const MovingTriangle& triangle, double time);

}  // namespace pierce::detail
