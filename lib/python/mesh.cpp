// Meshes: made of arrays, read from files, changed, and what there is to know of them.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <string>
#include <vector>

#include <python/arrays.h>
#include <python/bind.h>
#include <python/making.h>

namespace pierce::python {

namespace {

Mesh make(const py::object& vertices, const py::object& faces, const py::object& face_numbers,
          const std::string& broadphase, double cell_size, std::size_t max_grid_bytes, const std::string& backend,
          int threads) {
    const BuildOptions options = build_options(broadphase, cell_size, max_grid_bytes, backend, threads);
    return made(vertices, faces, face_numbers, [&]<class Scalar>(const MeshView<Scalar>& view) {
        return Mesh(CollisionMesh<Scalar>(view, options), face_count(view));
    });
}

// The vector's memory, as an array that keeps it.
template <class Number, class Value>
py::array kept(std::vector<Value>&& values, std::vector<py::ssize_t> shape) {
    static_assert(sizeof(Value) % sizeof(Number) == 0);
    auto* const owned = new std::vector<Value>(std::move(values));
    const py::capsule owner(owned, [](void* pointer) { delete static_cast<std::vector<Value>*>(pointer); });
    return py::array_t<Number>(std::move(shape), static_cast<const Number*>(static_cast<const void*>(owned->data())),
                               owner);
}
template <class Number>
py::object kept_or_none(std::vector<Number>&& numbers) {
    if (numbers.empty()) return py::none();
    const auto size = static_cast<py::ssize_t>(numbers.size());
    return kept<Number>(std::move(numbers), {size});
}

template <class Scalar>
py::dict read(const std::filesystem::path& path, const ReadOptions& options) {
    TriangleSoup<Scalar> soup = [&] {
        const py::gil_scoped_release released;
        return pierce::read_mesh<Scalar>(path, options);
    }();
    const auto vertices = static_cast<py::ssize_t>(soup.positions.size());
    const auto faces = static_cast<py::ssize_t>(soup.triangles.size());
    py::dict parts;
    parts["vertices"] = kept<Scalar>(std::move(soup.positions), {vertices, 3});
    parts["faces"] = kept<std::uint32_t>(std::move(soup.triangles), {faces, 3});
    parts["face_numbers"] = kept_or_none(std::move(soup.faces));
    parts["materials"] = py::cast(soup.materials);
    parts["material_of_face"] = kept_or_none(std::move(soup.material_of_face));
    parts["groups"] = py::cast(soup.groups);
    parts["group_of_face"] = kept_or_none(std::move(soup.group_of_face));
    return parts;
}

py::dict read_mesh(const std::filesystem::path& path, bool in_float, bool materials, bool groups) {
    const ReadOptions options{.materials = materials, .groups = groups};
    return in_float ? read<float>(path, options) : read<double>(path, options);
}

const char* name(Broadphase broadphase) { return broadphase == Broadphase::grid ? "grid" : "tree"; }

py::dict statistics(const Mesh& self) {
    const MeshStatistics all = self.ask([](const auto& mesh) { return mesh.statistics(); });
    py::dict parts;
    parts["vertices"] = all.vertices;
    parts["faces"] = all.faces;
    parts["triangles"] = all.triangles;
    parts["degenerate"] = all.degenerate;
    parts["clusters"] = all.clusters;
    parts["broadphase"] = name(all.broadphase);
    parts["nodes"] = all.nodes;
    parts["cell_size"] = all.cell_size;
    parts["grid_references"] = all.grid_references;
    parts["backend"] = std::string(all.backend);
    parts["bytes"] = all.bytes;
    parts["invalid_queries"] = all.invalid_queries;
    return parts;
}

}  // namespace

void bind_mesh(py::module_& module, MeshClass& mesh) {
    module.def("read_mesh", &read_mesh);
    mesh.def(py::init(&make)).def_property_readonly("is_double", &Mesh::is_double).def("statistics", &statistics);
}

}  // namespace pierce::python
