/* Two cubes, one in the other. */
#include "cubes.h"

void fill_cubes(struct vertex vertices[CUBE_CORNERS], uint16_t indices[3 * CUBE_FACES]) {
    static const uint16_t sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (int cube = 0; cube < 2; ++cube) {
        const float low = cube == 0 ? 0.0f : 1.0f, high = cube == 0 ? 4.0f : 3.0f;
        for (int corner = 0; corner < 8; ++corner) {
            struct vertex* const v = &vertices[8 * cube + corner];
            v->uv[0] = v->uv[1] = 0.0f;
            for (int axis = 0; axis < 3; ++axis) v->position[axis] = ((corner >> axis) & 1) != 0 ? high : low;
        }
        for (int side = 0; side < 6; ++side) {
            uint16_t* const at = &indices[3 * (12 * cube + 2 * side)];
            const int corners[6] = {0, 1, 2, 0, 2, 3};
            for (int k = 0; k < 6; ++k) at[k] = (uint16_t)(8 * cube + sides[side][corners[k]]);
        }
    }
}
