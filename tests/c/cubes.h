/* Two cubes, one in the other: [0, 4]^3 and [1, 3]^3, both with their fronts outwards. Face 2 s and 2 s + 1 are the
   halves of side s of the outer cube (-x, +x, -y, +y, -z, +z); those of the inner cube follow from 12 on. */
#pragma once

#include <stdint.h>

enum { CUBE_CORNERS = 16, CUBE_FACES = 24 };

/* As a game has them: positions in the middle of vertices, indices of 16 bits. */
struct vertex {
    float uv[2];
    float position[3];
};

#ifdef __cplusplus
extern "C" {
#endif

void fill_cubes(struct vertex vertices[CUBE_CORNERS], uint16_t indices[3 * CUBE_FACES]);

#ifdef __cplusplus
}
#endif
