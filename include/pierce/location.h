// Where a point is: inside, outside or on the surface, and which faces it lies on.
#pragma once

#include <cstddef>
#include <cstdint>

#include <pierce/options.h>
#include <pierce/sides.h>

namespace pierce {

/// Where a point is, decided as if in exact arithmetic on the coordinates given.
enum class Place : std::uint8_t {
    outside,     ///< not on the surface, and the winding number is 0
    inside,      ///< not on the surface, and the winding number is not 0
    on_surface,  ///< in a closed triangle: on its inside, on an edge or at a corner
};

/// A triangle that a point or a segment meets in one point.
struct FaceTouch {
    /// The caller's number of the face (`MeshView::faces`).
    std::uint32_t face = 0;
    /// The place of the triangle in `MeshView::triangles`.
    std::uint32_t triangle = 0;
    /// What of the triangle the point lies on, exactly, as in `Hit`.
    Feature feature = Feature::face;
    std::uint8_t feature_index = 0;  ///< as in `Hit`
    /// In `passages` what the triangle adds to `Passage::crossings`: 1, 0 or -1. In `locate` 0.
    std::int8_t crossing = 0;
};

/// What `locate` says of a point.
///
/// A triangle of area zero is no part of the surface: a point that lies on such triangles only is inside or outside.
/// On an open mesh `on_surface` means the same, and inside and outside are those of the winding number. A point with a
/// coordinate that is NaN or infinite is `outside`, and counted in `MeshStatistics::invalid_queries`.
struct Location {
    Place place = Place::outside;  ///< decided exactly
    /// That of `CollisionMesh::winding_number`. So a point of the surface has that of the places next to it in the
    /// direction of (e, e^2, e^3) for e -> 0+: a particle that rests on a floor from above is not in the ground by it,
    /// one that touches a ceiling from below is.
    int winding_number = 0;
    /// How many triangles the point lies on; 0 unless it is on the surface.
    std::size_t face_count = 0;
};

}  // namespace pierce
