// Sweeps against meshes that keep their shape and move, and positions given anew.
#include <python/motion.h>

#include <optional>
#include <vector>

#include <python/bind.h>
#include <python/options.h>
#include <python/work.h>

namespace pierce::python {

py::tuple given_back(const Pose<double>& pose) {
    py::array_t<double> rotation({3, 3});
    py::array_t<double> translation(3);
    for (int i = 0; i < 3; ++i) {
        translation.mutable_at(i) = pose.translation[i];
        for (int k = 0; k < 3; ++k) rotation.mutable_at(i, k) = pose.rotation(i, k);
    }
    return py::make_tuple(rotation, translation);
}

namespace {

template <class Scalar>
Gathered<std::optional<RigidHit<Scalar>>> columns_of_turns(std::size_t size) {
    using H = RigidHit<Scalar>;
    Gathered<std::optional<H>> out(size);
    add_sweep_columns<Scalar>(out);
    out.template vectors<Scalar>("local", [](const H& hit) { return hit.local; });
    out.template vectors<Scalar>("local_position", [](const H& hit) { return hit.local_position; });
    out.template vectors<Scalar>("local_normal", [](const H& hit) { return hit.local_normal; });
    out.face();
    out.feature();
    return out;
}

// Batches of sweeps against a mesh and a motion.
template <class Scalar, class Motion, class Columns>
py::dict swept(const CollisionMesh<Scalar>& mesh, const Pairs<Scalar>& ways, const Motion& motion, const Columns& out,
               const Filters& filters, const How& how) {
    using Hits = std::conditional_t<std::is_same_v<Motion, RigidMotion>, std::optional<RigidHit<Scalar>>,
                                    std::optional<SweepHit<Scalar>>>;
    std::vector<Hits> hits;
    in_calls(ways.size, how, [&](std::size_t first, std::size_t count, const Executor& executor) {
        hits.resize(count);
        mesh.sweeps(ways.segments(first, count), motion, std::span<Hits>(hits), filters.options, executor);
        out.write(first, hits);
    });
    return out.columns;
}

py::dict sweep_straight(const Mesh& self, const py::object& starts, const py::object& ends, const py::object& from,
                        const py::object& to, const py::object& sides, double max_fraction, const py::object& mask,
                        int threads, const py::object& progress) {
    return self.ask([&](const auto& mesh) {
        using Scalar = ScalarOf<decltype(mesh)>;
        const auto ways = pairs_of<Scalar>("sweep", starts, "starts", ends, "ends");
        const Translation<Scalar> motion{vector_of<Scalar>(from, "start"), vector_of<Scalar>(to, "end")};
        return swept(mesh, ways, motion, columns_of_sweeps<Scalar>(ways.size),
                     Filters(sides, max_fraction, mask, self.flags()), {Threads(threads), progress});
    });
}

py::dict sweep_turning(const Mesh& self, const py::object& starts, const py::object& ends, const RigidMotion& motion,
                       const py::object& sides, double max_fraction, const py::object& mask, int threads,
                       const py::object& progress) {
    return self.ask([&](const auto& mesh) {
        using Scalar = ScalarOf<decltype(mesh)>;
        const auto ways = pairs_of<Scalar>("sweep", starts, "starts", ends, "ends");
        return swept(mesh, ways, motion, columns_of_turns<Scalar>(ways.size),
                     Filters(sides, max_fraction, mask, self.flags()), {Threads(threads), progress});
    });
}

RigidMotion between(const py::object& from_rotation, const py::object& from, const py::object& to_rotation,
                    const py::object& to, double tolerance, const py::object& pivot) {
    return {pose_of(from_rotation, from), pose_of(to_rotation, to), tolerance, vector_of<double>(pivot, "pivot")};
}

RigidMotion screwed(const py::object& rotation, const py::object& translation, const py::object& point,
                    const py::object& direction, double angle, double slide, double tolerance) {
    const Screw screw{vector_of<double>(point, "point"), vector_of<double>(direction, "direction"), angle, slide};
    return {pose_of(rotation, translation), screw, tolerance};
}

// What becomes of each point, which is one of float32 or of float64 and stays that.
template <class Scalar, class Image>
py::array images(const py::array& given, Image&& image) {
    const Points<Scalar> points = points_of<Scalar>(given, "points");
    const std::size_t size = points.view.size();
    py::array_t<Scalar> answers = new_rows<Scalar>(size);
    Scalar* out = answers.mutable_data();
    for (std::size_t i = 0; i < size; ++i) {
        const Vec3<Scalar> at = image(points.view[i]);
        out = std::copy_n(at.data(), 3, out);
    }
    return answers;
}

enum class Which { start_in_mesh, end_in_mesh, end_in_world };

template <Which which>
py::array placed(const RigidMotion& self, const py::object& given) {
    const auto image = [&]<class Point>(const Point& point) -> Point {
        if constexpr (which == Which::start_in_mesh) return self.start_in_mesh(point);
        if constexpr (which == Which::end_in_mesh) return self.end_in_mesh(point);
        return self.end_in_world(point);
    };
    const py::array array = array_of(given);
    const bool in_float = array.dtype().kind() == 'f' && array.itemsize() <= py::ssize_t{sizeof(float)};
    return in_float ? images<float>(array, image) : images<double>(array, image);
}

void refit(Mesh& self, const py::object& given, const py::object& changed, int threads) {
    self.change([&](auto& mesh) {
        using Scalar = ScalarOf<decltype(mesh)>;
        const auto positions = points_of<Scalar>(given, "vertices");
        const Executor executor = Threads(threads).executor();
        if (changed.is_none()) {
            const py::gil_scoped_release released;
            return mesh.refit(positions.view, executor);
        }
        const Numbers some = whole_numbers_of(changed, "changed");
        const py::gil_scoped_release released;
        mesh.refit(positions.view, some.view);
    });
}

void rebuild(Mesh& self, const py::object& given, int threads) {
    self.change([&](auto& mesh) {
        using Scalar = ScalarOf<decltype(mesh)>;
        const auto positions = points_of<Scalar>(given, "vertices");
        const Executor executor = Threads(threads).executor();
        const py::gil_scoped_release released;
        mesh.rebuild(positions.view, executor);
    });
}

double refit_cost(const Mesh& self) {
    return self.ask([](const auto& mesh) { return mesh.refit_cost(); });
}

}  // namespace

void bind_motion(py::module_& module, MeshClass& mesh) {
    py::class_<RigidMotion>(module, "RigidMotion")
        .def(py::init(&between))
        .def_static("screw", &screwed)
        .def_property_readonly("end", [](const RigidMotion& self) { return given_back(self.end()); })
        .def("start_in_mesh", &placed<Which::start_in_mesh>)
        .def("end_in_mesh", &placed<Which::end_in_mesh>)
        .def("end_in_world", &placed<Which::end_in_world>);
    mesh.def("sweep_straight", &sweep_straight)
        .def("sweep_turning", &sweep_turning)
        .def("refit", &refit)
        .def("rebuild", &rebuild)
        .def("refit_cost", &refit_cost);
}

}  // namespace pierce::python
