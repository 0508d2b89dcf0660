// Where a moving point first runs into a moving mesh.
#pragma once

#include <cstdint>

#include <pierce/coordinates.h>
#include <pierce/hit.h>
#include <pierce/types.h>

namespace pierce {

/// The first contact of a point that goes from `from` to `to` in one step, at constant velocity, with a mesh each of
/// whose vertices goes from its old to its new position in the same step, at a constant velocity of its own. Whether
/// there is one, which is the first, and what it lies on is decided as if in exact arithmetic on these coordinates.
///
/// A contact with a front counts when the point is in front of the moving triangle's plane or on it just before, and
/// behind it just after. At the step's start on the plane counts as in front; at its end on the plane has not hit yet:
/// the next step has it. On an edge or a vertex, in between, any contact counts but one that comes from behind and goes
/// to the front: there a surface that folds can be passed without a change of side of any one plane. So no chain of
/// steps gets through a closed mesh unseen, however it moves (lib/motion/README.md has the proof). `Sides` says what
/// counts from the back. For a mesh that stands still, or moves without a turn, these are the rules of `Hit`.
template <class Scalar>
struct SweepHit {
    /// A lower bound of the time of the contact, as a part of the step in [0, 1]: before it the point and the mesh have
    /// certainly not met. At most 1 ulp below the true time (where that is above 2^-10, else 2^-62).
    Scalar time;
    /// A place for the point at the **end** of the step. Where `place_verified` is true the straight way from `from` to
    /// it over the whole step, while the mesh moves, has no contact itself under the same options. So a particle that
    /// is put there, and stepped again with the mesh's next step, can't get through the mesh; for any other velocity
    /// ask `sweep` about the way that it would lead to. As a rule it is the place on the mesh that was met, moved along
    /// with the face to the end of the step, a grain (`Hit::point`) off its plane and rounded: a point that rests on
    /// the mesh rides on it. In corners and between other faces it is the nearest such place that was found. It is not
    /// verified where none was, as between two sheets that meet.
    Coordinates<Scalar> place;
    /// The place of the contact, in space and not verified. This and all below are computed in double from the true
    /// time rounded, not correctly rounded.
    Coordinates<Scalar> position;
    /// Unit normal of the face at that time, pointing to its front; 0 where the face has no area then.
    Coordinates<Scalar> normal;
    /// The contact in the mesh's own coordinates: weights of the corners a, b, c, in [0, 1].
    Coordinates<Scalar> barycentric;
    /// How far the mesh's material at the contact goes in the whole step: velocity times the step's length.
    Coordinates<Scalar> surface_motion;
    std::uint32_t face;          ///< the caller's number of the face (`MeshView::faces`)
    std::uint32_t triangle;      ///< the place of the triangle in `MeshView::triangles`
    Sides side;                  ///< `front` or `back`: the side that the point came from
    Feature feature;             ///< what the contact lies on, exactly; never a face where the triangle has no area
    std::uint8_t feature_index;  ///< as in `Hit`
    bool at_start;               ///< the exact time is 0
    bool place_verified;         ///< whether `place` is certified, as said there

    /// The unit normal on the side that the point came from.
    [[nodiscard]] Vec3<Scalar> facing() const { return side == Sides::back ? -normal : normal.vec(); }
};

}  // namespace pierce
