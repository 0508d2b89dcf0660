// What a world says of points, passages and balls: as for one mesh, and which of them it is.
#pragma once

#include <cstdint>

#include <pierce/explain.h>
#include <pierce/location.h>
#include <pierce/passage.h>
#include <pierce/sphere.h>
#include <pierce/world_hit.h>

namespace pierce {

/// A triangle that a point lies on, and its mesh.
struct WorldTouch {
    FaceTouch touch;
    MeshId mesh;
};

/// A passage through the surface of one mesh. Numbers, `feature`, `side` and `crossings` are those of the mesh, and
/// `fraction` is that of the way's image. `position` and `normal` are taken to the world and rounded; at the way's ends
/// `position` is the end.
template <class Scalar>
struct WorldPassage {
    Passage<Scalar> passage;
    MeshId mesh;
};

/// As `PassageOptions`, for a world.
struct WorldPassageOptions {
    Sides sides = Sides::both;
    double max_fraction = 1.0;
    /// As in `WorldOptions`.
    std::uint32_t mask = 0xffffffff;
    WorldAccept accept = {};
    QueryCounters* counters = nullptr;
    bool count_all = true;
};

/// Where a ball first runs into a mesh of a world. `hit.face`, `triangle`, `side` and `feature` are those of the mesh,
/// `center`, `contact` and `normal` are in the world.
template <class Scalar>
struct WorldSphereHit {
    SphereHit<Scalar> hit;
    MeshId mesh;
};

/// Why a face is, or is not, what a segment hits first in a world.
struct WorldFaceVerdict {
    FaceVerdict verdict;
    MeshId mesh;
};

}  // namespace pierce
