/* What the C++ interface answers on the two cubes, for the program in C to compare with. */
#pragma once

#include <pierce/pierce_c.h>

#include "cubes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Segments are six numbers in a row. */
void expected_first_hits_f(const struct vertex* vertices, const uint16_t* indices, const float* segments, size_t count,
                           pierce_hit_f* hits);
void expected_first_hits_d(const struct vertex* vertices, const uint16_t* indices, const double* segments, size_t count,
                           pierce_hit_d* hits);

#ifdef __cplusplus
}
#endif
