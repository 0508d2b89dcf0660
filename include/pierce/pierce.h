// pierce: where does a moving point, or a segment, first pass through a triangle mesh? Exactly, and fast.
//
//     auto soup = pierce::read_mesh<double>("level.obj");        // or a MeshView of your own arrays
//     pierce::CollisionMesh<double> level(soup.view());          // built once; shared by threads
//     if (auto hit = level.first_hit({from, to}))                 // from, to: Eigen::Vector3d
//         particle = hit->point;                                  // safe to stand on, safe to step from
//
// Read on in this order: types.h, mesh_view.h, triangle_soup.h, hit.h, options.h, ray.h, location.h, passage.h,
// sphere.h, batch.h, collision_mesh.h; response.h for what a particle does after a hit; sweep_hit.h, motion.h,
// rigid_hit.h, motion_sweeps.h and deforming_mesh.h for meshes that move; world.h for many meshes; regions.h for
// particle transport; result.h for programs without exceptions; explain.h and visits.h for why. <pierce/openmesh.h>
// adds OpenMesh meshes, <pierce/tbb.h> the threads of oneTBB, <pierce/kernels.h> tests for single triangles.
// <pierce/pierce_c.h> is for programs in C.
#pragma once

#include <pierce/batch.h>
#include <pierce/collision_mesh.h>
#include <pierce/deforming_mesh.h>
#include <pierce/executor.h>
#include <pierce/hit.h>
#include <pierce/location.h>
#include <pierce/mesh_error.h>
#include <pierce/mesh_view.h>
#include <pierce/motion.h>
#include <pierce/motion_sweeps.h>
#include <pierce/options.h>
#include <pierce/passage.h>
#include <pierce/ray.h>
#include <pierce/regions.h>
#include <pierce/response.h>
#include <pierce/result.h>
#include <pierce/rigid_hit.h>
#include <pierce/sphere.h>
#include <pierce/sweep_hit.h>
#include <pierce/triangle_soup.h>
#include <pierce/try_read_mesh.h>
#include <pierce/types.h>
#include <pierce/version.h>
#include <pierce/visits.h>
#include <pierce/world.h>
