// C interface: many questions in one call. Answer i is that of the single query for number i, to the last bit.
#pragma once

#include <pierce/pierce_c/mesh.h>
#include <pierce/pierce_c/values.h>

#ifdef __cplusplus
extern "C" {
#endif

// Arrays for answers have as many places as there are questions. Where a status is not PIERCE_OK, nothing is written,
// but for PIERCE_FAILED and PIERCE_OUT_OF_MEMORY, which may come in the middle. `options`, `counters` and `executor`
// may be NULL, and so may `count`, where the number of hits (or of points that are contained, or on the surface) goes.

/// Hits as an array of hits: a query without one has PIERCE_NO_FACE as its face, all else is 0.
PIERCE_EXPORT pierce_status pierce_first_hits_f(const pierce_mesh_f* mesh, const pierce_segments_f* segments,
                                                pierce_hit_f* hits, size_t* count, const pierce_query_options* options,
                                                const pierce_executor* executor);
PIERCE_EXPORT pierce_status pierce_first_hits_d(const pierce_mesh_d* mesh, const pierce_segments_d* segments,
                                                pierce_hit_d* hits, size_t* count, const pierce_query_options* options,
                                                const pierce_executor* executor);
/// The same as `pierce_first_hits_f`, for steps of moving points.
PIERCE_EXPORT pierce_status pierce_sweeps_f(const pierce_mesh_f* mesh, const pierce_segments_f* steps,
                                            pierce_hit_f* hits, size_t* count, const pierce_query_options* options,
                                            const pierce_executor* executor);
PIERCE_EXPORT pierce_status pierce_sweeps_d(const pierce_mesh_d* mesh, const pierce_segments_d* steps,
                                            pierce_hit_d* hits, size_t* count, const pierce_query_options* options,
                                            const pierce_executor* executor);
/// The same for rays.
PIERCE_EXPORT pierce_status pierce_first_hits_of_rays_f(const pierce_mesh_f* mesh, const pierce_rays_f* rays,
                                                        pierce_hit_f* hits, size_t* count,
                                                        const pierce_query_options* options,
                                                        const pierce_executor* executor);
PIERCE_EXPORT pierce_status pierce_first_hits_of_rays_d(const pierce_mesh_d* mesh, const pierce_rays_d* rays,
                                                        pierce_hit_d* hits, size_t* count,
                                                        const pierce_query_options* options,
                                                        const pierce_executor* executor);

/// Hits as one array for each of their members. Null arrays are not written; points and vectors take three numbers.
typedef struct pierce_hit_arrays_f {
    uint8_t* hit;            ///< 1 or 0
    float* fraction;         ///< as in `pierce_hit_f`
    float* exact_fraction;   ///< as in `pierce_hit_f`
    float* point;            ///< as in `pierce_hit_f`, three numbers a hit
    float* position;         ///< as in `pierce_hit_f`, three numbers a hit
    float* normal;           ///< as in `pierce_hit_f`, three numbers a hit
    float* barycentric;      ///< as in `pierce_hit_f`, three numbers a hit
    uint32_t* face;          ///< as in `pierce_hit_f`
    uint32_t* triangle;      ///< as in `pierce_hit_f`
    uint8_t* side;           ///< as in `pierce_hit_f`
    uint8_t* feature;        ///< as in `pierce_hit_f`
    uint8_t* feature_index;  ///< as in `pierce_hit_f`
    uint8_t* at_start;       ///< 1 or 0
} pierce_hit_arrays_f;

typedef struct pierce_hit_arrays_d {
    uint8_t* hit;
    double* fraction;
    double* exact_fraction;
    double* point;
    double* position;
    double* normal;
    double* barycentric;
    uint32_t* face;
    uint32_t* triangle;
    uint8_t* side;
    uint8_t* feature;
    uint8_t* feature_index;
    uint8_t* at_start;
} pierce_hit_arrays_d;

/// As `pierce_first_hits_f`, into arrays.
PIERCE_EXPORT pierce_status pierce_first_hit_arrays_f(const pierce_mesh_f* mesh, const pierce_segments_f* segments,
                                                      const pierce_hit_arrays_f* arrays, size_t* count,
                                                      const pierce_query_options* options,
                                                      const pierce_executor* executor);
PIERCE_EXPORT pierce_status pierce_first_hit_arrays_d(const pierce_mesh_d* mesh, const pierce_segments_d* segments,
                                                      const pierce_hit_arrays_d* arrays, size_t* count,
                                                      const pierce_query_options* options,
                                                      const pierce_executor* executor);
PIERCE_EXPORT pierce_status pierce_first_hit_arrays_of_rays_f(const pierce_mesh_f* mesh, const pierce_rays_f* rays,
                                                              const pierce_hit_arrays_f* arrays, size_t* count,
                                                              const pierce_query_options* options,
                                                              const pierce_executor* executor);
PIERCE_EXPORT pierce_status pierce_first_hit_arrays_of_rays_d(const pierce_mesh_d* mesh, const pierce_rays_d* rays,
                                                              const pierce_hit_arrays_d* arrays, size_t* count,
                                                              const pierce_query_options* options,
                                                              const pierce_executor* executor);

/// Whether there is any hit: 1 or 0.
PIERCE_EXPORT pierce_status pierce_any_hits_f(const pierce_mesh_f* mesh, const pierce_segments_f* segments,
                                              uint8_t* answers, size_t* count, const pierce_query_options* options,
                                              const pierce_executor* executor);
PIERCE_EXPORT pierce_status pierce_any_hits_d(const pierce_mesh_d* mesh, const pierce_segments_d* segments,
                                              uint8_t* answers, size_t* count, const pierce_query_options* options,
                                              const pierce_executor* executor);
PIERCE_EXPORT pierce_status pierce_any_hits_of_rays_f(const pierce_mesh_f* mesh, const pierce_rays_f* rays,
                                                      uint8_t* answers, size_t* count,
                                                      const pierce_query_options* options,
                                                      const pierce_executor* executor);
PIERCE_EXPORT pierce_status pierce_any_hits_of_rays_d(const pierce_mesh_d* mesh, const pierce_rays_d* rays,
                                                      uint8_t* answers, size_t* count,
                                                      const pierce_query_options* options,
                                                      const pierce_executor* executor);

/// All hits as compressed rows: those of question i are `hits[offsets[i]]` up to `hits[offsets[i + 1]]`, without that.
/// `offsets` has one place more than there are questions. The hits of a question are written if all of them fit in
/// `capacity`; `*count` is how many there are in all: call with a capacity of 0 to learn it, make room, call again.
PIERCE_EXPORT pierce_status pierce_all_hit_rows_f(const pierce_mesh_f* mesh, const pierce_segments_f* segments,
                                                  size_t* offsets, pierce_hit_f* hits, size_t capacity, size_t* count,
                                                  const pierce_query_options* options, const pierce_executor* executor);
PIERCE_EXPORT pierce_status pierce_all_hit_rows_d(const pierce_mesh_d* mesh, const pierce_segments_d* segments,
                                                  size_t* offsets, pierce_hit_d* hits, size_t capacity, size_t* count,
                                                  const pierce_query_options* options, const pierce_executor* executor);
PIERCE_EXPORT pierce_status pierce_all_hit_rows_of_rays_f(const pierce_mesh_f* mesh, const pierce_rays_f* rays,
                                                          size_t* offsets, pierce_hit_f* hits, size_t capacity,
                                                          size_t* count, const pierce_query_options* options,
                                                          const pierce_executor* executor);
PIERCE_EXPORT pierce_status pierce_all_hit_rows_of_rays_d(const pierce_mesh_d* mesh, const pierce_rays_d* rays,
                                                          size_t* offsets, pierce_hit_d* hits, size_t capacity,
                                                          size_t* count, const pierce_query_options* options,
                                                          const pierce_executor* executor);

/// `pierce_crossings` of many.
PIERCE_EXPORT pierce_status pierce_crossing_counts_f(const pierce_mesh_f* mesh, const pierce_segments_f* segments,
                                                     int* crossings, pierce_counters* counters,
                                                     const pierce_executor* executor);
PIERCE_EXPORT pierce_status pierce_crossing_counts_d(const pierce_mesh_d* mesh, const pierce_segments_d* segments,
                                                     int* crossings, pierce_counters* counters,
                                                     const pierce_executor* executor);
PIERCE_EXPORT pierce_status pierce_crossing_counts_of_rays_f(const pierce_mesh_f* mesh, const pierce_rays_f* rays,
                                                             int* crossings, pierce_counters* counters,
                                                             const pierce_executor* executor);
PIERCE_EXPORT pierce_status pierce_crossing_counts_of_rays_d(const pierce_mesh_d* mesh, const pierce_rays_d* rays,
                                                             int* crossings, pierce_counters* counters,
                                                             const pierce_executor* executor);

/// `pierce_contains` of many points: 1 or 0. Takes some memory while it runs, 16 MiB at most, as the next one does.
PIERCE_EXPORT pierce_status pierce_contains_points_f(const pierce_mesh_f* mesh, const pierce_points_f* points,
                                                     uint8_t* answers, size_t* count, pierce_counters* counters,
                                                     const pierce_executor* executor);
PIERCE_EXPORT pierce_status pierce_contains_points_d(const pierce_mesh_d* mesh, const pierce_points_d* points,
                                                     uint8_t* answers, size_t* count, pierce_counters* counters,
                                                     const pierce_executor* executor);
/// `pierce_winding_number` of many points.
PIERCE_EXPORT pierce_status pierce_winding_numbers_f(const pierce_mesh_f* mesh, const pierce_points_f* points,
                                                     int* numbers, pierce_counters* counters,
                                                     const pierce_executor* executor);
PIERCE_EXPORT pierce_status pierce_winding_numbers_d(const pierce_mesh_d* mesh, const pierce_points_d* points,
                                                     int* numbers, pierce_counters* counters,
                                                     const pierce_executor* executor);
/// `pierce_locate` of many points.
PIERCE_EXPORT pierce_status pierce_locate_points_f(const pierce_mesh_f* mesh, const pierce_points_f* points,
                                                   pierce_location* locations, size_t* count, pierce_counters* counters,
                                                   const pierce_executor* executor);
PIERCE_EXPORT pierce_status pierce_locate_points_d(const pierce_mesh_d* mesh, const pierce_points_d* points,
                                                   pierce_location* locations, size_t* count, pierce_counters* counters,
                                                   const pierce_executor* executor);

#ifdef __cplusplus
}
#endif
