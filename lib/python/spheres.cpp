// Balls: where they first run into the mesh, and what they are in contact with.
#include <optional>
#include <vector>

#include <python/arrays.h>
#include <python/bind.h>
#include <python/columns.h>
#include <python/options.h>
#include <python/work.h>

namespace pierce::python {

namespace {

template <class Row, class Scalar>
Gathered<Row> columns_of_spheres(std::size_t size) {
    Gathered<Row> out(size);
    using H = SphereHit<Scalar>;
    out.hit();
    out.template column<Scalar>("fraction", [](const H& hit) { return hit.fraction; });
    out.template vectors<Scalar>("center", [](const H& hit) { return hit.center; });
    out.template vectors<Scalar>("contact", [](const H& hit) { return hit.contact; });
    out.template vectors<Scalar>("normal", [](const H& hit) { return hit.normal; });
    out.template column<Scalar>("overlap", [](const H& hit) { return hit.overlap; });
    out.face();
    out.feature();
    return out;
}

py::dict sweep_spheres(const Mesh& self, const py::object& starts, const py::object& ends, const py::object& radius,
                       double max_fraction, const py::object& mask, int threads, const py::object& progress) {
    return self.ask([&](const auto& mesh) {
        using Scalar = ScalarOf<decltype(mesh)>;
        const auto steps = pairs_of<Scalar>("sweep_spheres", starts, "starts", ends, "ends");
        const auto radii = values_of<Scalar>(radius, "radius", steps.size);
        const Filters filters(py::str("both"), max_fraction, mask, self.flags());
        using Row = std::optional<SphereHit<Scalar>>;
        const auto out = columns_of_spheres<Row, Scalar>(steps.size);
        std::vector<Row> hits;
        in_calls(steps.size, {Threads(threads), progress},
                 [&](std::size_t first, std::size_t count, const Executor& executor) {
                     hits.resize(count);
                     const auto some = steps.segments(first, count);
                     if (radii.many())
                         mesh.sweep_spheres(some, radii.part(first, count), hits, filters.options, executor);
                     else
                         mesh.sweep_spheres(some, radii.one, hits, filters.options, executor);
                     out.write(first, hits);
                 });
        return out.columns;
    });
}

// Asks how many there are first.
template <class Scalar, class Ask>
py::dict all_of(Ask&& ask) {
    std::vector<SphereHit<Scalar>> hits;
    {
        const py::gil_scoped_release released;
        hits.resize(ask(std::span<SphereHit<Scalar>>()));
        ask(std::span(hits));
    }
    const auto out = columns_of_spheres<SphereHit<Scalar>, Scalar>(hits.size());
    out.write(0, hits);
    return out.columns;
}

py::dict sphere_hits(const Mesh& self, const py::object& start, const py::object& end, double radius,
                     double max_fraction, const py::object& mask) {
    return self.ask([&](const auto& mesh) {
        using Scalar = ScalarOf<decltype(mesh)>;
        const auto steps = pairs_of<Scalar>("sphere_hits", start, "start", end, "end");
        if (steps.size != 1) throw py::value_error("sphere_hits: one step at a time, start and end of shape (3,)");
        const Filters filters(py::str("both"), max_fraction, mask, self.flags());
        return all_of<Scalar>([&](auto room) {
            return mesh.sphere_hits(steps.segments(0, 1)[0], static_cast<Scalar>(radius), room, filters.options);
        });
    });
}

py::dict sphere_contacts(const Mesh& self, const py::object& given, double radius, const py::object& mask) {
    return self.ask([&](const auto& mesh) {
        using Scalar = ScalarOf<decltype(mesh)>;
        const auto center = points_of<Scalar>(given, "center");
        if (center.view.size() != 1) throw py::value_error("sphere_contacts: one center at a time, of shape (3,)");
        const Filters filters(py::str("both"), std::numeric_limits<double>::infinity(), mask, self.flags());
        return all_of<Scalar>([&](auto room) {
            return mesh.sphere_contacts(center.view[0], static_cast<Scalar>(radius), room, filters.options);
        });
    });
}

}  // namespace

void bind_spheres(MeshClass& mesh) {
    mesh.def("sweep_spheres", &sweep_spheres).def("sphere_hits", &sphere_hits).def("sphere_contacts", &sphere_contacts);
}

}  // namespace pierce::python
