// What people ask of a mesh: why a face is hit or is not, and what is odd about it.
#include <pybind11/stl.h>

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include <python/arrays.h>
#include <python/bind.h>
#include <python/options.h>

namespace pierce::python {

namespace {

py::list explain(const Mesh& self, const py::object& start, const py::object& end, const py::object& sides,
                 double max_fraction, const py::object& mask) {
    return self.ask([&](const auto& mesh) {
        using Scalar = ScalarOf<decltype(mesh)>;
        const auto ends = pairs_of<Scalar>("explain", start, "start", end, "end");
        if (ends.size != 1) throw py::value_error("explain: one segment at a time, start and end of shape (3,)");
        const Filters filters(sides, max_fraction, mask, self.flags());
        std::vector<FaceVerdict> verdicts;
        {
            const py::gil_scoped_release released;
            verdicts = mesh.explain({ends.firsts(0, 1)[0], ends.seconds(0, 1)[0]}, filters.options);
        }
        py::list all;
        for (const FaceVerdict& one : verdicts)
            all.append(py::make_tuple(one.face, one.triangle, static_cast<int>(one.reason), one.edge,
                                      std::string(to_string(one.reason))));
        return all;
    });
}

// Shape (n,) or (n, 2).
py::array copied(const std::vector<std::uint32_t>& numbers) {
    return py::array_t<std::uint32_t>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}
py::array copied(const std::vector<MeshReport::Edge>& edges) {
    return py::array_t<std::uint32_t>({static_cast<py::ssize_t>(edges.size()), py::ssize_t{2}},
                                      edges.empty() ? nullptr : edges[0].data());
}

py::dict mesh_report(const Mesh& self) {
    const MeshReport report = self.ask([](const auto& mesh) {
        const py::gil_scoped_release released;
        return mesh.mesh_report();
    });
    py::dict parts;
    parts["zero_area"] = report.zero_area;
    parts["duplicates"] = report.duplicates;
    parts["border_edges"] = report.border_edges;
    parts["non_manifold_edges"] = report.non_manifold_edges;
    parts["misoriented_edges"] = report.misoriented_edges;
    parts["non_manifold_vertices"] = report.non_manifold_vertices;
    parts["t_junctions"] = report.t_junctions;
    parts["components"] = report.components;
    parts["edges_with"] = py::cast(report.edges_with);
    parts["zero_area_triangles"] = copied(report.zero_area_triangles);
    parts["duplicate_triangles"] = copied(report.duplicate_triangles);
    parts["border_edge_list"] = copied(report.border_edge_list);
    parts["non_manifold_edge_list"] = copied(report.non_manifold_edge_list);
    parts["misoriented_edge_list"] = copied(report.misoriented_edge_list);
    parts["non_manifold_vertex_list"] = copied(report.non_manifold_vertex_list);
    parts["t_junction_list"] = copied(report.t_junction_list);
    parts["closed"] = report.closed();
    parts["text"] = report.to_string();
    return parts;
}

// By the names that they have in Python, for a test to compare.
py::dict enumerators() {
    py::dict all;
    const auto kind = [&]<class Enumerator>(const char* name,
                                            std::initializer_list<std::pair<const char*, Enumerator>> of) {
        py::dict numbers;
        for (const auto& [word, enumerator] : of) numbers[word] = static_cast<int>(enumerator);
        all[name] = numbers;
    };
    kind.operator()<Sides>("Sides", {{"front", Sides::front}, {"back", Sides::back}, {"both", Sides::both}});
    kind.operator()<Feature>("Feature",
                             {{"face", Feature::face}, {"edge", Feature::edge}, {"vertex", Feature::vertex}});
    kind.operator()<Place>("Place",
                           {{"outside", Place::outside}, {"inside", Place::inside}, {"on_surface", Place::on_surface}});
    kind.operator()<PassageKind>(
        "PassageKind",
        {{"entering", PassageKind::entering}, {"leaving", PassageKind::leaving}, {"grazing", PassageKind::grazing}});
    kind.operator()<MoveState>("MoveState", {{"free", MoveState::free},
                                             {"slid", MoveState::slid},
                                             {"resting", MoveState::resting},
                                             {"wedged", MoveState::wedged},
                                             {"invalid", MoveState::invalid},
                                             {"crushed", MoveState::crushed}});
    kind.operator()<Reason>("Reason", {{"first_hit", Reason::first_hit},
                                       {"later", Reason::later},
                                       {"apart", Reason::apart},
                                       {"zero_area", Reason::zero_area},
                                       {"masked", Reason::masked},
                                       {"in_plane", Reason::in_plane},
                                       {"in_front", Reason::in_front},
                                       {"behind", Reason::behind},
                                       {"wrong_side", Reason::wrong_side},
                                       {"outside_edge", Reason::outside_edge},
                                       {"too_far", Reason::too_far},
                                       {"not_accepted", Reason::not_accepted}});
    return all;
}

}  // namespace

void bind_report(py::module_& module, MeshClass& mesh) {
    module.def("enumerators", &enumerators);
    mesh.def("explain", &explain).def("mesh_report", &mesh_report);
}

}  // namespace pierce::python
