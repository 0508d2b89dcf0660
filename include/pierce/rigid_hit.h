// Where a moving point first runs into a mesh that turns.
#pragma once

#include <cstdint>

#include <pierce/coordinates.h>
#include <pierce/hit.h>
#include <pierce/types.h>

namespace pierce {

/// The first contact of a point that goes straight from `from` to `to` in one step with a mesh that turns meanwhile
/// (`RigidMotion`, which says how far this may be from the true motion). Which chord of the point's way is the first to
/// hit the mesh, and what, is decided exactly, by the rules of `Hit`.
///
/// What to do with it: put the particle at `place`, and let its next step begin there; or keep `local`, which goes with
/// the mesh without any further rounding, and begin with a `Ride` from it. Both are certified. Where `place_verified`
/// is false only the latter is.
template <class Scalar>
struct RigidHit {
    /// A part of the step in [0, 1]: no chord has a hit before it, and the first hit is a few ulp later at most.
    Scalar time;
    /// A place for the point at the **end** of the step, in the world. Where `place_verified` is true the way to
    /// `local` from the beginning of the chord that hits has no hit in the mesh, under the same options, and `local` is
    /// what the next step begins with there: its image. So no particle that goes on from it gets through the mesh. As a
    /// rule it is the place that was hit, moved along with the mesh, a grain (`Hit::point`) or some units in the last
    /// place of the world's numbers off the face.
    Coordinates<Scalar> place;
    /// The same in the mesh's own coordinates; verified in any case, as a place to ride on.
    Coordinates<Scalar> local;
    /// The contact in the mesh's coordinates, each correctly rounded; not verified.
    Coordinates<Scalar> local_position;
    /// The same in the world at that time, rounded.
    Coordinates<Scalar> position;
    /// Unit normal of the face in the mesh, pointing to its front.
    Coordinates<Scalar> local_normal;
    /// The same in the world at that time.
    Coordinates<Scalar> normal;
    /// Weights of the corners a, b, c in the contact, in [0, 1].
    Coordinates<Scalar> barycentric;
    /// How far the mesh's material at the contact is moved by the whole step, from its start to its end, in the world.
    Coordinates<Scalar> surface_motion;
    std::uint32_t face;          ///< the caller's number of the face (`MeshView::faces`)
    std::uint32_t triangle;      ///< the place of the triangle in `MeshView::triangles`
    Sides side;                  ///< `front` or `back`: the side that the point came from
    Feature feature;             ///< what the contact lies on, exactly
    std::uint8_t feature_index;  ///< as in `Hit`
    bool at_start;               ///< the way begins on the face
    bool place_verified;         ///< whether `place` is certified, as said there

    /// The unit normal in the world on the side that the point came from.
    [[nodiscard]] Vec3<Scalar> facing() const { return side == Sides::back ? -normal : normal.vec(); }
};

}  // namespace pierce
