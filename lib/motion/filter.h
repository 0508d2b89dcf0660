// The filter before exact arithmetic: in double, never wrong where it is certain.
#pragma once

#include <motion/moving.h>

namespace pierce::detail {

enum class Certainty : std::uint8_t { miss, doubtful, hit };

/// Whether a contact counts, for any doubles, also infinite ones and NaN, which are doubtful. Sets `impact` for a hit.
[[nodiscard]] Certainty filter(const MovingPoint& point, const MovingTriangle& triangle, ContactRule contact,
                               Impact& impact) noexcept;

}  // namespace pierce::detail
