/* The parts of the story that have files of their own. */
#pragma once

#include <pierce/pierce_c.h>

#include "cubes.h"

void meshes(const pierce_mesh_d* cubes);
void errors(const pierce_mesh_d* cubes);
void batches(const struct vertex* vertices, const uint16_t* indices, const pierce_mesh_d* cubes);
int other_failures(void);
