// Contacts and their times in exact arithmetic: what is asked where the filter can't tell. Total over all finite input.
//
// All numbers are on the stack. That takes 70 KiB for coordinates whose bits, from the highest of the largest to the
// lowest that is set in any, are 124 at most; 170 KiB for 300, as all floats are; and up to 0.8 MiB for others, 1.1
// MiB for the order of two, where numbers may get 1,874 limbs long.
#pragma once

#include <motion/moving.h>

namespace pierce::detail {

/// The first contact that counts, with its time enclosed as by `sharpened`.
[[nodiscard]] Impact decide_contact(const MovingPoint& point, const MovingTriangle& triangle, ContactRule contact);

/// The order of the times of two impacts.
[[nodiscard]] int decide_order(const MovingPoint& point, ContactRule contact, const MovingTriangle& first,
                               const MovingTriangle& second);

/// The order of an impact's time and a number.
[[nodiscard]] int decide_order(const MovingPoint& point, ContactRule contact, const MovingTriangle& triangle,
                               double time);

}  // namespace pierce::detail
