// Where a segment passes through the surface or touches it: one entry for each place, whatever the number of faces that
// meet there. What a bullet, a thickness gauge or a ray through a solid needs.
#pragma once

#include <cstddef>
#include <cstdint>

#include <pierce/coordinates.h>
#include <pierce/location.h>
#include <pierce/options.h>
#include <pierce/types.h>

namespace pierce {

/// What a passage does to the winding number.
enum class PassageKind : std::uint8_t {
    entering,  ///< raises it
    leaving,   ///< lowers it
    grazing,   ///< leaves it as it was
};

/// One place where a segment meets the surface.
///
/// A face counts when the segment leads through its plane, or up to it or away from it, and meets the closed triangle.
/// A face along whose plane the segment runs does not count, but its neighbours do where the segment comes to them.
/// Faces that the segment meets at exactly the same fraction are one passage: those around a vertex, the two of an
/// edge, walls that coincide. All of it is decided as if in exact arithmetic.
///
/// Each face adds 1, -1 or 0 to `crossings` by the rule of `CollisionMesh::crossings`, which takes both ends as moved
/// by the same infinitesimal step. So the `crossings` of all passages add up to those of the segment, always, and on a
/// closed mesh the winding number between two passages is that at `from` and the `crossings` of the passages before.
///
/// Starts and ends on the surface: such a passage is there, with fraction 0 or 1. Whether it enters, leaves or grazes
/// is decided by the infinitesimal step as well, not by where the segment goes next: of two segments, one that ends at
/// a point of the surface and one that goes on from there, exactly one counts the passage through it. So a segment that
/// rises from a floor that faces upwards starts with a grazing passage, and one that rises to a ceiling that faces
/// downwards ends with an entering one.
///
/// The part of a segment that lies in solid matter, for a closed mesh that faces outwards:
///
///     std::array<pierce::Passage<double>, 64> passages;
///     const std::size_t count = std::min(mesh.passages(segment, passages), passages.size());
///     int depth = mesh.winding_number(segment.from);
///     double solid = 0;  // in the mesh's units
///     Eigen::Vector3d last = segment.from;
///     for (const auto& passage : std::span(passages).first(count)) {
///         if (depth > 0) solid += (passage.position - last).norm();
///         depth += passage.crossings;
///         last = passage.position;
///     }
///     if (depth > 0) solid += (segment.to - last).norm();
///
/// The thickness of one wall is that between two passages, `(b.position - a.position).norm()`.
template <class Scalar>
struct Passage {
    /// Where along the segment, in [0, 1], within 1 ulp; in order, and exactly 0 and 1 at the segment's ends.
    Scalar fraction;
    /// The true point, each coordinate rounded correctly. Not verified: it may lie on either side of the surface.
    Coordinates<Scalar> position;
    /// Unit normal of `face`, pointing to its front. Each component within 4 ulp of 1.
    Coordinates<Scalar> normal;
    /// The face that stands for all of them: that of the smallest number (`MeshView::faces`), then triangle, among
    /// those that are passed from the front where the passage enters, from the back where it leaves.
    std::uint32_t face;
    /// Its place in `MeshView::triangles`.
    std::uint32_t triangle;
    /// The place of the passage's first face among those of all passages in their order.
    std::size_t first_face;
    /// How many triangles meet the segment here.
    std::size_t face_count;
    /// The sum over its faces: how often the segment passes from the front to the back here, less how often the other
    /// way. Mostly 1 or -1; 0 for a ridge that is touched; 2 where two walls coincide.
    int crossings;
    PassageKind kind;  ///< what `crossings` says: more than 0, less, or 0
    /// The side that the segment comes from to `face`.
    Sides side;
    /// What of `face` the place lies on, exactly, as in `Hit`.
    Feature feature;
    std::uint8_t feature_index;  ///< as in `Hit`
    bool at_start;               ///< the exact fraction is 0
    bool at_end;                 ///< the exact fraction is 1
};

/// What counts, as in `QueryOptions`, for each face before faces are taken together. With these options left as they
/// are all faces count.
struct PassageOptions {
    /// `front`: only faces that the segment's direction leads through from the front.
    Sides sides = Sides::both;
    /// Only passages whose exact fraction is at most this count. NaN: none.
    double max_fraction = 1.0;
    /// If it is not empty, only faces count whose number is a place in it that is not 0.
    std::span<const std::uint8_t> face_mask = {};
    /// If given, only faces count that it says yes to.
    Accept accept = {};
    /// Adds up what the query went through, if given.
    QueryCounters* counters = nullptr;
    /// False: what comes after the passages that fit is not looked for, so the first few of a long segment cost as much
    /// as `first_hit`. The query then returns how many were written.
    bool count_all = true;
};

}  // namespace pierce
