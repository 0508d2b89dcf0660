// C interface: status and message, version, and views of the caller's arrays.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <pierce/export.h>

/// Arrays of these structures are those of C++, without a copy: the compiler must know that one is read as the other.
#ifdef __GNUC__
#define PIERCE_MAY_ALIAS __attribute__((may_alias))
#else
#define PIERCE_MAY_ALIAS
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// Why something could not be done. The numbers stay what they are.
typedef enum pierce_status {
    PIERCE_OK = 0,             ///< it was done
    PIERCE_BAD_MESH = 1,       ///< the mesh can't be used: an index out of range, a coordinate that is not finite
    PIERCE_BAD_FILE = 2,       ///< the file can't be read, or holds no mesh that can be used
    PIERCE_BAD_ARGUMENT = 3,   ///< an option without a meaning, sizes that don't fit, a null pointer
    PIERCE_OUT_OF_MEMORY = 4,  ///< there was not enough of it
    PIERCE_FAILED = 5,         ///< anything else, from the caller's executor or the system
} pierce_status;

/// A few words for people, such as "bad mesh". Empty for a number that is no status. Never freed.
PIERCE_EXPORT const char* pierce_status_text(pierce_status status);

/// What was wrong in the last call of this thread that returned anything but PIERCE_OK: one line that names the face,
/// vertex, file or call. Empty if there was none. Valid until the next call of this thread that fails, or its end.
PIERCE_EXPORT const char* pierce_last_message(void);

/// The version of the library that runs, as PIERCE_VERSION is that of the headers: 1.2.3 is 10203.
PIERCE_EXPORT int pierce_version(void);

/// Points of the caller, wherever they lie: three floats in a row, and from one point to the next `stride` bytes, which
/// may be any number, negative as well. 0 stands for 3 * sizeof(float): one point behind the other. Nothing is copied.
typedef struct pierce_points_f {
    const float* first;  ///< the first number of the first point
    size_t count;        ///< how many points
    ptrdiff_t stride;    ///< bytes from one point to the next, or 0
} pierce_points_f;

/// The same in double. If `first` is NULL, `floats` is used: points in float for a mesh in double. A stride of 0
/// then stands for 3 * sizeof(float).
typedef struct pierce_points_d {
    const double* first;  ///< the first number of the first point, or NULL
    size_t count;         ///< how many points
    ptrdiff_t stride;     ///< bytes from one point to the next, or 0
    const float* floats;  ///< the same in float, used if `first` is NULL
} pierce_points_d;

/// Triangles of the caller: three indices of positions in a row, counter-clockwise seen from the front, and from one
/// triangle to the next `stride` bytes. 0 stands for three indices: one triangle behind the other.
typedef struct pierce_triangles {
    const uint32_t* first;   ///< the first index of the first triangle, or NULL
    size_t count;            ///< triangles, not indices
    ptrdiff_t stride;        ///< bytes from one triangle to the next, or 0
    const uint16_t* shorts;  ///< used if `first` is NULL: indices of 16 bits
    /// For each triangle the number of its face, with which hits name it; several triangles may share one. NULL: the
    /// number of the triangle.
    const uint32_t* faces;
} pierce_triangles;

/// Segments: as many starts as ends.
typedef struct pierce_segments_f {
    pierce_points_f from;  ///< where each begins
    pierce_points_f to;    ///< where each ends
} pierce_segments_f;

typedef struct pierce_segments_d {
    pierce_points_d from;
    pierce_points_d to;
} pierce_segments_d;

/// Rays: all points `origin + t * direction` with t from 0 to a limit, which may be INFINITY. As many directions as
/// origins; and no limit (`limit_count` 0: all are infinite), one for all of them, or one for each, `limit_stride`
/// bytes apart (0: one behind the other).
typedef struct pierce_rays_f {
    pierce_points_f origins;     ///< where each begins
    pierce_points_f directions;  ///< where each goes; of any length but 0
    const float* limits;         ///< the largest t; NULL where there is none
    size_t limit_count;          ///< 0, 1 or one for each ray
    ptrdiff_t limit_stride;      ///< bytes from one limit to the next, or 0
} pierce_rays_f;

typedef struct pierce_rays_d {
    pierce_points_d origins;
    pierce_points_d directions;
    const double* limits;
    size_t limit_count;
    ptrdiff_t limit_stride;
} pierce_rays_d;

/// One part of the work: called with `data` as it was given and the number of the part.
typedef void (*pierce_task)(void* data, size_t part);

/// Runs work on the caller's threads: `run(parts, task, data, user)` calls `task(data, i)` once for each i below
/// `parts`, in any order and on any threads, and returns when all are done. Answers don't depend on it. A null pointer
/// to an executor, or a null `run`: the thread that calls does it all.
typedef struct pierce_executor {
    void (*run)(size_t parts, pierce_task task, void* data,
                void* user);  ///< does all parts, and returns when they are done
    void* user;               ///< handed to `run`
} pierce_executor;

#ifdef __cplusplus
}
#endif
