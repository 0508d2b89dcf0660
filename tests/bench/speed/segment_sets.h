// The segments that are asked about: what physics, sensors and lines of sight cast, seeded, in random order.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include <pierce/mesh_view.h>

namespace pierce::bench {

/// Half of the places on the surface are chosen by area, as for what falls on a scene, half by faces, as for what moves
/// along details.
/// Lengths are in diagonals of the mesh's box.
enum class SegmentSet {
    short_02,  ///< 0.002 long, starting within that length of the surface, in a random direction
    short_1,   ///< the same, 0.01 long
    medium,    ///< the same, 0.1 long
    aimed,     ///< through two points near (0.01) the surface, and half of their distance beyond each
    random,  ///< through a point of the box in a random direction, half a diagonal to each side
    cloud,  ///< 0.005 long, anywhere in the box: mostly free space
    rest,   ///< from a face (as well as floats can), half of them, or just above: 0.0002 against its normal
    axis   ///< from point to point of a lattice of 64^3 cells in the box, 1, 4, 16 or 64 cells along an axis
};

inline constexpr std::array k_segment_sets = {SegmentSet::short_02, SegmentSet::short_1, SegmentSet::medium,
                                              SegmentSet::aimed,    SegmentSet::random,  SegmentSet::cloud,
                                              SegmentSet::rest,     SegmentSet::axis};

std::string_view name_of(SegmentSet set);
std::string_view description_of(SegmentSet set);

std::vector<Segment<float>> make_segments(SegmentSet set, const MeshView<float>& mesh, std::size_t count);

}  // namespace pierce::bench
