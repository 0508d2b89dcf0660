/* Statistics, reports, files, and what goes wrong. */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "story.h"

int batch_failures(void);
int other_failures(void) { return failures + batch_failures(); }

static void run_backwards(size_t parts, pierce_task task, void* data, void* user) {
    *(size_t*)user += parts;
    while (parts > 0) task(data, --parts);
}

static void files(void) {
    const char* const name = "story.obj";
    FILE* const file = fopen(name, "w");
    CHECK(file != NULL);
    if (file == NULL) return;
    fputs("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 0 0 1\nf 1 2 5\nusemtl wet sand\nf 1 2 3 4\n", file);
    fclose(file);
    pierce_soup_f* soup = NULL;
    CHECK(pierce_soup_read_f(name, &(pierce_read_options){.materials = true}, &soup) == PIERCE_OK);
    pierce_points_f positions;
    pierce_triangles triangles;
    pierce_soup_view_f(soup, &positions, &triangles);
    CHECK(positions.count == 5 && triangles.count == 3 && triangles.faces != NULL);
    const char* const material = pierce_soup_material_f(soup, 1);
    CHECK(material != NULL && strcmp(material, "wet sand") == 0);
    CHECK(pierce_soup_material_f(soup, 0) == NULL && pierce_soup_material_f(soup, 2) == NULL);
    CHECK(pierce_soup_group_f(soup, 1) == NULL);
    pierce_mesh_f* mesh = NULL;
    CHECK(pierce_mesh_create_f(&positions, &triangles, NULL, &mesh) == PIERCE_OK);
    pierce_soup_destroy_f(soup);
    /* The mesh keeps nothing of the soup: under address sanitizer this would be seen. */
    pierce_hit_f hit;
    CHECK(pierce_first_hit_f(mesh, (const float[]){1, 2, 1}, (const float[]){1, 2, -1}, &hit, NULL));
    CHECK(hit.face == 1 && hit.triangle >= 1 && hit.exact_fraction == 0.5f);
    pierce_mesh_destroy_f(mesh);
    remove(name);

    CHECK(pierce_soup_read_f("no such file.obj", NULL, &soup) == PIERCE_BAD_FILE && soup == NULL);
    CHECK(strstr(pierce_last_message(), "no such file.obj") != NULL);
}

void meshes(const pierce_mesh_d* cubes) {
    pierce_statistics statistics;
    pierce_mesh_statistics_d(cubes, &statistics);
    CHECK(statistics.vertices == CUBE_CORNERS && statistics.triangles == CUBE_FACES && statistics.bytes > 0);
    CHECK(strlen(statistics.backend) > 0);

    pierce_mesh_report report;
    char text[1000], some[8];
    size_t length = 0, again = 0;
    CHECK(pierce_mesh_report_d(cubes, &report, text, sizeof text, &length) == PIERCE_OK);
    CHECK(report.closed && report.components == 2 && report.edges_with[2] == 36 && length == strlen(text));
    CHECK(pierce_mesh_report_d(cubes, NULL, some, sizeof some, &again) == PIERCE_OK);
    CHECK(again == length && strlen(some) == sizeof some - 1 && strncmp(some, text, sizeof some - 1) == 0);

    /* With face numbers, a grid, an executor and a backend. */
    const double corners[12] = {0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0};
    const uint32_t indices[6] = {0, 1, 2, 0, 2, 3}, numbers[2] = {70, 70};
    const pierce_points_d positions = {.first = corners, .count = 4};
    const pierce_triangles triangles = {.first = indices, .count = 2, .faces = numbers};
    size_t parts = 0;
    const pierce_executor backwards = {run_backwards, &parts};
    const pierce_build_options grid = {.broadphase = PIERCE_GRID, .backend = "plain", .executor = &backwards};
    pierce_mesh_d* floor = NULL;
    CHECK(pierce_mesh_create_d(&positions, &triangles, &grid, &floor) == PIERCE_OK);
    pierce_mesh_statistics_d(floor, &statistics);
    CHECK(statistics.broadphase == PIERCE_GRID && statistics.faces == 1);
    CHECK(strcmp(statistics.backend, "plain") == 0);
    pierce_hit_d hit;
    CHECK(pierce_first_hit_d(floor, (const double[]){1, 3, 1}, (const double[]){1, 3, -3}, &hit, NULL));
    CHECK(hit.face == 70 && hit.triangle == 1 && hit.exact_fraction == 0.25);
    pierce_mesh_destroy_d(floor);
    files();
}

/* A mesh, but no points: no hit, and no crash. */
static void null_points(const pierce_mesh_d* cubes) {
    const double point[3] = {2, 2, 2};
    pierce_hit_d hit;
    CHECK(!pierce_first_hit_d(cubes, NULL, point, &hit, NULL) && hit.face == PIERCE_NO_FACE);
    CHECK(!pierce_any_hit_d(cubes, point, NULL, NULL) && pierce_crossings_d(cubes, NULL, NULL, NULL) == 0);
    CHECK(!pierce_first_hit_of_ray_d(cubes, point, NULL, 1, &hit, NULL) && hit.face == PIERCE_NO_FACE);
    CHECK(pierce_winding_number_d(cubes, NULL, NULL) == 0 && !pierce_contains_d(cubes, NULL, NULL));
    CHECK(pierce_locate_d(cubes, NULL, NULL, 0, NULL).place == PIERCE_OUTSIDE);
    /* Room without an array: as if there were none. */
    const double above[3] = {2, 2, 9};
    CHECK(pierce_all_hits_d(cubes, above, point, NULL, 7, NULL) > 0);
    CHECK(pierce_passages_d(cubes, above, point, NULL, 7, NULL, 7, NULL) > 0);
}

/* Every call with nothing at all: a status or no hit, and no crash. */
static void nulls(void) {
    pierce_mesh_d* mesh = NULL;
    pierce_regions_d* regions = NULL;
    CHECK(pierce_mesh_create_d(NULL, NULL, NULL, &mesh) == PIERCE_BAD_ARGUMENT);
    CHECK(pierce_mesh_create_d(NULL, NULL, NULL, NULL) == PIERCE_BAD_ARGUMENT);
    CHECK(strcmp(pierce_last_message(), "pierce_mesh_create_d: mesh is null") == 0);
    CHECK(pierce_soup_read_d(NULL, NULL, NULL) == PIERCE_BAD_ARGUMENT);
    CHECK(pierce_mesh_report_d(NULL, NULL, NULL, 0, NULL) == PIERCE_BAD_ARGUMENT);
    CHECK(pierce_first_hits_d(NULL, NULL, NULL, NULL, NULL, NULL) == PIERCE_BAD_ARGUMENT);
    CHECK(pierce_regions_create_d(NULL, NULL, 0, 0, &regions) == PIERCE_BAD_ARGUMENT);
    CHECK(pierce_regions_check_d(NULL, NULL, NULL, 0, NULL) == PIERCE_BAD_ARGUMENT);
    const double point[3] = {0, 0, 0};
    pierce_hit_d hit;
    CHECK(!pierce_first_hit_d(NULL, point, point, &hit, NULL) && hit.face == PIERCE_NO_FACE);
    CHECK(!pierce_first_hit_d(NULL, NULL, NULL, NULL, NULL));
    CHECK(pierce_all_hits_d(NULL, point, point, NULL, 7, NULL) == 0);
    CHECK(pierce_passages_d(NULL, NULL, NULL, NULL, 0, NULL, 0, NULL) == 0);
    CHECK(pierce_locate_d(NULL, point, NULL, 0, NULL).place == PIERCE_OUTSIDE);
    CHECK(pierce_region_at_d(NULL, point) == PIERCE_NO_REGION && pierce_walk_d(NULL, point, point, NULL, 1) == 0);
    CHECK(!pierce_stop_d(NULL, point, point, NULL, NULL) && !pierce_cross_d(NULL, point, point, NULL, NULL));
    pierce_soup_view_d(NULL, NULL, NULL);
    pierce_mesh_statistics_d(NULL, NULL);
    pierce_mesh_destroy_d(NULL);
    pierce_soup_destroy_d(NULL);
    pierce_regions_destroy_d(NULL);
}

void errors(const pierce_mesh_d* cubes) {
    const double corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const uint32_t indices[3] = {0, 1, 9};
    const pierce_points_d positions = {.first = corners, .count = 3};
    const pierce_triangles triangles = {.first = indices, .count = 1};
    pierce_mesh_d* mesh = NULL;
    CHECK(pierce_mesh_create_d(&positions, &triangles, NULL, &mesh) == PIERCE_BAD_MESH && mesh == NULL);
    CHECK(strstr(pierce_last_message(), "vertex index 9 is out of range (3 vertices)") != NULL);
    const pierce_points_d nowhere = {.count = 3};
    CHECK(pierce_mesh_create_d(&nowhere, &triangles, NULL, &mesh) == PIERCE_BAD_ARGUMENT);
    const uint32_t good_indices[3] = {0, 1, 2};
    const pierce_triangles good = {.first = good_indices, .count = 1};
    const pierce_build_options unknown = {.backend = "flute"};
    CHECK(pierce_mesh_create_d(&positions, &good, &unknown, &mesh) == PIERCE_BAD_ARGUMENT);
    CHECK(strstr(pierce_last_message(), "flute") != NULL);
    CHECK(strcmp(pierce_status_text(PIERCE_BAD_MESH), "bad mesh") == 0);
    CHECK(strcmp(pierce_status_text((pierce_status)77), "") == 0);

    /* Options without a meaning: no hit, or a status. */
    const pierce_query_options bad = {.sides = (pierce_sides)3};
    const double from[3] = {2, 2, 9}, to[3] = {2, 2, 2};
    CHECK(pierce_any_hit_d(cubes, from, to, NULL) && !pierce_any_hit_d(cubes, from, to, &bad));
    const pierce_segments_d one = {{.first = from, .count = 1}, {.first = to, .count = 1}};
    uint8_t answer = 0;
    CHECK(pierce_any_hits_d(cubes, &one, &answer, NULL, &bad, NULL) == PIERCE_BAD_ARGUMENT);
    CHECK(pierce_any_hits_d(cubes, &one, NULL, NULL, NULL, NULL) == PIERCE_BAD_ARGUMENT);
    const pierce_segments_d uneven = {{.first = from, .count = 1}, {.first = to, .count = 0}};
    CHECK(pierce_any_hits_d(cubes, &uneven, &answer, NULL, NULL, NULL) == PIERCE_BAD_ARGUMENT);
    CHECK(strstr(pierce_last_message(), "1 starts and 0 ends") != NULL);
    const pierce_rays_d limits = {.origins = {.first = from, .count = 1},
                                  .directions = {.first = to, .count = 1},
                                  .limits = from,
                                  .limit_count = 3};
    CHECK(pierce_any_hits_of_rays_d(cubes, &limits, &answer, NULL, NULL, NULL) == PIERCE_BAD_ARGUMENT);
    CHECK(strstr(pierce_last_message(), "1 origins and 3 limits") != NULL);
    null_points(cubes);
    nulls();
}
