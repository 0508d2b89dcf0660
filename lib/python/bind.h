// The parts of the module: each adds its functions to what is there.
#pragma once

#include <python/mesh.h>

namespace pierce::python {

using MeshClass = py::class_<Mesh>;

void bind_mesh(py::module_& module, MeshClass& mesh);
void bind_hits(MeshClass& mesh);
void bind_places(MeshClass& mesh);

}  // namespace pierce::python
