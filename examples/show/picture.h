// Draws a mesh by casting a segment from the camera through each sample.
#pragma once

#include <functional>
#include <vector>

#include <pierce/collision_mesh.h>
#include <pierce/triangle_soup.h>

#include "show/canvas.h"

namespace show {

/// What of the mesh is to be in view: the corners of its triangles, not the positions, as some may belong to none.
template <class Scalar>
std::vector<Point> corners_of(const pierce::TriangleSoup<Scalar>& soup) {
    std::vector<Point> corners;
    corners.reserve(3 * soup.triangles.size());
    for (const auto& triangle : soup.triangles)
        for (const auto corner : triangle) corners.push_back(soup.positions[corner].template cast<double>());
    return corners;
}

struct Paint {
    Colour front = {0.72f, 0.52f, 0.34f};
    Colour back = {0.22f, 0.36f, 0.52f};
    pierce::Sides sides = pierce::Sides::both;  ///< what is seen of the mesh: for `back` one looks into it
};

/// Draws the mesh, with its shadows, and a background. `row_is_drawn` is called from any of the threads. Throws
/// std::runtime_error where the camera is further away than the mesh's numbers go.
template <class Scalar>
void draw(const pierce::CollisionMesh<Scalar>& mesh, const Camera& camera, Canvas& canvas, unsigned threads,
          const Paint& paint = {}, const std::function<void()>& row_is_drawn = {});

}  // namespace show
