// The extension module pierce._pierce: what the Python files of the package stand on.
#include <pybind11/pybind11.h>

#include <python/bind.h>

PYBIND11_MODULE(_pierce, module) {
    using namespace pierce::python;
    module.doc() = "The library pierce on arrays of NumPy. Use the package `pierce`, which says what each call does.";
    module.attr("version") = py::str(pierce::version.data(), pierce::version.size());
    py::register_exception<pierce::MeshError>(module, "MeshError", PyExc_ValueError).attr("__module__") = "pierce";
    MeshClass mesh(module, "Mesh");
    bind_mesh(module, mesh);
    bind_hits(mesh);
    bind_places(mesh);
    bind_report(module, mesh);
    bind_spheres(mesh);
    bind_motion(module, mesh);
    StepClass step(module, "Step");
    bind_deforming(module, step);
    bind_moves(mesh, step);
}
