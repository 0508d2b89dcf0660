// What a query answers: where a segment first passes through the mesh, and what it passes through.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <pierce/coordinates.h>
#include <pierce/types.h>

namespace pierce {

/// The face of a hit that there is not.
inline constexpr std::uint32_t no_face = 0xffffffff;

/// A segment hits the front of the closed triangle a, b, c (counter-clockwise seen from its front) when `from` lies in
/// front of its plane or on it, `to` lies strictly behind, and the two meet. So a point that ends a step on a face has
/// not hit it yet, and hits it on the next step if that one goes in. `Sides` says what counts from the back, and from
/// both sides. A segment in the plane, a segment of length zero and a triangle of area zero never hit. All of it is
/// decided as if in exact arithmetic on the coordinates given.
///
/// Plain memory, the same on every platform: members lie in this order with nothing between them or behind, 72 bytes
/// for float and 128 for double, and may be copied byte by byte. (The assertions below say at which offsets.)
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
    Coordinates<Scalar> point;
    /// The true point of intersection, each coordinate rounded correctly; not verified: it may lie behind the face. For
    /// picking and drawing.
    Coordinates<Scalar> position;
    /// Unit normal of the face, pointing to its front whichever side was hit. Each component within 4 ulp of 1.
    Coordinates<Scalar> normal;
    /// Weights of the corners a, b, c in the true point of intersection, in [0, 1], each within 1 ulp of 1.
    Coordinates<Scalar> barycentric;
    /// Where the segment meets the face, in [0, 1], within 1 ulp; not verified. In one call of `all_hits` those at
    /// exactly the same fraction have the same bits here, and it never decreases from one hit to the next.
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
    /// Always 0: so nothing is left unwritten.
    std::uint32_t reserved;

    /// False for `no_hit`, with which batches fill the places of queries without a hit.
    [[nodiscard]] explicit operator bool() const { return triangle != no_face; }
    /// The unit normal on the side that the segment came from: `normal` where the front was hit, else the opposite.
    [[nodiscard]] Vec3<Scalar> facing() const { return side == Sides::back ? -normal : normal.vec(); }
};

namespace detail {

template <class Scalar>
constexpr Hit<Scalar> make_no_hit() {
    Hit<Scalar> hit{};
    hit.face = hit.triangle = no_face;
    return hit;
}

// For readers in other languages, who mirror it.
template <class Scalar>
constexpr bool has_documented_layout() {
    using H = Hit<Scalar>;
    constexpr std::size_t k_numbers = 14 * sizeof(Scalar);
    return std::is_trivially_copyable_v<H> && std::is_standard_layout_v<H> && offsetof(H, fraction) == 0 &&
           offsetof(H, point) == 1 * sizeof(Scalar) && offsetof(H, position) == 4 * sizeof(Scalar) &&
           offsetof(H, normal) == 7 * sizeof(Scalar) && offsetof(H, barycentric) == 10 * sizeof(Scalar) &&
           offsetof(H, exact_fraction) == 13 * sizeof(Scalar) && offsetof(H, face) == k_numbers &&
           offsetof(H, triangle) == k_numbers + 4 && offsetof(H, side) == k_numbers + 8 &&
           offsetof(H, feature) == k_numbers + 9 && offsetof(H, feature_index) == k_numbers + 10 &&
           offsetof(H, at_start) == k_numbers + 11 && offsetof(H, reserved) == k_numbers + 12 &&
           sizeof(H) == k_numbers + 16;
}
static_assert(has_documented_layout<float>() && has_documented_layout<double>());

}  // namespace detail

/// What an array of hits has where a query has none: face and triangle are `no_face`, all else is 0.
template <class Scalar>
inline constexpr Hit<Scalar> no_hit = detail::make_no_hit<Scalar>();

}  // namespace pierce
