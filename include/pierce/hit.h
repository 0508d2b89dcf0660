// What a query answers: where a segment first passes through the mesh, and what it passes through.
#pragma once

#include <cstdint>

#include <pierce/types.h>

namespace pierce {

/// A segment hits the front of the closed triangle a, b, c (counter-clockwise seen from its front) when `from` lies in
/// front of its plane or on it, `to` lies strictly behind, and the two meet. So a point that ends a step on a face has
/// not hit it yet, and hits it on the next step if that one goes in. `Sides` says what counts from the back, and from both
/// sides. A segment in the plane, a segment of length zero and a triangle of area zero never hit. All of it is decided as if
/// in exact arithmetic on the coordinates given.
template <class Scalar>
struct Hit {
    /// A lower bound of `exact_fraction` that belongs to `point`: 0 where nothing nearer could be verified.
    Scalar fraction;
    /// A point with representable coordinates, at or shortly before the hit, such that the segment `from -> point` has
    /// no hit itself under the same options: a particle that is moved there and stepped again can't get through the mesh.
    /// (In `all_hits`: no hit but those that come strictly before this one.)
    Vec3<Scalar> point;
    /// Unit normal of the face, pointing to its front whichever side was hit. Each component within 4 ulp of 1.
    Vec3<Scalar> normal;
    /// Weights of the corners a, b, c in the true point of intersection, in [0, 1], each within 1 ulp of 1.
    Vec3<Scalar> barycentric;
    /// Where the segment meets the face, in [0, 1], within 1 ulp; not verified.
    Scalar exact_fraction;
    /// The caller's number of the face (`MeshView::faces`).
    std::uint32_t face;
    /// The place of the triangle in `MeshView::triangles`; differs from `face` where faces were cut into triangles.
    std::uint32_t triangle;
    /// `front` or `back`: the side that the segment came from.
    Sides side;
    /// What the hit lies on, exactly.
    Feature feature;
    /// For an edge, k says the one from corner k to corner k+1 (mod 3) of the triangle; for a vertex, corner k; else 0.
    std::uint8_t feature_index;
    /// The segment starts on the face: the exact fraction is 0.
    bool at_start;
};

/// The answer for a point that moves from one place to another over a step.
template <class Scalar>
struct SweepHit : Hit<Scalar> {
    /// The part of the step after which the point is still certainly outside: `fraction`, read as time.
    Scalar time_of_impact;
};

}  // namespace pierce
