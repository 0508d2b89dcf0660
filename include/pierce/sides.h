// Which side of a triangle counts, and what a hit lies on. Alone in a file: wide kernels include nothing else from
// here.
#pragma once

#include <cstdint>

namespace pierce {

/// Which side of a triangle a segment may come from. A query takes any of the three; a hit is `front` or `back`.
enum class Sides : std::uint8_t {
    front,  ///< from in front of the plane or on it, to strictly behind
    back,   ///< the same mirrored: from behind or on the plane, to strictly in front
    /// A change of side, where on the plane counts as in front: as `front`, or from strictly behind to in front or onto
    /// the plane. So a point on the plane can leave it to the front, and a chain of steps passes unseen in neither
    /// direction.
    both,
};

/// What a hit lies on, decided exactly.
enum class Feature : std::uint8_t {
    face,    ///< the open face
    edge,    ///< an open edge: without its ends
    vertex,  ///< a corner
};

}  // namespace pierce
