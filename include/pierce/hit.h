// What a query answers: where a segment first passes through the mesh, and what it passes through.
#pragma once

#include <cstdint>

#include <pierce/types.h>

namespace pierce {

/// A segment hits the front of the closed triangle a, b, c (counter-clockwise seen from its front) when `from` lies in
/// front of its plane or on it, `to` lies strictly behind, and the two meet. So a point that ends a step on a face has
/// not hit it yet, and hits it on the next step if that one goes in. `Sides` says what counts from the back, and from
/// both sides. A segment in the plane, a segment of length zero and a triangle of area zero never hit. All of it is
/// decided as if in exact arithmetic on the coordinates given.
template <class Scalar>
struct Hit {
    /// A lower bound of the true fraction that belongs to `point`: 0 where `point` is `from`.
    Scalar fraction;
    /// A place to stop at: the segment `from -> point` has no hit itself under the same options, so a particle that is
    /// moved there and stepped again can't get through the mesh. (In `all_hits`: no hit but those that come strictly
    /// before this one.)
    ///
    /// Where `from` lies strictly on one side of the face's plane, so does `point`, at least a grain from it, or as far
    /// as `from` was if that is less. A grain is four units in the last place of the mesh's largest |coordinate|. So a
    /// stopped point can leave in every direction but into the face, does not creep towards it, and a target projected
    /// onto the plane is not behind it by the next rounding. As a rule it is `position` moved off the plane by a grain
    /// along the normal, and rounded: it need not lie on the segment. Where another face is in the way there, it is a
    /// place within a grain and eight units in the last place of `position`, else one on the way from `from`. It is
    /// `from` itself where nothing nearer is verified, and where the segment starts on the face.
    Vec3<Scalar> point;
    /// The true point of intersection, each coordinate rounded correctly; not verified: it may lie behind the face. For
    /// picking and drawing.
    Vec3<Scalar> position;
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
