// C interface: meshes made ready for queries, what is odd about them, and files.
#pragma once

#include <pierce/pierce_c/basics.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Triangles made ready for queries: built once, never changed, shared by threads.
typedef struct pierce_mesh_f pierce_mesh_f;
typedef struct pierce_mesh_d pierce_mesh_d;

/// How the triangles near a segment are found. The answers are the same, to the last bit.
typedef enum pierce_broadphase {
    PIERCE_AUTOMATIC = 0,  ///< what the environment variable PIERCE_BROADPHASE says, else the tree
    PIERCE_TREE = 1,       ///< a tree of boxes
    PIERCE_GRID = 2,       ///< one uniform grid
} pierce_broadphase;

/// Zeros are the defaults. None of these changes an answer.
typedef struct pierce_build_options {
    pierce_broadphase broadphase;     ///< what to build
    double cell_size;                 ///< of the grid, in units of the mesh; 0: chosen from the triangles' sizes
    size_t max_grid_bytes;            ///< 0: a multiple of the number of triangles
    const char* backend;              ///< avx512, avx2, sse2, neon or plain; NULL: the machine's fastest
    const pierce_executor* executor;  ///< builds in parallel, if given
} pierce_build_options;

/// Copies what it needs. On failure `*mesh` is NULL: PIERCE_BAD_MESH where an index is out of range or a coordinate is
/// not finite. A mesh without triangles is fine. n log n time for n triangles.
PIERCE_EXPORT pierce_status pierce_mesh_create_f(const pierce_points_f* positions, const pierce_triangles* triangles,
                                                 const pierce_build_options* options, pierce_mesh_f** mesh);
PIERCE_EXPORT pierce_status pierce_mesh_create_d(const pierce_points_d* positions, const pierce_triangles* triangles,
                                                 const pierce_build_options* options, pierce_mesh_d** mesh);
/// Frees the mesh; NULL is fine.
PIERCE_EXPORT void pierce_mesh_destroy_f(pierce_mesh_f* mesh);
PIERCE_EXPORT void pierce_mesh_destroy_d(pierce_mesh_d* mesh);

/// What was built. Bytes are those that the library holds.
typedef struct pierce_statistics {
    size_t vertices;               ///< positions, used or not
    size_t faces;                  ///< different numbers in `pierce_triangles.faces`
    size_t triangles;              ///< all of them
    size_t degenerate;             ///< triangles of area zero: kept, and never hit
    size_t clusters;               ///< records of up to eight triangles
    pierce_broadphase broadphase;  ///< PIERCE_TREE or PIERCE_GRID
    size_t nodes;                  ///< of the tree; 0 with a grid
    double cell_size;              ///< of the grid; 0 with a tree
    size_t grid_references;        ///< entries of all its cell lists together
    char backend[16];              ///< empty if nothing was built
    size_t bytes;                  ///< that the library holds for it
    uint64_t invalid_queries;      ///< so far, with a coordinate that is not finite: they had no hit
} pierce_statistics;

/// All zeros for a null mesh.
PIERCE_EXPORT void pierce_mesh_statistics_f(const pierce_mesh_f* mesh, pierce_statistics* statistics);
PIERCE_EXPORT void pierce_mesh_statistics_d(const pierce_mesh_d* mesh, pierce_statistics* statistics);

/// What is odd about a mesh (mesh_report.h). Vertices with equal coordinates count as one.
typedef struct pierce_mesh_report {
    bool closed;                   ///< no particle gets from one side to the other without a hit
    size_t zero_area;              ///< triangles
    size_t duplicates;             ///< triangles with the corners of one before
    size_t border_edges;           ///< edges with one triangle
    size_t non_manifold_edges;     ///< edges with more than two
    size_t misoriented_edges;      ///< edges that more triangles follow one way than the other
    size_t non_manifold_vertices;  ///< vertices whose triangles fall into several fans
    size_t t_junctions;            ///< border vertices in the middle of a border edge
    size_t components;             ///< sets of triangles joined by edges
    size_t edges_with[9];          ///< [n]: edges that n triangles share; [8]: with 8 and more
} pierce_mesh_report;

/// Looks at the mesh anew with each call. `report` may be NULL. The text, a few lines for people, goes to `text` as far
/// as `text_size` bytes hold it, with a 0 behind it; `*text_length` is the length of all of it, without the 0. Either
/// may be NULL.
PIERCE_EXPORT pierce_status pierce_mesh_report_f(const pierce_mesh_f* mesh, pierce_mesh_report* report, char* text,
                                                 size_t text_size, size_t* text_length);
PIERCE_EXPORT pierce_status pierce_mesh_report_d(const pierce_mesh_d* mesh, pierce_mesh_report* report, char* text,
                                                 size_t text_size, size_t* text_length);

/// What a file holds: positions and triangles (triangle_soup.h).
typedef struct pierce_soup_f pierce_soup_f;
typedef struct pierce_soup_d pierce_soup_d;

/// Zeros are the defaults: nothing but the surface is kept.
typedef struct pierce_read_options {
    bool materials;  ///< keep the names of materials
    bool groups;     ///< keep the names of groups
} pierce_read_options;

/// Reads OBJ, OFF, PLY or STL, told by the name's ending. On failure `*soup` is NULL: PIERCE_BAD_FILE, with a message
/// that names the file, the line or byte, and the reason.
PIERCE_EXPORT pierce_status pierce_soup_read_f(const char* path, const pierce_read_options* options,
                                               pierce_soup_f** soup);
PIERCE_EXPORT pierce_status pierce_soup_read_d(const char* path, const pierce_read_options* options,
                                               pierce_soup_d** soup);
/// Frees the soup; NULL is fine.
PIERCE_EXPORT void pierce_soup_destroy_f(pierce_soup_f* soup);
PIERCE_EXPORT void pierce_soup_destroy_d(pierce_soup_d* soup);

/// The soup's own arrays, as `pierce_mesh_create` takes them; valid until the soup is destroyed. A null soup has none.
/// Either may be NULL.
PIERCE_EXPORT void pierce_soup_view_f(const pierce_soup_f* soup, pierce_points_f* positions,
                                      pierce_triangles* triangles);
PIERCE_EXPORT void pierce_soup_view_d(const pierce_soup_d* soup, pierce_points_d* positions,
                                      pierce_triangles* triangles);

/// The name of the material of a face of the file, as hits name it; valid until the soup is destroyed. NULL where it
/// has none, or they were not asked for.
PIERCE_EXPORT const char* pierce_soup_material_f(const pierce_soup_f* soup, uint32_t face);
PIERCE_EXPORT const char* pierce_soup_material_d(const pierce_soup_d* soup, uint32_t face);
/// The name of the group, in the same way.
PIERCE_EXPORT const char* pierce_soup_group_f(const pierce_soup_f* soup, uint32_t face);
PIERCE_EXPORT const char* pierce_soup_group_d(const pierce_soup_d* soup, uint32_t face);

#ifdef __cplusplus
}
#endif
