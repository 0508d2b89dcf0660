// The parts of the module: each adds its functions to what is there.
#pragma once

#include <python/mesh.h>
#include <python/motion.h>

namespace pierce::python {

using MeshClass = py::class_<Mesh>;
using StepClass = py::class_<Step>;

void bind_mesh(py::module_& module, MeshClass& mesh);
void bind_hits(MeshClass& mesh);
void bind_places(MeshClass& mesh);
void bind_motion(py::module_& module, MeshClass& mesh);
void bind_deforming(py::module_& module, StepClass& step);
void bind_moves(MeshClass& mesh, StepClass& step);
void bind_report(py::module_& module, MeshClass& mesh);
void bind_spheres(MeshClass& mesh);

}  // namespace pierce::python
