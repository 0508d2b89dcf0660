// C interface: one question, one answer. Points are three numbers in a row.
#pragma once

#include <pierce/pierce_c/mesh.h>
#include <pierce/pierce_c/values.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The hit with the exactly smallest fraction; between equal ones that of the smallest face, then triangle. Returns
/// whether there is one; `*hit` is written in any case. `hit` may be NULL.
PIERCE_EXPORT bool pierce_first_hit_f(const pierce_mesh_f* mesh, const float* from, const float* to, pierce_hit_f* hit,
                                      const pierce_query_options* options);
PIERCE_EXPORT bool pierce_first_hit_d(const pierce_mesh_d* mesh, const double* from, const double* to,
                                      pierce_hit_d* hit, const pierce_query_options* options);

/// A point moves in a straight line: when and where does it first run into the mesh? The same as `pierce_first_hit`: if
/// there is a hit the point may be moved to its `point`, and never further.
PIERCE_EXPORT bool pierce_sweep_f(const pierce_mesh_f* mesh, const float* from, const float* to, pierce_hit_f* hit,
                                  const pierce_query_options* options);
PIERCE_EXPORT bool pierce_sweep_d(const pierce_mesh_d* mesh, const double* from, const double* to, pierce_hit_d* hit,
                                  const pierce_query_options* options);

/// Whether there is any hit.
PIERCE_EXPORT bool pierce_any_hit_f(const pierce_mesh_f* mesh, const float* from, const float* to,
                                    const pierce_query_options* options);
PIERCE_EXPORT bool pierce_any_hit_d(const pierce_mesh_d* mesh, const double* from, const double* to,
                                    const pierce_query_options* options);

/// The first `capacity` hits in order of (fraction, face, triangle). Returns how many there are in all. With no
/// `capacity` they are only counted, and `hits` may be NULL.
PIERCE_EXPORT size_t pierce_all_hits_f(const pierce_mesh_f* mesh, const float* from, const float* to,
                                       pierce_hit_f* hits, size_t capacity, const pierce_query_options* options);
PIERCE_EXPORT size_t pierce_all_hits_d(const pierce_mesh_d* mesh, const double* from, const double* to,
                                       pierce_hit_d* hits, size_t capacity, const pierce_query_options* options);

/// How often the segment passes through the surface: +1 for each crossing from the front to the back of a face, -1 for
/// each from back to front, also through edges and vertices. `counters` may be NULL, here and below.
PIERCE_EXPORT int pierce_crossings_f(const pierce_mesh_f* mesh, const float* from, const float* to,
                                     pierce_counters* counters);
PIERCE_EXPORT int pierce_crossings_d(const pierce_mesh_d* mesh, const double* from, const double* to,
                                     pierce_counters* counters);

/// The same for a ray (ray.h): all points `origin + t * direction`, as exact numbers, with t from 0 to `limit`, which
/// may be INFINITY. Fractions of hits are then t.
PIERCE_EXPORT bool pierce_first_hit_of_ray_f(const pierce_mesh_f* mesh, const float* origin, const float* direction,
                                             float limit, pierce_hit_f* hit, const pierce_query_options* options);
PIERCE_EXPORT bool pierce_first_hit_of_ray_d(const pierce_mesh_d* mesh, const double* origin, const double* direction,
                                             double limit, pierce_hit_d* hit, const pierce_query_options* options);
/// Whether the ray hits anything.
PIERCE_EXPORT bool pierce_any_hit_of_ray_f(const pierce_mesh_f* mesh, const float* origin, const float* direction,
                                           float limit, const pierce_query_options* options);
PIERCE_EXPORT bool pierce_any_hit_of_ray_d(const pierce_mesh_d* mesh, const double* origin, const double* direction,
                                           double limit, const pierce_query_options* options);
/// As `pierce_all_hits_f`, of a ray.
PIERCE_EXPORT size_t pierce_all_hits_of_ray_f(const pierce_mesh_f* mesh, const float* origin, const float* direction,
                                              float limit, pierce_hit_f* hits, size_t capacity,
                                              const pierce_query_options* options);
PIERCE_EXPORT size_t pierce_all_hits_of_ray_d(const pierce_mesh_d* mesh, const double* origin, const double* direction,
                                              double limit, pierce_hit_d* hits, size_t capacity,
                                              const pierce_query_options* options);
/// As `pierce_crossings_f`, of a ray.
PIERCE_EXPORT int pierce_crossings_of_ray_f(const pierce_mesh_f* mesh, const float* origin, const float* direction,
                                            float limit, pierce_counters* counters);
PIERCE_EXPORT int pierce_crossings_of_ray_d(const pierce_mesh_d* mesh, const double* origin, const double* direction,
                                            double limit, pierce_counters* counters);

/// How many times the surface winds around the point: 1 inside of a closed mesh whose faces look outwards, 0 outside.
PIERCE_EXPORT int pierce_winding_number_f(const pierce_mesh_f* mesh, const float* point, pierce_counters* counters);
PIERCE_EXPORT int pierce_winding_number_d(const pierce_mesh_d* mesh, const double* point, pierce_counters* counters);

/// Whether the winding number is not 0.
PIERCE_EXPORT bool pierce_contains_f(const pierce_mesh_f* mesh, const float* point, pierce_counters* counters);
PIERCE_EXPORT bool pierce_contains_d(const pierce_mesh_d* mesh, const double* point, pierce_counters* counters);

/// Whether the point is outside, inside or on the surface, exactly. The triangles that it lies on go to `faces` in
/// order of (face, triangle), as far as `capacity` holds them; with a capacity of 0 it may be NULL.
PIERCE_EXPORT pierce_location pierce_locate_f(const pierce_mesh_f* mesh, const float* point, pierce_face_touch* faces,
                                              size_t capacity, pierce_counters* counters);
PIERCE_EXPORT pierce_location pierce_locate_d(const pierce_mesh_d* mesh, const double* point, pierce_face_touch* faces,
                                              size_t capacity, pierce_counters* counters);

/// The first `capacity` places where the segment passes through the surface or touches it, in exact order. Returns how
/// many there are in all, unless `stop_when_full` is set. The faces of passage p go to `faces[p.first_face]` and so on,
/// `p.face_count` of them, if all of them fit. Arrays with a capacity of 0 may be NULL.
PIERCE_EXPORT size_t pierce_passages_f(const pierce_mesh_f* mesh, const float* from, const float* to,
                                       pierce_passage_f* passages, size_t capacity, pierce_face_touch* faces,
                                       size_t face_capacity, const pierce_passage_options* options);
PIERCE_EXPORT size_t pierce_passages_d(const pierce_mesh_d* mesh, const double* from, const double* to,
                                       pierce_passage_d* passages, size_t capacity, pierce_face_touch* faces,
                                       size_t face_capacity, const pierce_passage_options* options);

#ifdef __cplusplus
}
#endif
