// The smallest program in C that uses pierce: a point moves through a triangle. Where must it stop?
#include <stdio.h>
#include <string.h>

#include <pierce/pierce_c.h>

int main(void) {
    const double corners[] = {0, 0, 0, 4, 0, 0, 0, 4, 0};
    const uint32_t indices[] = {0, 1, 2};  // counter-clockwise seen from above, its front
    const pierce_points_d positions = {.first = corners, .count = 3};
    const pierce_triangles triangles = {.first = indices, .count = 1};
    pierce_mesh_d* floor = NULL;
    if (pierce_mesh_create_d(&positions, &triangles, NULL, &floor) != PIERCE_OK) {
        fprintf(stderr, "%s\n", pierce_last_message());
        return 1;
    }

    double particle[3] = {1, 1, 3};
    const double target[3] = {1, 1, -1};
    const pierce_query_options options = {.sides = PIERCE_BOTH};  // what is not named has its default
    pierce_hit_d hit;
    if (pierce_sweep_d(floor, particle, target, &hit, &options)) {
        printf("hits face %u at (%g %g %g) after %g of the step\n", (unsigned)hit.face, hit.position[0],
               hit.position[1], hit.position[2], hit.fraction);
        memcpy(particle, hit.point, sizeof particle);  // where to stop, with a clear way to it
    } else {
        memcpy(particle, target, sizeof particle);
    }
    pierce_mesh_destroy_d(floor);
    return 0;
}
