// What a swept sphere answers: where a ball of a radius first runs into the mesh, and where it is safe to stop it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <pierce/coordinates.h>
#include <pierce/hit.h>
#include <pierce/types.h>

namespace pierce {

/// A ball that moves without turning: its center goes along a segment. It has two sides for every triangle: the sphere
/// is as far from one whichever side it comes from, and `QueryOptions::sides` says nothing here.
///
/// The ball **hits** a closed triangle where its center comes nearer to it than the radius. To be exactly as far away
/// is to touch, which is no hit: a ball that ends a step in contact has hit nothing yet, one that slides along a
/// surface at the radius's distance never hits it, and one that grazes an edge without going in does not either. A
/// triangle that is no further away than the radius at the start is hit, at fraction 0, if the center comes nearer to
/// it than it was at the start; if it does not at first it never will (a distance from a convex set along a line is
/// convex), so a ball that overlaps the mesh may move away or along it, and is stopped only by what it would sink
/// deeper into. That goes for each triangle by itself: one that overlaps a floor of many is stopped by those beside it
/// as well, and has to be moved out first; `overlap` and `normal` say how. One whose center lies on a triangle may
/// leave it to either side. A step of length zero hits nothing. A triangle of area zero is no part of the surface. All
/// of it is decided as if in exact arithmetic on the coordinates and the radius given.
///
/// So what `CollisionMesh::sweep_sphere` promises is this.
///  1. No hit is missed: where there is no answer, the center may be moved to `to`, and the ball penetrates nothing on
///     the way and at the end that it did not at the start, and that no deeper.
///  2. A ball that is moved to `center` has not penetrated either, neither there nor on the straight way to it, by the
///     same exact rule: sweeping it from `from` to `center` has no hit. So a chain of sweeps of a ball that does not
///     overlap at first never overlaps, and never gets through a wall.
///  3. `fraction` is no later than the true time of impact, and earlier by at most 2^-21 of the step, or by what moves
///     the center by 2^-36 of the radius and the distance of the furthest point of the mesh together (in a coordinate),
///     whichever is less; and by its own rounding to Scalar. Where one of radius, step and mesh is 2^900 times as large
///     as another, and doubtful, it may be 0.
/// Which of several triangles that are hit at about the same time is named may depend on roundings, but nothing else:
/// not on the broadphase, the threads, or the machine.
///
/// Plain memory, as `Hit`: 64 bytes for float and 104 for double.
template <class Scalar>
struct SphereHit {
    /// The time of impact, rounded down: 0 where the ball starts in contact and goes in.
    Scalar fraction;
    /// Where to stop the ball: verified, see above. As a rule it is the true place moved a grain off the surface, and
    /// rounded; a grain is four units in the last place of the largest coordinate there, and in double at least 2^-45
    /// of the distance of the triangle's furthest corner from the start. So it need not lie on the segment. It is
    /// `from` where the ball starts in contact, or so near that nothing is gained. In `sphere_hits` it is the place at
    /// `fraction`, not verified; in `sphere_contacts` the center given.
    Coordinates<Scalar> center;
    /// The point of the triangle that is touched, rounded. Not verified.
    Coordinates<Scalar> contact;
    /// Unit vector from there to the center. Where the center lies on the triangle, the normal of its front.
    Coordinates<Scalar> normal;
    /// How deep the ball overlaps the triangle at the start: the radius less the distance, rounded; more than 0 if and
    /// only if it overlaps.
    Scalar overlap;
    /// The caller's number of the face (`MeshView::faces`).
    std::uint32_t face;
    /// The place of the triangle in `MeshView::triangles`.
    std::uint32_t triangle;
    /// The side of the triangle's plane that the center is on: `front` or `back`. As rounded numbers have it, as is
    /// what follows.
    Sides side;
    /// What of the triangle is touched.
    Feature feature;
    /// For an edge, k says the one from corner k to corner k+1 (mod 3) of the triangle; for a vertex, corner k; else 0.
    std::uint8_t feature_index;
    /// The ball starts in contact with the triangle or overlaps it, exactly, and goes in.
    bool at_start;
    /// Always 0: so nothing is left unwritten.
    std::uint32_t reserved[2 - sizeof(Scalar) / 8];
};
static_assert(std::is_trivially_copyable_v<SphereHit<float>> && sizeof(SphereHit<float>) == 64);
static_assert(std::is_trivially_copyable_v<SphereHit<double>> && sizeof(SphereHit<double>) == 104);

}  // namespace pierce
