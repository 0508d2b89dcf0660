// A picture of a mesh, made by casting segments from a camera.
#pragma once

#include <cstdint>

#include <pierce/collision_mesh.h>
#include <pierce/triangle_soup.h>

#include "cast/options.h"
#include "cast/png_file.h"
#include "cast/progress.h"

/// Faces are seen from both sides, fronts and backs in different colours. `progress` counts rows of pixels.
template <class Scalar>
Image draw(const pierce::CollisionMesh<Scalar>& mesh, const pierce::TriangleSoup<Scalar>& soup,
           const PictureOptions& options, Progress& progress);
