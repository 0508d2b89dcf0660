// What meshes of all kinds are made of: arrays, and how to build.
#pragma once

#include <algorithm>
#include <string>

#include <python/arrays.h>
#include <python/work.h>

namespace pierce::python {

/// `backend` has to live as long as the options.
inline BuildOptions build_options(const std::string& broadphase, double cell_size, std::size_t max_grid_bytes,
                                  const std::string& backend, int threads) {
    BuildOptions options;
    if (broadphase == "tree")
        options.broadphase = Broadphase::tree;
    else if (broadphase == "grid")
        options.broadphase = Broadphase::grid;
    else if (broadphase != "automatic")
        throw py::value_error("broadphase: '" + broadphase + "', where 'automatic', 'tree' or 'grid' is needed");
    options.cell_size = cell_size;
    options.max_grid_bytes = max_grid_bytes;
    options.backend = backend;
    options.executor = Threads(threads).executor();
    return options;
}

/// What an array of one entry for each face of this mesh is to have.
template <class Scalar>
FaceCount face_count(const MeshView<Scalar>& mesh) {
    if (mesh.faces.empty()) return {mesh.triangles.size(), true};
    return {std::size_t{*std::max_element(mesh.faces.begin(), mesh.faces.end())} + 1, false};
}

/// Calls `make(MeshView<float>)` where vertices are floats, else `make(MeshView<double>)`, without the lock.
template <class Make>
auto made(const py::object& vertices, const py::object& faces, const py::object& face_numbers, Make&& make) {
    const py::array array = array_of(vertices);
    const Triangles triangles = triangles_of(faces, "faces");
    Numbers numbers;
    if (!face_numbers.is_none()) numbers = whole_numbers_of(face_numbers, "face_numbers");
    const auto of = [&]<class Scalar>(const Points<Scalar>& positions) {
        const py::gil_scoped_release released;
        return make(MeshView<Scalar>{positions.view, triangles.view, numbers.view});
    };
    const bool in_float = array.dtype().kind() == 'f' && array.itemsize() <= py::ssize_t{sizeof(float)};
    return in_float ? of(points_of<float>(array, "vertices")) : of(points_of<double>(array, "vertices"));
}

}  // namespace pierce::python
