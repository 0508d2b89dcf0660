/* Batches in C: the bits of C++, whatever form the answers have, and of single calls. */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "expected.h"
#include "story.h"

int batch_failures(void);
int batch_failures(void) { return failures; }

enum { QUERIES = 3000 };

/* Quarters from -1 to 5: many of them lie on faces, edges and corners. */
static double next_coordinate(void) {
    static uint32_t state = 1;
    state = state * 1664525u + 1013904223u;
    return (double)((state >> 8) % 25) / 4 - 1;
}

static void run_backwards(size_t parts, pierce_task task, void* data, void* user) {
    *(size_t*)user += parts;
    while (parts > 0) task(data, --parts);
}

static double wide[6 * QUERIES];
static float narrow[6 * QUERIES];
static pierce_hit_d hits_d[QUERIES], same_d[QUERIES];
static pierce_hit_f hits_f[QUERIES], same_f[QUERIES];

static void in_float(const struct vertex* vertices, const uint16_t* indices) {
    const pierce_points_f positions = {vertices[0].position, CUBE_CORNERS, sizeof(struct vertex)};
    const pierce_triangles triangles = {.shorts = indices, .count = CUBE_FACES};
    pierce_mesh_f* cubes = NULL;
    CHECK(pierce_mesh_create_f(&positions, &triangles, NULL, &cubes) == PIERCE_OK);
    const ptrdiff_t stride = 6 * sizeof(float);
    const pierce_segments_f segments = {{narrow, QUERIES, stride}, {narrow + 3, QUERIES, stride}};
    const pierce_query_options both = {.sides = PIERCE_BOTH};
    expected_first_hits_f(vertices, indices, narrow, QUERIES, same_f);
    CHECK(pierce_first_hits_f(cubes, &segments, hits_f, NULL, &both, NULL) == PIERCE_OK);
    CHECK(memcmp(hits_f, same_f, sizeof hits_f) == 0);
    pierce_mesh_destroy_f(cubes);
}

void batches(const struct vertex* vertices, const uint16_t* indices, const pierce_mesh_d* cubes) {
    for (int i = 0; i < 6 * QUERIES; ++i) narrow[i] = (float)(wide[i] = next_coordinate());
    const ptrdiff_t stride = 6 * sizeof(double);
    const pierce_points_d starts = {.first = wide, .count = QUERIES, .stride = stride};
    const pierce_points_d ends = {.first = wide + 3, .count = QUERIES, .stride = stride};
    const pierce_segments_d segments = {starts, ends};
    const pierce_query_options both = {.sides = PIERCE_BOTH};

    /* As in C++, and as single calls. */
    size_t count = 0, counted = 0;
    expected_first_hits_d(vertices, indices, wide, QUERIES, same_d);
    CHECK(pierce_first_hits_d(cubes, &segments, hits_d, &count, &both, NULL) == PIERCE_OK);
    CHECK(memcmp(hits_d, same_d, sizeof hits_d) == 0);
    for (int i = 0; i < QUERIES; ++i) {
        pierce_hit_d hit;
        counted += pierce_first_hit_d(cubes, wide + 6 * i, wide + 6 * i + 3, &hit, &both);
        CHECK(memcmp(&hit, &hits_d[i], sizeof hit) == 0);
    }
    CHECK(count == counted && count > QUERIES / 4 && count < QUERIES);
    in_float(vertices, indices);

    /* On the caller's threads, or in his order. */
    size_t parts = 0;
    const pierce_executor backwards = {run_backwards, &parts};
    memset(hits_d, 0, sizeof hits_d);
    CHECK(pierce_sweeps_d(cubes, &segments, hits_d, NULL, &both, &backwards) == PIERCE_OK);
    CHECK(parts > 1 && memcmp(hits_d, same_d, sizeof hits_d) == 0);

    /* One array for each member. */
    static double points[3 * QUERIES];
    static uint8_t any[QUERIES], sides[QUERIES];
    static uint32_t faces[QUERIES];
    const pierce_hit_arrays_d arrays = {.hit = any, .point = points, .face = faces, .side = sides};
    CHECK(pierce_first_hit_arrays_d(cubes, &segments, &arrays, &counted, &both, NULL) == PIERCE_OK);
    CHECK(counted == count);
    for (int i = 0; i < QUERIES; ++i) {
        CHECK(any[i] == (hits_d[i].face != PIERCE_NO_FACE) && faces[i] == hits_d[i].face);
        CHECK(sides[i] == hits_d[i].side && memcmp(points + 3 * i, hits_d[i].point, sizeof hits_d[i].point) == 0);
    }

    /* Rows of all hits: first how many, then the hits. */
    static size_t offsets[QUERIES + 1];
    size_t total = 0;
    CHECK(pierce_all_hit_rows_d(cubes, &segments, offsets, NULL, 0, &total, &both, NULL) == PIERCE_OK);
    pierce_hit_d* const all = malloc(total * sizeof *all);
    CHECK(all != NULL && total > count);
    CHECK(pierce_all_hit_rows_d(cubes, &segments, offsets, all, total, NULL, &both, NULL) == PIERCE_OK);
    CHECK(offsets[0] == 0 && offsets[QUERIES] == total);
    for (int i = 0; i < QUERIES; ++i)
        if (any[i]) CHECK(memcmp(&all[offsets[i]], &hits_d[i], sizeof *all) == 0);
    free(all);

    /* Rays of a limit each: only those of the first half are long enough to do anything. */
    static double limits[QUERIES];
    for (int i = 0; i < QUERIES / 2; ++i) limits[i] = 10;
    const pierce_rays_d rays = {.origins = starts, .directions = ends, .limits = limits, .limit_count = QUERIES};
    CHECK(pierce_any_hits_of_rays_d(cubes, &rays, any, &count, &both, NULL) == PIERCE_OK);
    for (int i = 0; i < QUERIES; ++i)
        CHECK(any[i] == pierce_any_hit_of_ray_d(cubes, wide + 6 * i, wide + 6 * i + 3, limits[i], &both));
    CHECK(count > 0 && memchr(any + QUERIES / 2, 1, QUERIES / 2) == NULL);

    /* Points. */
    static int numbers[QUERIES];
    static pierce_location locations[QUERIES];
    pierce_counters counters = {0};
    CHECK(pierce_winding_numbers_d(cubes, &starts, numbers, &counters, &backwards) == PIERCE_OK);
    CHECK(counters.queries == QUERIES);
    CHECK(pierce_contains_points_d(cubes, &starts, any, NULL, NULL, NULL) == PIERCE_OK);
    CHECK(pierce_locate_points_d(cubes, &starts, locations, &count, NULL, NULL) == PIERCE_OK && count > 0);
    for (int i = 0; i < QUERIES; ++i) {
        CHECK(numbers[i] == pierce_winding_number_d(cubes, wide + 6 * i, NULL) && any[i] == (numbers[i] != 0));
        CHECK(locations[i].place == pierce_locate_d(cubes, wide + 6 * i, NULL, 0, NULL).place);
    }
}
