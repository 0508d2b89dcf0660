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
    FaceTouch touch;  ///< the triangle, in the numbers of the mesh
    MeshId mesh;      ///< which one
};

/// A passage through the surface of one mesh. Numbers, `feature`, `side` and `crossings` are those of the mesh, and
/// `fraction` is that of the way's image. `position` and `normal` are taken to the world and rounded; at the way's ends
/// `position` is the end.
template <class Scalar>
struct WorldPassage {
    Passage<Scalar> passage;  ///< in the world where said above
    MeshId mesh;              ///< which one
};

/// As `PassageOptions`, for a world.
struct WorldPassageOptions {
    Sides sides = Sides::both;  ///< as in `PassageOptions`
    double max_fraction = 1.0;  ///< as in `PassageOptions`
    /// As in `WorldOptions`.
    std::uint32_t mask = 0xffffffff;
    WorldAccept accept = {};            ///< as in `WorldOptions`
    QueryCounters* counters = nullptr;  ///< as in `WorldOptions`
    bool count_all = true;              ///< as in `PassageOptions`
};

/// Where a ball first runs into a mesh of a world. `hit.face`, `triangle`, `side` and `feature` are those of the mesh,
/// `center`, `contact` and `normal` are in the world.
template <class Scalar>
struct WorldSphereHit {
    SphereHit<Scalar> hit;  ///< in the world where said above
    MeshId mesh;            ///< which one
};

/// Why a face is, or is not, what a segment hits first in a world.
struct WorldFaceVerdict {
    FaceVerdict verdict;  ///< in the numbers of the mesh
    MeshId mesh;          ///< which one
};

}  // namespace pierce
