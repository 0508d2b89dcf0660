// Meshes that the demos make where none is given.
#pragma once

#include <cstdint>

#include <pierce/triangle_soup.h>
#include <Eigen/Geometry>

namespace show {

/// A closed surface around the origin, of radius about 1, with hills and valleys: 8 n^2 triangles that face outwards.
pierce::TriangleSoup<float> bumpy_sphere(int n);

/// A box from -1 to 1 in each axis, each side divided into n^2 squares of two triangles, facing outwards; then moved.
pierce::TriangleSoup<float> box(int n, const Eigen::Affine3d& transform);

/// Adds what is in `more`, with its faces turned around where asked.
void add(pierce::TriangleSoup<float>& soup, const pierce::TriangleSoup<float>& more, bool turned = false);

/// A level of a game: a closed hall of 40 x 12 x 40 whose walls face inwards, with crates and boulders that face
/// outwards and do not meet. The winding number is -1 where there is room, 0 in solid matter and outside. `frame` says
/// where its lower corner and its axes are: far from the origin floats are coarse.
pierce::TriangleSoup<float> hall(std::uint32_t seed, const Eigen::Isometry3d& frame);

/// A closed drum of radius 1 around the z axis, 1 long, with six paddles inside. Its faces look inwards.
pierce::TriangleSoup<float> paddle_drum();

/// A closed courtyard of 24 x 6 x 24 whose walls face inwards, on a floor of 60 x 60 squares, with pillars and a ramp.
pierce::TriangleSoup<float> courtyard();

}  // namespace show
