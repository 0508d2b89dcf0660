/* What the README tells, as a program in C17: meshes, first hits, rays, places, passages, regions. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <pierce/pierce_c.h>

#include "check.h"
#include "cubes.h"
#include "expected.h"
#include "story.h"

_Static_assert(sizeof(pierce_hit_f) == 72 && sizeof(pierce_hit_d) == 128, "as in hit.h");
_Static_assert(offsetof(pierce_hit_f, face) == 56 && offsetof(pierce_hit_d, face) == 112, "as in hit.h");
_Static_assert(PIERCE_VERSION >= 100, "the macros of version.h are there in C");

static const double above[3] = {2, 2.5, 9};
static const double below[3] = {2, 2.5, -1};

static void hits_of_a_segment(const pierce_mesh_d* cubes) {
    pierce_hit_d hit;
    CHECK(pierce_first_hit_d(cubes, above, below, &hit, NULL));
    CHECK(hit.exact_fraction == 0.5 && hit.fraction <= 0.5 && hit.face / 2 == 5 && hit.side == PIERCE_FRONT);
    CHECK(hit.position[0] == 2 && hit.position[1] == 2.5 && hit.position[2] == 4);
    CHECK(hit.normal[2] == 1 && hit.feature == PIERCE_ON_FACE && !hit.at_start);
    /* The way to the point is clear, and the point is not behind the face. */
    CHECK(hit.point[2] > 4 && !pierce_any_hit_d(cubes, above, hit.point, NULL));
    CHECK(pierce_any_hit_d(cubes, hit.point, below, NULL));
    pierce_hit_d swept;
    CHECK(pierce_sweep_d(cubes, above, below, &swept, NULL) && memcmp(&swept, &hit, sizeof hit) == 0);

    /* Backs count if they are asked for, in order. */
    const pierce_query_options both = {.sides = PIERCE_BOTH};
    pierce_hit_d all[8];
    CHECK(pierce_all_hits_d(cubes, above, below, all, 8, &both) == 4);
    CHECK(all[0].face / 2 == 5 && all[1].face / 2 == 11 && all[2].face / 2 == 10 && all[3].face / 2 == 4);
    CHECK(pierce_all_hits_d(cubes, above, below, NULL, 0, NULL) == 2);
    CHECK(pierce_crossings_d(cubes, above, below, NULL) == 0);
    CHECK(pierce_crossings_d(cubes, above, (const double[]){2, 2.5, 2}, NULL) == 2);

    /* No hit is written as one. */
    CHECK(!pierce_first_hit_d(cubes, above, (const double[]){2, 2.5, 5}, &hit, NULL));
    CHECK(hit.face == PIERCE_NO_FACE && hit.triangle == PIERCE_NO_FACE && hit.fraction == 0);
}

static bool is_inner(const pierce_contact* contact, void* user) {
    ++*(int*)user;
    return contact->face >= 12 && contact->fraction > 0 && contact->side == PIERCE_FRONT;
}

static void options(const pierce_mesh_d* cubes) {
    pierce_hit_d hit;
    int asked = 0;
    pierce_counters counters = {0};
    const pierce_query_options inner = {.accept = is_inner, .accept_user = &asked, .counters = &counters};
    CHECK(pierce_first_hit_d(cubes, above, below, &hit, &inner) && hit.face / 2 == 11 && hit.exact_fraction == 0.6);
    CHECK(asked >= 2 && counters.queries == 1 && counters.clusters >= 1);

    uint8_t mask[CUBE_FACES] = {0};
    mask[22] = mask[23] = 1;
    const pierce_query_options masked = {.face_mask = mask, .face_mask_count = CUBE_FACES};
    CHECK(pierce_first_hit_d(cubes, above, below, &hit, &masked) && hit.face / 2 == 11);

    const double half = 0.5, less = 0.49;
    CHECK(pierce_any_hit_d(cubes, above, below, &(pierce_query_options){.max_fraction = &half}));
    CHECK(!pierce_any_hit_d(cubes, above, below, &(pierce_query_options){.max_fraction = &less}));
    /* Zero is a bound like any other. */
    CHECK(!pierce_any_hit_d(cubes, above, below, &(pierce_query_options){.max_fraction = &(const double){0}}));
}

static void rays(const pierce_mesh_d* cubes) {
    const double down[3] = {0, 0, -1};
    pierce_hit_d hit;
    CHECK(pierce_first_hit_of_ray_d(cubes, above, down, INFINITY, &hit, NULL) && hit.exact_fraction == 5);
    /* A ray that ends on the face has not hit it yet. */
    CHECK(!pierce_any_hit_of_ray_d(cubes, above, down, 5, NULL));
    CHECK(pierce_any_hit_of_ray_d(cubes, above, down, nextafter(5, 6), NULL));
    CHECK(pierce_all_hits_of_ray_d(cubes, above, down, INFINITY, NULL, 0, NULL) == 2);
    CHECK(pierce_crossings_of_ray_d(cubes, above, down, 7, NULL) == 2);
}

static void places(const pierce_mesh_d* cubes) {
    const double centre[3] = {2, 2, 2}, edge[3] = {4, 2, 4};
    CHECK(pierce_winding_number_d(cubes, centre, NULL) == 2 && pierce_contains_d(cubes, centre, NULL));
    CHECK(!pierce_contains_d(cubes, above, NULL));
    CHECK(pierce_locate_d(cubes, centre, NULL, 0, NULL).place == PIERCE_INSIDE);
    CHECK(pierce_locate_d(cubes, above, NULL, 0, NULL).place == PIERCE_OUTSIDE);
    pierce_face_touch faces[4];
    const pierce_location on_edge = pierce_locate_d(cubes, edge, faces, 4, NULL);
    CHECK(on_edge.place == PIERCE_ON_SURFACE && on_edge.face_count == 2);
    CHECK(faces[0].face / 2 == 1 && faces[1].face / 2 == 5 && faces[0].feature == PIERCE_ON_EDGE);
}

static void passages(const pierce_mesh_d* cubes) {
    pierce_passage_d passages[8];
    pierce_face_touch faces[8];
    CHECK(pierce_passages_d(cubes, above, below, passages, 8, faces, 8, NULL) == 4);
    CHECK(passages[0].kind == PIERCE_ENTERING && passages[1].kind == PIERCE_ENTERING);
    CHECK(passages[2].kind == PIERCE_LEAVING && passages[3].kind == PIERCE_LEAVING);
    CHECK(passages[0].position[2] - passages[1].position[2] == 1); /* the thickness of the wall */
    CHECK(faces[passages[3].first_face].face / 2 == 4 && faces[passages[3].first_face].crossing == -1);
    /* Through two opposite corners of both cubes: four passages, of six faces or fewer each. */
    const double from[3] = {-1, -1, -1}, to[3] = {5, 5, 5};
    CHECK(pierce_passages_d(cubes, from, to, passages, 8, NULL, 0, NULL) == 4);
    CHECK(passages[0].face_count >= 3 && passages[0].feature == PIERCE_ON_VERTEX && passages[0].crossings == 1);
    const pierce_passage_options first_two = {.one_sided = true, .side = PIERCE_BACK, .stop_when_full = true};
    CHECK(pierce_passages_d(cubes, above, below, passages, 1, NULL, 0, &first_two) == 1);
    CHECK(passages[0].face / 2 == 10 && passages[0].kind == PIERCE_LEAVING);
}

static void regions(const pierce_mesh_d* cubes) {
    pierce_face_regions labels[CUBE_FACES];
    for (uint32_t f = 0; f < CUBE_FACES; ++f)
        labels[f] =
            f < 12 ? (pierce_face_regions){.front = 0, .behind = 1} : (pierce_face_regions){.front = 1, .behind = 2};
    pierce_regions_d* model = NULL;
    CHECK(pierce_regions_create_d(cubes, labels, CUBE_FACES, 0, &model) == PIERCE_OK);
    pierce_label_report report;
    CHECK(pierce_regions_check_d(model, &report, NULL, 0, NULL) == PIERCE_OK && report.agree);
    CHECK(pierce_regions_outside_d(model) == 0 && pierce_region_at_d(model, (const double[]){2, 2, 2}) == 2);

    pierce_leg_d legs[8];
    CHECK(pierce_walk_d(model, above, below, legs, 8) == 5);
    const uint32_t expected[5] = {0, 1, 2, 1, 0};
    for (int i = 0; i < 5; ++i) CHECK(legs[i].region == expected[i] && legs[i].consistent);
    CHECK(legs[0].exit == 0.5 && legs[4].face == PIERCE_NO_FACE);

    /* A particle flies down, from region to region. */
    double at[3] = {2, 2.5, 9};
    const double down[3] = {0, 0, -1};
    uint32_t region = 0;
    int crossed = 0;
    while (pierce_walk_of_ray_d(model, at, down, INFINITY, legs, 1) == 1 && legs[0].face != PIERCE_NO_FACE &&
           crossed < 100) {
        pierce_region_place_d place;
        CHECK(legs[0].region == region);
        CHECK(pierce_stop_of_ray_d(model, at, down, INFINITY, &legs[0], &place) && place.region == region);
        CHECK(pierce_cross_of_ray_d(model, at, down, INFINITY, &legs[0], &place));
        region = place.region;
        memcpy(at, place.point, sizeof at);
        ++crossed;
    }
    CHECK(crossed == 4 && region == 0);
    pierce_regions_destroy_d(model);

    /* A label that is wrong is found, and the text names the face. */
    labels[7].behind = 2;
    CHECK(pierce_regions_create_d(cubes, labels, CUBE_FACES, 0, &model) == PIERCE_OK);
    char text[2000];
    size_t length = 0;
    CHECK(pierce_regions_check_d(model, &report, text, sizeof text, &length) == PIERCE_OK);
    CHECK(!report.agree && report.edges == 3 && length == strlen(text) && strstr(text, "7") != NULL);
    pierce_regions_destroy_d(model);
    CHECK(pierce_regions_create_d(cubes, labels, 20, 0, &model) == PIERCE_BAD_ARGUMENT && model == NULL);
}

int main(void) {
    struct vertex vertices[CUBE_CORNERS];
    uint16_t indices[3 * CUBE_FACES];
    fill_cubes(vertices, indices);
    /* Floats in a vertex buffer, for a mesh in double. */
    const pierce_points_d positions = {
        .floats = vertices[0].position, .count = CUBE_CORNERS, .stride = sizeof(struct vertex)};
    const pierce_triangles triangles = {.shorts = indices, .count = CUBE_FACES};
    pierce_mesh_d* cubes = NULL;
    CHECK(pierce_mesh_create_d(&positions, &triangles, NULL, &cubes) == PIERCE_OK);
    CHECK(pierce_version() == PIERCE_VERSION);

    hits_of_a_segment(cubes);
    options(cubes);
    rays(cubes);
    places(cubes);
    passages(cubes);
    regions(cubes);
    meshes(cubes);
    errors(cubes);
    batches(vertices, indices, cubes);
    pierce_mesh_destroy_d(cubes);
    return failures + other_failures() != 0;
}
