// Why a face is, or is not, what a segment hits first.
#pragma once

#include <cstdint>
#include <string_view>

#include <pierce/export.h>
#include <pierce/types.h>

namespace pierce {

/// Why a face is not the first hit, or that it is. Of several reasons one is named: `zero_area` before `apart`, that
/// before `masked`, and that before all others.
enum class Reason : std::uint8_t {
    first_hit,     ///< this is it
    later,         ///< hit, but another hit comes before
    apart,         ///< the boxes of face and segment have no point in common
    zero_area,     ///< the face has no area, and can't be hit
    masked,        ///< `face_mask` leaves it out
    in_plane,      ///< both ends lie in the face's plane
    in_front,      ///< the segment does not go behind the plane
    behind,        ///< the segment does not go in front of the plane (for `both`: nor onto it)
    wrong_side,    ///< it passes through the plane from the side that `sides` leaves out
    outside_edge,  ///< it passes through the plane on the outer side of edge `edge`
    too_far,       ///< hit, but beyond `max_fraction`
    not_accepted,  ///< hit, but `accept` said no
};

/// What `explain` says of a face.
struct FaceVerdict {
    std::uint32_t face;      ///< the caller's number
    std::uint32_t triangle;  ///< its place in `MeshView::triangles`
    Reason reason;           ///< why it is hit or not
    /// For `outside_edge`: k says the edge from corner k to corner k+1; of two, the lower one. Else 0.
    std::uint8_t edge = 0;
};

/// A few words for people.
[[nodiscard]] PIERCE_EXPORT std::string_view to_string(Reason reason);

}  // namespace pierce
