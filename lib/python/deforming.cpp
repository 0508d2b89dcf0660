// Meshes whose vertices move from step to step.
#include <memory>
#include <vector>

#include <python/bind.h>
#include <python/making.h>
#include <python/motion.h>
#include <python/options.h>
#include <python/work.h>

namespace pierce::python {

namespace {

class Deforming {
  public:
    template <class Scalar>
    using Kept = std::shared_ptr<DeformingMesh<Scalar>>;

    template <class Scalar>
    Deforming(DeformingMesh<Scalar>&& mesh, const FaceCount& faces)
        : kept_(std::make_shared<DeformingMesh<Scalar>>(std::move(mesh))), flags_(faces) {}

    // One thread at a time begins a step; all others may ask meanwhile.
    template <class Begin>
    void begin(Begin&& begin) {
        const Use::Changing changing(use_);
        std::visit([&](const auto& mesh) { begin(*mesh); }, kept_);
    }
    [[nodiscard]] Step step() const {
        return std::visit([&](const auto& mesh) { return Step(mesh->step(), flags_); }, kept_);
    }

  private:
    std::variant<Kept<float>, Kept<double>> kept_;
    FaceCount flags_;
    Use use_;
};

Deforming make(const py::object& vertices, const py::object& faces, const py::object& face_numbers,
               double rebuild_above, const std::string& broadphase, double cell_size, std::size_t max_grid_bytes,
               const std::string& backend, int threads) {
    const BuildOptions build = build_options(broadphase, cell_size, max_grid_bytes, backend, threads);
    return made(vertices, faces, face_numbers, [&]<class Scalar>(const MeshView<Scalar>& view) {
        return Deforming(DeformingMesh<Scalar>(view, {.build = build, .rebuild_above = rebuild_above}),
                         face_count(view));
    });
}

void begin_step(Deforming& self, const py::object& given, int threads) {
    self.begin([&](auto& mesh) {
        using Scalar = ScalarOf<decltype(mesh)>;
        const auto positions = points_of<Scalar>(given, "vertices");
        const Executor executor = Threads(threads).executor();
        const py::gil_scoped_release released;
        mesh.begin_step(positions.view, executor);
    });
}

void begin_pose(Deforming& self, const py::object& rotation, const py::object& translation, int threads) {
    const Pose<double> pose = pose_of(rotation, translation);
    self.begin([&](auto& mesh) {
        const Executor executor = Threads(threads).executor();
        const py::gil_scoped_release released;
        mesh.begin_step(pose, executor);
    });
}

py::dict sweep(const Step& self, const py::object& starts, const py::object& ends, const py::object& sides,
               double max_fraction, const py::object& mask, int threads, const py::object& progress) {
    return self.ask([&](const auto& step) {
        using Scalar = ScalarOf<decltype(step)>;
        const auto ways = pairs_of<Scalar>("sweep", starts, "starts", ends, "ends");
        const Filters filters(sides, max_fraction, mask, self.flags());
        const auto out = columns_of_sweeps<Scalar>(ways.size);
        std::vector<std::optional<SweepHit<Scalar>>> hits;
        in_calls(ways.size, {Threads(threads), progress},
                 [&](std::size_t first, std::size_t count, const Executor& executor) {
                     hits.resize(count);
                     step.sweeps(ways.segments(first, count), hits, filters.options, executor);
                     out.write(first, hits);
                 });
        return out.columns;
    });
}

}  // namespace

void bind_deforming(py::module_& module, StepClass& step) {
    step.def_property_readonly("before", [](const Step& self) { return self.end(false); })
        .def_property_readonly("after", [](const Step& self) { return self.end(true); })
        .def_property_readonly("is_double", &Step::is_double)
        .def("sweep", &sweep);
    py::class_<Deforming>(module, "Deforming")
        .def(py::init(&make))
        .def("begin_step", &begin_step)
        .def("begin_pose", &begin_pose)
        .def("step", &Deforming::step);
}

}  // namespace pierce::python
