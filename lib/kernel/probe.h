// What the wide kernels ask with: one segment, made ready for slab tests and for the test of a cluster.
#pragma once

#include <cstdint>

namespace pierce::detail {

/// Parameters t of a probe run from 0 to 1 over the part of the segment that may touch the scene: nearly always all of
/// it. The last of each four numbers is of no use.
template <class Scalar>
struct Probe {
    // In scene units, relative to Frame::low.
    double origin[4];
    double direction[4];
    double noise[4];  ///< how far a point of the segment may be off, and a way to a rounded point of it may lead off it
    // The caller's fraction is begin + t * length.
    double begin;
    double length;

    // Slab tests: 1 / direction, and |that| * noise.
    double full_inverse[4];
    float inverse[4];
    float margin[4];
    // For bounds on the scene's lattice: t is near[axis] + bound * pace[axis] at the near side of a slab.
    float pace[4];
    float near[4];
    float far[4];
    std::uint32_t near_row[4];  ///< of the bounds: 2k, or 2k + 1 where the direction goes down along axis k

    // In place of these, of a short segment: the box around it, on the scene's lattice (box_test.h).
    std::uint16_t low[4];
    std::uint16_t high[4];
    bool by_box;

    // The test of a cluster. For float in the caller's units, for double in scene units.
    Scalar corner_origin[4];
    float corner_direction[4];
    Scalar scale;
    float edge_bound;  ///< of the bound for the volumes of edges, times D: see cluster_test.h
    float start_bound;
    float noise_bound;
    float plane_bound;
    float plane_noise;
    float floor;
    bool front_only;
    bool back_only;

    // What the traversal went through.
    std::uint32_t nodes;
    std::uint32_t clusters;
};

/// What a traversal does with a cluster whose `lanes` may be hit. Returns the parameter beyond which nothing is of use
/// any more, rounded up; negative: the traversal ends.
using Visit = float (*)(void* self, std::uint32_t cluster, unsigned lanes);

}  // namespace pierce::detail
