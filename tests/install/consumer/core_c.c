/* A segment through one triangle, at exactly half its length, in C. */
#include <stdio.h>

#include <pierce/pierce_c.h>

int main(void) {
    const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const uint16_t indices[3] = {0, 1, 2};
    const pierce_points_f positions = {.first = corners, .count = 3};
    const pierce_triangles triangles = {.shorts = indices, .count = 1};
    pierce_mesh_f* mesh = NULL;
    if (pierce_mesh_create_f(&positions, &triangles, NULL, &mesh) != PIERCE_OK) return puts(pierce_last_message());
    const float from[3] = {0.25f, 0.25f, 1}, to[3] = {0.25f, 0.25f, -1};
    pierce_hit_f hit;
    const bool is_right = pierce_first_hit_f(mesh, from, to, &hit, NULL) && hit.exact_fraction == 0.5f &&
                          hit.face == 0 && pierce_version() == PIERCE_VERSION;
    if (!is_right) puts("no hit, or a wrong one");
    pierce_mesh_destroy_f(mesh);
    return is_right ? 0 : 1;
}
