// pierce for programs in C (C17), and for languages that call C: the meshes, queries, batches and regions of
// <pierce/pierce.h>. C++ programs (C++11 and newer) may include it as well.
//
//     pierce_mesh_d* floor = NULL;
//     const pierce_points_d positions = {.first = corners, .count = 4};           // double corners[12]
//     const pierce_triangles triangles = {.first = indices, .count = 2};          // uint32_t indices[6]
//     if (pierce_mesh_create_d(&positions, &triangles, NULL, &floor) != PIERCE_OK)
//         return puts(pierce_last_message());
//     pierce_hit_d hit;
//     if (pierce_first_hit_d(floor, from, to, &hit, NULL))                        // double from[3], to[3]
//         memcpy(particle, hit.point, sizeof hit.point);                          // where to stop
//     pierce_mesh_destroy_d(floor);
//
// **Names.** All begin with `pierce_` or `PIERCE_`. What ends in `_f` works in float, what ends in `_d` in double; the
// two are the same otherwise, and each is described once. The answers are those of C++, to the last bit, and so are the
// rules: the C++ header of the same name has them in full (hit.h, options.h, ray.h, location.h, passage.h, regions.h).
//
// **Arguments** come in one order: the mesh, the question, places for answers, options, executor. A point or vector is
// three numbers in a row. A structure of options is set to zero first (`= {0}`), which gives each member its default;
// NULL stands for a structure of zeros. Later versions may add members behind the others, by that rule. Structures keep
// their layout within a minor version, which the name of the shared library says (libpierce.so.0.2).
//
// **Errors.** What can fail returns a `pierce_status`; `pierce_last_message` says why in a line. Single queries can't
// fail, and have no status. A null pointer is never followed. Where it can't stand for "none", a function with a status
// returns PIERCE_BAD_ARGUMENT. A single query with a null mesh, null regions, a null point or options without a meaning
// has no hit and counts nothing. No C++ exception comes out of any function. Callbacks must not end by `longjmp` or by
// an exception; one that an executor throws becomes PIERCE_FAILED.
//
// **Ownership and threads.** What a `create` or `read` gives belongs to the caller, until the `destroy` of the same
// name, which takes NULL as well. Arrays given to a `create` may be freed afterwards. Queries may run on any number of
// threads at once, but each thread needs counters of its own.
//
// **Building.** `cc program.c $(pkg-config --cflags --libs pierce)`; `--static` adds `-lstdc++ -lm`, which a static
// libpierce.a needs behind it. With CMake, `find_package(pierce)` and `pierce::pierce` in a
// `project(... LANGUAGES C CXX)`: the C++ compiler links the program where pierce is static.
//
// Not here, for C++ only: balls, responses, meshes that move or deform, worlds of many meshes, `explain`, the lists of
// examples in reports, single-triangle kernels and fans, OpenMesh.
#pragma once

#include <pierce/pierce_c/basics.h>
#include <pierce/pierce_c/batches.h>
#include <pierce/pierce_c/mesh.h>
#include <pierce/pierce_c/queries.h>
#include <pierce/pierce_c/regions.h>
#include <pierce/pierce_c/values.h>
#include <pierce/version.h>
