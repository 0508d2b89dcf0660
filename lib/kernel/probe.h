// What the wide kernels ask with: one segment, made ready for slab tests and for the test of a cluster.
#pragma once

#include <cstdint>

namespace pierce::detail {

/// Parameters t of a probe run from 0 to 1 over the part of the segment that may touch the scene: nearly always all of it.
template <class Scalar>
struct Probe {
    // In scene units, relative to Frame::low.
    double origin[3];
    double direction[3];
    double noise[3];  ///< how far a point of the segment may be off, and a way to a rounded point of it may lead off it
    // The caller's fraction is begin + t * length.
    double begin;
    double length;

    // Slab tests: 1 / direction, and |that| * noise.
    float inverse[3];
    float margin[3];
    // For bounds on the scene's lattice: t is near[axis] + bound * pace[axis] at the near side of a slab.
    float pace[3];
    float near[3];
    float far[3];
    std::uint32_t flipped;  ///< bit k: the direction goes down along axis k

    // The test of a cluster. For float in the caller's units, for double in scene units.
    Scalar corner_origin[3];
    Scalar scale;
    float corner_direction[3];
    float reach;          ///< D, the largest |component| of that
    float edge_bound;     ///< of the bound for the volumes of edges, times D: see cluster_test.h
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

/// What a traversal does with a cluster whose `lanes` may be hit. Returns the parameter beyond which nothing is of use any more, rounded up; negative:
/// the traversal ends.
using Visit = float (*)(void* self, std::uint32_t cluster, unsigned lanes);

}  // namespace pierce::detail
